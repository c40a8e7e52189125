//! A front wheel, which steers and drives independently.
//!
//! It pushes the body at its contact with the floor, see [`super::floor`].

use super::floor::{Demand, Motor};
use super::servo::Servo;
use crate::chassis::MASS;

/// The time constant of a motor, in seconds, and its maximum acceleration, in metres a second
/// squared.
const MOTOR_LAG: f64 = 0.06;
const MOTOR_ACCELERATION: f64 = 2.0;
/// Steering servos: reach, radians, and rate, radians a second.
const STEER_REACH: f64 = 1.75;
const STEER_RATE: f64 = 7.0;
/// The maximum friction of a wheel, in newtons.
const FRICTION: f64 = 0.7 * MASS * 9.81 / 4.0;
/// The maximum push of a motor, in newtons at the rim: less than friction, so a blocked wheel does
/// not turn.
const MOTOR_FORCE: f64 = 6.5;

/// Below this speed, the gear holds a wheel that should stop, in metres a second.
const HELD: f64 = 0.005;

#[derive(Clone, Debug)]
pub(crate) struct Wheel {
    /// The distance ahead of the turning centre and to its left, in metres.
    at: [f64; 2],
    steering: Servo,
    /// The rolling direction.
    direction: (f64, f64),
    /// The speed of the rim.
    speed: f64,
    /// The commanded velocity of the contact.
    wanted: (f64, f64),
    stalled: bool,
}

impl Wheel {
    pub(super) fn new(at: [f64; 2]) -> Self {
        Wheel {
            at,
            steering: Servo::new(STEER_REACH, STEER_RATE),
            direction: (1.0, 0.0),
            speed: 0.0,
            wanted: (0.0, 0.0),
            stalled: false,
        }
    }

    /// The distance ahead of the turning centre and to its left, in metres.
    pub(crate) fn at(&self) -> [f64; 2] {
        self.at
    }

    /// The rim's velocity in the body's frame, as in the wheel counter.
    pub(crate) fn velocity(&self) -> (f64, f64) {
        (self.speed * self.direction.0, self.speed * self.direction.1)
    }

    /// The commanded velocity of the contact in the body's frame.
    pub(crate) fn commanded(&self) -> (f64, f64) {
        self.wanted
    }

    /// Sets the contact's velocity from the body's commanded motion.
    pub(super) fn obey(&mut self, speed: f64, turn: f64) {
        let (x, y) = (speed - turn * self.at[1], turn * self.at[0]);
        self.wanted = (x, y);
        if x * x + y * y < 1e-8 {
            return;
        }
        let ahead = libm::atan2(y, x);
        let back =
            if ahead > 0.0 { ahead - core::f64::consts::PI } else { ahead + core::f64::consts::PI };
        let here = self.steering.position();
        let nearer = if (ahead - here).abs() <= (back - here).abs() { ahead } else { back };
        // The two directions are half a turn apart, so one is always within reach.
        let other = if nearer == ahead { back } else { ahead };
        self.steering.aim(if nearer.abs() <= STEER_REACH { nearer } else { other });
    }

    /// Steers and drives for `dt` seconds, at the share `power` of the wanted speed.
    pub(super) fn step(&mut self, power: f64, dt: f64) {
        if self.steering.step(dt) {
            let (sin, cos) = libm::sincos(self.steering.position());
            self.direction = (cos, sin);
        }
        // While the wheel steers, it drives only with the useful part of its direction.
        let target = power * (self.wanted.0 * self.direction.0 + self.wanted.1 * self.direction.1);
        let limit = MOTOR_ACCELERATION * dt;
        self.speed += ((target - self.speed) * (dt / MOTOR_LAG)).clamp(-limit, limit);
        if self.stalled {
            self.speed = 0.0;
        }
    }

    pub(super) fn set_stalled(&mut self, stalled: bool) {
        self.stalled = stalled;
    }

    pub(super) fn block(&mut self) {
        self.speed = 0.0;
    }

    /// The speed of its rim, in metres a second.
    pub(crate) fn speed(&self) -> f64 {
        self.speed
    }

    /// The contact's demand for no slip, with this share of the grip.
    pub(super) fn demand(&self, grip: f64) -> Demand {
        let motor = Motor { direction: self.direction, force: MOTOR_FORCE };
        // The gear holds a wheel that should stop and has nearly stopped.
        let held = self.stalled || (self.wanted == (0.0, 0.0) && self.speed.abs() < HELD);
        let motor = (!held).then_some(motor);
        Demand { rim: self.velocity(), most: FRICTION * grip, motor }
    }

    /// The direction in which it rolls, in the body's frame.
    pub(super) fn direction(&self) -> (f64, f64) {
        self.direction
    }

    /// Turns with the floor if the motor is too weak.
    pub(super) fn give_way(&mut self, speed: f64) {
        self.speed = speed;
    }
}
