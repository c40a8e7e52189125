//! What a robot's own Rust does wrong: nothing that it says or does can be trusted then, and the run ends in `Error`.

use afp_core::rt::{NamedPlan, Plan};
use afp_core::{Fault, Instant, Reason};

use super::Session;
use crate::observer::Observer;
use crate::record::Keep;
use crate::robot::Robot;

/// So often in a row the time of a simulated robot may stand still.
const PATIENCE: u32 = 1_000;

/// The time of a simulated robot does not go on.
const STUCK: Fault = Fault::new(&Reason {
    code: "robot-stuck",
    text: "the robot's time does not go on: 'advance' must bring 'now' up to the instant",
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
        if self.still >= PATIENCE && !self.is_there {
            self.distrust(STUCK, to);
            // A robot that never comes to rest is not waited for.
            self.last = now;
        }
    }

    /// Ends the plan, if it has not ended, because of what the robot's own Rust did.
    pub(super) fn distrust(&mut self, fault: Fault, to: &mut [&mut dyn Observer]) {
        if self.ending().is_none() {
            self.abort(fault, to);
        }
    }
}
