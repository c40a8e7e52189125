//! Driving a plan on a platform, and replacing a plan.

use afp_types::{EntryId, Instant};

use super::{Scheduler, StartError, State, Wake};
use crate::component::Environment;
use crate::platform::Platform;
use crate::rt::{Plan, PlanState, Run};
use crate::trace::{Ending, NoTrace, Sink};

/// Stops the platform if a panic unwinds while it is driven.
struct Unwinding<'a, R: Environment>(&'a mut R);

impl<R: Environment> Drop for Unwinding<'_, R> {
    fn drop(&mut self) {
        self.0.emergency_stop();
    }
}

impl<P: PlanState> Scheduler<P> {
    /// Starts the plan if necessary and drives it until it ends. For plans that do not end, see
    /// [`Scheduler::run_until`].
    ///
    /// At the end it calls [`Environment::stop`], so that another plan may follow; if a panic
    /// unwinds, [`Environment::emergency_stop`]. Also call the latter before you leave the robot
    /// unattended.
    ///
    /// # Errors
    /// [`StartError`], without any effect.
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

    /// Drives the plan until it ends or the platform's time reaches `until`, including the step at
    /// that instant. Call it again to continue. A plan that has not started starts at the
    /// platform's current time.
    ///
    /// Each wait is one call of [`Platform::advance`], however long.
    ///
    /// At the plan's end it calls [`Environment::stop`], so that another plan may follow; if a
    /// panic unwinds, [`Environment::emergency_stop`]. Also call the latter before you leave the
    /// robot unattended, even while a plan still runs.
    ///
    /// # Errors
    /// [`StartError`], without any effect.
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
            State::Running | State::Held | State::Broken { .. } | State::Ended(_) => {
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

    /// Ends this plan at `now` as interrupted and starts another plan at the same instant, with its
    /// own name table. Commit numbers continue, so that its objects differ from objects that it
    /// took over.
    ///
    /// If the interruption fails, the run ends in `Error` and nothing starts. Writes for the next
    /// step are lost.
    ///
    /// # Errors
    /// [`StartError::InputMissing`] of the new plan; the old plan continues.
    pub fn replace<R: Run>(&mut self, plan: P, mut on: R, now: Instant) -> Result<Wake, StartError>
    where
        P: Plan<R::Env>,
    {
        if let Some(entry) = plan.missing_input() {
            return Err(StartError::InputMissing(EntryId(entry)));
        }
        if matches!(self.state, State::Running | State::Held | State::Broken { .. }) {
            self.request_stop();
            let wake = self.step(on.parts(), now);
            if matches!(wake, Wake::Ended(Ending::Error(_))) {
                return Ok(wake);
            }
        }
        let (now, commits) = (self.last.max(now), self.step.commits);
        *self = Scheduler::new(plan);
        // Commits identify objects, including those from the old plan.
        self.step.commits = commits;
        self.start(on, now)
    }
}
