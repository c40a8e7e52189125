//! Runs that lost their trust end in `Error`: a component panics, the robot's own Rust is wrong, or the control
//! loop of a real robot is late.

use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};

use afp_core::rt::{NamedPlan, Plan};
use afp_core::{Duration, Fault, Instant, Reason, StartError};

use super::Session;
use crate::observer::{Go, Observer};
use crate::record::Keep;
use crate::robot::Robot;

/// So often in a row the time of a simulated robot may stand still.
const PATIENCE: u32 = 1_000;

/// The time of a simulated robot does not go on.
const STUCK: Fault = Fault::new(&Reason {
    code: "robot-stuck",
    text: "the robot's time does not go on: 'advance' must bring 'now' up to the instant",
});

/// The control loop of a real robot came too late.
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
    /// Time was to pass up to an instant and has not.
    #[cold]
    pub(super) fn stood_still(&mut self, now: Instant, to: &mut [&mut dyn Observer]) {
        self.still = self.still.saturating_add(1);
        // That of a robot that is there passes by itself.
        if self.still >= PATIENCE && self.stall.is_none() {
            self.distrust(STUCK, to);
            // A robot that never comes to rest is not waited for.
            self.last = now;
        }
    }

    /// Does something with this session. Where a component panics meanwhile, nothing of the plan can be trusted any
    /// more: the run ends, and there is more to do. A panic of anybody else goes on.
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

    /// Time has passed.
    #[inline]
    pub(super) fn passes(&mut self, now: Instant) {
        self.passed = now;
        if let Some(pulse) = &self.pulse {
            pulse.beat(now);
        }
    }

    /// Ends the plan if the control loop of a real robot is too late: it must not drive on, because the world has changed
    /// meanwhile. Whether it did.
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

    /// Ends the plan, if it has not ended, because of what the robot's own Rust did.
    pub(super) fn distrust(&mut self, fault: Fault, to: &mut [&mut dyn Observer]) {
        if self.ending().is_none() {
            self.abort(fault, to);
        }
    }
}
