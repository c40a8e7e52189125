//! Dead reckoning from the wheels' counters.
//!
//! Its errors are realistic: the controller's wheel size and track width are slightly wrong, the
//! wheels slip, and the counts are noisy.
//!
//! Without encoders, it counts the commanded speeds. Such an estimate does not notice that the motors
//! need time, that a wheel slips or that the robot pushes against a wall. In addition, no two robots
//! drive equally fast with the same power.

use crate::noise::{Noise, Source};
use crate::vehicle::wheel::Wheel;
use afp_carbot::devices::Motion;
use afp_core::quantity::{Angle, AngularSpeed, Length, Speed};

/// Standard deviations of the robots' calibration: wheel size and track width.
const SCALE: f64 = 0.006;
const TRACK: f64 = 0.008;
/// The same for robots without encoders: the speed at a power, and the steering. Assumed.
const ESTIMATED: [f64; 2] = [0.08, 0.08];
/// Standard deviation of the counts of one step, as a share of the speed.
const COUNTS: f64 = 0.03;

#[derive(Clone, Debug)]
pub(crate) struct Odometer {
    noise: Noise,
    scale: f64,
    turn_scale: f64,
    encoders: bool,
    x: f64,
    y: f64,
    heading: f64,
    speed: f64,
    turn: f64,
}

impl Odometer {
    pub(crate) fn new(seed: u64, build: &mut Noise, encoders: bool) -> Self {
        let [speed, turn] = if encoders { [SCALE, TRACK] } else { ESTIMATED };
        let scale = 1.0 + speed * build.normal();
        Odometer {
            noise: Source::Odometry.of(seed),
            scale,
            turn_scale: scale * (1.0 + turn * build.normal()),
            encoders,
            x: 0.0,
            y: 0.0,
            heading: 0.0,
            speed: 0.0,
            turn: 0.0,
        }
    }

    /// Counts `dt` seconds of the wheels' motion.
    pub(crate) fn step(&mut self, wheels: &[Wheel; 2], dt: f64) {
        let velocity = if self.encoders { Wheel::velocity } else { Wheel::commanded };
        let ((left_x, left_y), (right_x, right_y)) = (velocity(&wheels[0]), velocity(&wheels[1]));
        // The least-squares motion of the body for both wheels.
        let [x, y] = wheels[0].at();
        let across = y * (right_x - left_x) + x * (left_y + right_y);
        let turn = across / (2.0 * (x * x + y * y));
        let speed = (left_x + right_x) / 2.0;
        if speed == 0.0 && turn == 0.0 {
            (self.speed, self.turn) = (0.0, 0.0);
            return;
        }
        self.speed = speed * self.scale;
        self.turn = turn * self.turn_scale;
        let driven = self.speed * dt * (1.0 + COUNTS * self.noise.normal());
        let angle = self.turn * dt * (1.0 + COUNTS * self.noise.normal());
        let (sin, cos) = libm::sincos(self.heading + angle / 2.0);
        self.x += driven * cos;
        self.y += driven * sin;
        self.heading += angle;
    }

    pub(crate) fn motion(&self) -> Motion {
        Motion {
            x: Length::from_si(self.x),
            y: Length::from_si(self.y),
            heading: Angle::from_si(self.heading),
            speed: Speed::from_si(self.speed),
            turn: AngularSpeed::from_si(self.turn),
        }
    }
}
