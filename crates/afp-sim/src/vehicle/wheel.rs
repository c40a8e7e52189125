//! One of the two wheels in front: it steers and drives by itself.
//!
//! It pushes the body where it touches the floor, see [`super::floor`].

use super::floor::{Demand, Motor};
use super::servo::Servo;
use crate::chassis::MASS;

/// The wheels stand this far before the turning centre and to its sides, metres.
pub(crate) const WHEEL_X: f64 = 0.13;
pub(crate) const WHEEL_Y: f64 = 0.14;
/// A motor follows its command with this time constant, seconds, and no faster than this,
/// metres a second squared.
const MOTOR_LAG: f64 = 0.06;
const MOTOR_ACCELERATION: f64 = 2.0;
/// Steering servos: reach, radians, and rate, radians a second.
const STEER_REACH: f64 = 1.75;
const STEER_RATE: f64 = 7.0;
/// The most that a wheel's friction holds, newtons.
const FRICTION: f64 = 0.7 * MASS * 9.81 / 4.0;
/// The most that a motor pushes, newtons at the rim: less than friction holds, so a blocked wheel stands.
const MOTOR_FORCE: f64 = 6.5;

/// Slower than this a wheel is held by its gear where it is to stand, metres a second.
const HELD: f64 = 0.005;

/// A wheel that steers and drives.
#[derive(Clone, Debug)]
pub(crate) struct Wheel {
    pub(super) y: f64,
    steering: Servo,
    /// Direction it rolls in.
    direction: (f64, f64),
    /// How fast its rim goes.
    speed: f64,
    /// How the command wants its contact patch to move.
    wanted: (f64, f64),
    stalled: bool,
}

impl Wheel {
    pub(super) fn new(y: f64) -> Self {
        Wheel {
            y,
            steering: Servo::new(STEER_REACH, STEER_RATE),
            direction: (1.0, 0.0),
            speed: 0.0,
            wanted: (0.0, 0.0),
            stalled: false,
        }
    }

    /// The rim's velocity in the body's frame, as a counter on the wheel sees it.
    pub(crate) fn velocity(&self) -> (f64, f64) {
        (self.speed * self.direction.0, self.speed * self.direction.1)
    }

    /// Wants the patch to move as a body with this command would move it.
    pub(super) fn obey(&mut self, speed: f64, turn: f64) {
        let (x, y) = (speed - turn * self.y, turn * WHEEL_X);
        self.wanted = (x, y);
        if x * x + y * y < 1e-8 {
            return;
        }
        let ahead = libm::atan2(y, x);
        let back =
            if ahead > 0.0 { ahead - core::f64::consts::PI } else { ahead + core::f64::consts::PI };
        let here = self.steering.position();
        let nearer = if (ahead - here).abs() <= (back - here).abs() { ahead } else { back };
        // Both lie half a turn apart, so one is always within reach.
        let other = if nearer == ahead { back } else { ahead };
        self.steering.aim(if nearer.abs() <= STEER_REACH { nearer } else { other });
    }

    /// Steers and drives for `dt` seconds, at the share `power` of the wanted speed.
    pub(super) fn step(&mut self, power: f64, dt: f64) {
        if self.steering.step(dt) {
            let (sin, cos) = libm::sincos(self.steering.position());
            self.direction = (cos, sin);
        }
        // A wheel that still steers drives only as far as its direction serves.
        let target = power * (self.wanted.0 * self.direction.0 + self.wanted.1 * self.direction.1);
        let limit = MOTOR_ACCELERATION * dt;
        self.speed += ((target - self.speed) * (dt / MOTOR_LAG)).clamp(-limit, limit);
        if self.stalled {
            self.speed = 0.0;
        }
    }

    /// Blocks the motor, or frees it.
    pub(super) fn set_stalled(&mut self, stalled: bool) {
        self.stalled = stalled;
    }

    /// Stands at once.
    pub(super) fn block(&mut self) {
        self.speed = 0.0;
    }

    /// How fast its rim goes, metres a second.
    pub(crate) fn speed(&self) -> f64 {
        self.speed
    }

    /// That its patch slips nowhere, with this share of the grip.
    pub(super) fn demand(&self, grip: f64) -> Demand {
        let motor = Motor { direction: self.direction, force: MOTOR_FORCE };
        // A wheel that is to stand and all but does is held by its gear.
        let held = self.stalled || (self.wanted == (0.0, 0.0) && self.speed.abs() < HELD);
        let motor = (!held).then_some(motor);
        Demand { rim: self.velocity(), most: FRICTION * grip, motor }
    }

    /// The direction in which it rolls, in the body's frame.
    pub(super) fn direction(&self) -> (f64, f64) {
        self.direction
    }

    /// Turns as the floor lets it, where the motor is too weak.
    pub(super) fn give_way(&mut self, speed: f64) {
        self.speed = speed;
    }
}
