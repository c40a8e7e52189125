//! The rotator that turns the range sensor, and its telemetry.

use crate::vehicle::servo::Servo;
use afp_core::quantity::Angle;

/// The maximum angle to either side, in radians, and the rate, in radians a second.
const REACH: f64 = 130.0 / 180.0 * core::f64::consts::PI;
const RATE: f64 = 300.0 / 180.0 * core::f64::consts::PI;
/// The resolution of its telemetry, in radians.
const RESOLUTION: f64 = 0.25 / 180.0 * core::f64::consts::PI;

#[derive(Clone, Debug)]
pub(crate) struct Rotator {
    servo: Servo,
    stuck: bool,
}

impl Rotator {
    pub(crate) fn new() -> Self {
        Rotator { servo: Servo::new(REACH, RATE), stuck: false }
    }

    pub(crate) fn aim(&mut self, bearing: f64) {
        self.servo.aim(bearing);
    }

    pub(crate) fn hold(&mut self) {
        self.servo.hold();
    }

    pub(crate) fn set_stuck(&mut self, stuck: bool) {
        self.stuck = stuck;
    }

    pub(crate) fn step(&mut self, dt: f64) {
        if !self.stuck {
            self.servo.step(dt);
        }
    }

    /// Its angle relative to the heading, in radians.
    pub(crate) fn position(&self) -> f64 {
        self.servo.position()
    }

    pub(crate) fn telemetry(&self) -> Angle {
        let steps = libm::round(self.position() / RESOLUTION);
        Angle::from_si(steps * RESOLUTION)
    }
}
