//! The most common drive: two wheels side by side on one axis, and castors for the rest of the
//! weight.

use super::floor::{Demand, Footing, Motor, Push, Twist};
use crate::chassis::Chassis;

/// Below this speed, the gear holds a wheel that should stop, in metres a second.
const HELD: f64 = 0.005;
/// The acceleration of gravity, in metres a second squared.
const GRAVITY: f64 = 9.81;

/// Wheels and motors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WheelModel {
    /// The distance from the middle to either wheel, in metres.
    pub half_track: f64,
    /// The distance from the axis back to the castor, in metres.
    pub castor: f64,
    /// The maximum speed of a rim, in metres a second.
    pub fastest: f64,
    /// A motor follows its command with this time constant, seconds.
    pub lag: f64,
    /// The maximum push of a motor, in newtons at the rim.
    pub force: f64,
    /// The friction coefficient, as a share of the weight on a wheel.
    pub friction: f64,
}

/// Two driven wheels below a body.
#[derive(Clone, Debug)]
pub struct TwoWheels {
    model: WheelModel,
    /// The left and the right wheel, then the castor.
    footing: Footing<3>,
    /// The maximum friction of a wheel and of the castor, in newtons.
    holds: [f64; 2],
    /// The commanded and the actual speeds of the rims, in metres a second.
    asked: [f64; 2],
    rims: [f64; 2],
    /// The rolled distance of each rim, in metres.
    travelled: [f64; 2],
    grip: f64,
    blocked: [bool; 2],
}

impl TwoWheels {
    /// The stationary wheels of a body.
    pub fn new(model: WheelModel, chassis: &Chassis) -> Self {
        let places = [(0.0, model.half_track), (0.0, -model.half_track), (-model.castor, 0.0)];
        // The centre of mass is near the axis.
        let weight = chassis.mass * GRAVITY;
        TwoWheels {
            footing: Footing::new(chassis.mass, chassis.inertia(), places),
            holds: [model.friction * weight * 0.4, 0.02 * weight * 0.2],
            model,
            asked: [0.0; 2],
            rims: [0.0; 2],
            travelled: [0.0; 2],
            grip: 1.0,
            blocked: [false; 2],
        }
    }

    /// Commands a forward speed, in metres a second, and a turn rate, in radians a second. If a rim
    /// would be too fast, both are reduced by the same factor. A command that is not finite stops
    /// the wheels.
    pub fn ask(&mut self, speed: f64, turn: f64) {
        let across = turn * self.model.half_track;
        let wanted = [speed - across, speed + across];
        let fastest = wanted[0].abs().max(wanted[1].abs());
        let share = if fastest > self.model.fastest { self.model.fastest / fastest } else { 1.0 };
        let finite = wanted.iter().all(|rim| rim.is_finite());
        self.asked = if finite { wanted.map(|rim| rim * share) } else { [0.0; 2] };
    }

    /// Blocks the left or the right motor, or frees it.
    pub fn block(&mut self, blocked: [bool; 2]) {
        self.blocked = blocked;
    }

    /// Sets the remaining share of the grip.
    pub fn set_grip(&mut self, grip: f64) {
        self.grip = grip;
    }

    /// The distance ahead, in metres, and the turned angle, in radians, from the wheel counters.
    /// Slip counts.
    pub fn counted(&self) -> [f64; 2] {
        let [left, right] = self.travelled;
        [(left + right) / 2.0, (right - left) / (2.0 * self.model.half_track)]
    }

    /// Drives for `dt` seconds below a body with this motion; returns the push on the body.
    pub fn step(&mut self, body: Twist, dt: f64) -> Push {
        for ((rim, asked), blocked) in self.rims.iter_mut().zip(self.asked).zip(self.blocked) {
            *rim += (asked - *rim) * (dt / self.model.lag).min(1.0);
            if blocked {
                *rim = 0.0;
            }
        }
        let push = self.footing.push([self.demand(0), self.demand(1), self.castor()], body, dt);
        for (n, (rim, travelled)) in self.rims.iter_mut().zip(&mut self.travelled).enumerate() {
            // If its motor is too weak, the floor turns the wheel.
            *rim = self.footing.yielding(n, (1.0, 0.0)).unwrap_or(*rim);
            *travelled += *rim * dt;
        }
        push
    }

    fn demand(&self, wheel: usize) -> Demand {
        let at = |of: &[f64; 2]| of.get(wheel).copied().unwrap_or(0.0);
        let (rim, asked) = (at(&self.rims), at(&self.asked));
        let blocked = self.blocked.get(wheel) == Some(&true);
        let held = blocked || (asked == 0.0 && rim.abs() < HELD);
        let motor = Motor { direction: (1.0, 0.0), force: self.model.force };
        let most = self.holds[0] * self.grip;
        Demand { rim: (rim, 0.0), most, motor: (!held).then_some(motor) }
    }

    fn castor(&self) -> Demand {
        Demand { rim: (0.0, 0.0), most: self.holds[1], motor: None }
    }
}
