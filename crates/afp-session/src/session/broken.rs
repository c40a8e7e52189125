//! Ends runs early: when they are asked to, or in `Error` if they can no longer be trusted. Then a
//! component panics, the robot's Rust code is wrong, or the control loop of a real robot is late.

use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};

use afp_core::rt::{NamedPlan, Plan};
use afp_core::{Duration, Fault, Instant, Reason, StartError};

use super::Session;
use crate::observer::{Go, Observer};
use crate::record::Keep;
use crate::robot::Robot;

/// The limit of consecutive steps without progress of a simulated robot's time.
const PATIENCE: u32 = 1_000;

const STUCK: Fault = Fault::new(&Reason {
    code: "robot-stuck",
    text: "the robot's time does not go on: 'advance' must bring 'now' up to the instant",
});

const STALLED: Fault = Fault::new(&Reason {
    code: "stalled",
    text: "the control loop was held up or suspended, so the robot was stopped",
});

impl<P, R, S> Session<P, R, S>
where
    P: NamedPlan + Plan<R>,
    R: Robot,
    S: Keep,
{
    /// Ends the plan now, as interrupted.
    pub fn stop(&mut self, to: &mut [&mut dyn Observer]) {
        let now = self.robot.now();
        self.apply_due(now, to);
        if self.scheduler.ending().is_none() {
            self.scheduler.request_stop();
            // A plan that has not started ends at its start; if it cannot start, nothing has to
            // stop.
            let _ = self.guarded(to, |session, to| session.step(now, to).map(|()| Go::On));
        }
        self.robot.emergency_stop();
    }

    /// Ends the plan now with a fault, because it can no longer be trusted.
    pub fn abort(&mut self, fault: Fault, to: &mut [&mut dyn Observer]) {
        let now = self.robot.now();
        let wake = self.scheduler.abort((&mut self.robot, &mut self.sink, &self.clock), fault);
        self.woke(wake, now, to);
    }

    /// Notes that time has not advanced although it should.
    #[cold]
    pub(super) fn stood_still(&mut self, now: Instant, to: &mut [&mut dyn Observer]) {
        self.still = self.still.saturating_add(1);
        // The time of a real robot passes by itself.
        if self.still >= PATIENCE && self.stall.is_none() {
            self.distrust(STUCK, to);
            // The session must not wait for such a robot to come to rest.
            self.last = now;
        }
    }

    /// Calls `drive`. If a component panics, the plan cannot be trusted: the run ends, and the
    /// caller calls again. Other panics continue.
    pub(super) fn guarded(
        &mut self,
        to: &mut [&mut dyn Observer],
        mut drive: impl FnMut(&mut Self, &mut [&mut dyn Observer]) -> Result<Go, StartError>,
    ) -> Result<Go, StartError> {
        match catch_unwind(AssertUnwindSafe(|| drive(self, to))) {
            Ok(went) => went,
            Err(panic) if !self.stepping => resume_unwind(panic),
            Err(_) => {
                self.stepping = false;
                self.abort(Fault::PANIC, to);
                Ok(Go::Again)
            }
        }
    }

    /// Notes that time has passed.
    #[inline]
    pub(super) fn passes(&mut self, now: Instant) {
        self.passed = now;
        if let Some(pulse) = &self.pulse {
            pulse.beat(now);
        }
    }

    /// Ends the plan if the control loop of a real robot is too late: the world has changed
    /// meanwhile, so the robot must not drive on. Returns whether it ended the plan.
    #[inline]
    pub(super) fn has_stalled(&mut self, late: Duration, to: &mut [&mut dyn Observer]) -> bool {
        let is_cut = self.pulse.as_ref().is_some_and(|pulse| pulse.is_cut());
        let stalled = self.started && self.stall.is_some_and(|stall| late > stall || is_cut);
        let ends = stalled && self.ending().is_none();
        if ends {
            self.abort(STALLED, to);
        }
        ends
    }

    /// Ends the plan, unless it has ended, because of a fault in the robot's Rust code.
    pub(super) fn distrust(&mut self, fault: Fault, to: &mut [&mut dyn Observer]) {
        if self.ending().is_none() {
            self.abort(fault, to);
        }
    }
}
