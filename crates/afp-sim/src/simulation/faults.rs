//! The beginning and end of faults.

use super::Simulation;
use crate::vehicle::drive::Health;
use afp_carbot::table::Fault;
use afp_core::{Duration, Instant};
use afp_session::Active;

impl Simulation {
    /// Injects a fault at an instant, or now if the instant has passed, for a duration.
    /// [`Duration::MAX`] is permanent.
    ///
    /// At one instant, physics comes first, then the fault, then readings. If two defects affect
    /// one sensor, the later one counts.
    pub fn inject(&mut self, fault: Fault, from: Instant, during: Duration) {
        let from = from.max(self.now);
        self.faults.add(fault, from, from + during);
        if from == self.now {
            self.break_and_mend();
        }
    }

    pub(super) fn break_and_mend(&mut self) {
        let mut faults = std::mem::take(&mut self.faults);
        self.apply_faults(&faults.advance(self.now));
        self.faults = faults;
    }

    pub(crate) fn apply_faults(&mut self, active: &Active<'_, Fault>) {
        // After a restart it obeys nothing, until another run begins.
        self.restarted |= active.any(|fault| fault == Fault::ControllerRestarted);
        self.drive.set_health(Health {
            dead: active.any(|fault| fault == Fault::ControllerDead),
            halted: self.restarted || active.any(|fault| fault == Fault::ControllerStalled),
            stalled: [Fault::LeftMotorStalled, Fault::RightMotorStalled]
                .map(|stalled| active.any(|fault| fault == stalled)),
            grip: least(active, Fault::wheels_slip),
        });
        self.sensors.rotator.set_stuck(active.any(|fault| fault == Fault::RotatorStuck));
        self.sensors.battery.limit(least(active, Fault::battery_low));
        self.set_lines(active);
    }
}

/// The least of some shares, within 0 to 1. A share that is not a number counts as 0.
fn least(active: &Active<'_, Fault>, share: fn(Fault) -> Option<f64>) -> f64 {
    let shares = active.iter().filter_map(share);
    shares.fold(1.0, |least, share| if share > 0.0 { least.min(share) } else { 0.0 })
}
