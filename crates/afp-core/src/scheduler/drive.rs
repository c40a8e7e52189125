//! Driving a plan on a platform, and replacing a plan by another one.

use afp_types::{EntryId, Instant};

use super::{Scheduler, StartError, State, Wake};
use crate::component::Environment;
use crate::platform::Platform;
use crate::rt::{Plan, PlanState, Run};
use crate::trace::{Ending, NoTrace, Sink};

/// Stands around the driving of a platform: dropped by the unwinding of a panic, it stops the platform.
struct Unwinding<'a, R: Environment>(&'a mut R);

impl<R: Environment> Drop for Unwinding<'_, R> {
    fn drop(&mut self) {
        self.0.emergency_stop();
    }
}

impl<P: PlanState> Scheduler<P> {
    /// Drives the plan on a platform until it has ended, from the start if it has not started. A
    /// plan that never ends keeps this call for ever: see [`Scheduler::run_until`].
    ///
    /// The platform is stopped at the end, by [`Environment::stop`], so that another plan may follow; by
    /// [`Environment::emergency_stop`] where a panic unwinds. Whoever leaves the robot alone then gives that, too.
    ///
    /// # Errors
    /// [`StartError`] when it cannot start; nothing has happened then.
    pub fn run<R>(&mut self, robot: &mut R) -> Result<Ending, StartError>
    where
        R: Platform,
        P: Plan<R>,
    {
        loop {
            if let Wake::Ended(ending) = self.run_until(robot, &mut NoTrace, Instant::MAX)? {
                return Ok(ending);
            }
        }
    }

    /// Drives the plan on a platform until it has ended or until the platform's time has come to
    /// `until`, with the step at that instant; a plan that still runs goes on with the next call. A
    /// plan that has not started starts at the platform's present time.
    ///
    /// Time passes up to what is due next in one call of [`Platform::advance`], however long that lasts.
    ///
    /// The platform is stopped when the plan ends, by [`Environment::stop`], so that another plan may follow; by
    /// [`Environment::emergency_stop`] where a panic unwinds. Whoever leaves the robot alone then, or while a plan still
    /// runs, gives that, too.
    ///
    /// # Errors
    /// [`StartError`] when it cannot start; nothing has happened then.
    pub fn run_until<R, S>(
        &mut self,
        robot: &mut R,
        sink: &mut S,
        until: Instant,
    ) -> Result<Wake, StartError>
    where
        R: Platform,
        S: Sink,
        P: Plan<R>,
    {
        let unwinding = Unwinding(robot);
        let driven = self.drive(&mut *unwinding.0, sink, until);
        core::mem::forget(unwinding);
        driven
    }

    fn drive<R, S>(
        &mut self,
        robot: &mut R,
        sink: &mut S,
        until: Instant,
    ) -> Result<Wake, StartError>
    where
        R: Platform,
        S: Sink,
        P: Plan<R>,
    {
        let (clock, now) = (robot.clock(), robot.now());
        let mut wake = match self.state {
            State::Ready => self.start((&mut *robot, &mut *sink, &clock), now)?,
            State::Running | State::Broken { .. } | State::Ended(_) => {
                self.step((&mut *robot, &mut *sink, &clock), now)
            }
        };
        while let Wake::At(at) = wake {
            let due = at.max(robot.ready());
            robot.advance(due.min(until));
            let now = robot.now();
            if now < due && now >= until {
                return Ok(wake);
            }
            wake = self.step((&mut *robot, &mut *sink, &clock), now);
        }
        let now = robot.now();
        robot.stop(now);
        Ok(wake)
    }

    /// Ends this plan at `now`, as interrupted, and starts another one in its place at the same
    /// instant. Its name table takes the place of this one's, too. Commits are numbered on, so that what it makes is
    /// another object than one that it took over.
    ///
    /// A plan that cannot be interrupted ends the run in `Error`; nothing starts then. Writes that
    /// wait for the next step are lost.
    ///
    /// # Errors
    /// [`StartError::InputMissing`] of the new plan; this one goes on then.
    pub fn replace<R: Run>(&mut self, plan: P, mut on: R, now: Instant) -> Result<Wake, StartError>
    where
        P: Plan<R::Env>,
    {
        if let Some(entry) = plan.missing_input() {
            return Err(StartError::InputMissing(EntryId(entry)));
        }
        if matches!(self.state, State::Running | State::Broken { .. }) {
            self.request_stop();
            let wake = self.step(on.parts(), now);
            if matches!(wake, Wake::Ended(Ending::Error(_))) {
                return Ok(wake);
            }
        }
        let (now, commits) = (self.last.max(now), self.step.commits);
        *self = Scheduler::new(plan);
        // By their commits objects are known, those that were taken over from this plan, too.
        self.step.commits = commits;
        self.start(on, now)
    }
}
