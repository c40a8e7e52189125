//! The drive: the controller for driving commands, and the wheels' effect on the body.
//!
//! Two wheels in front steer and drive independently, and two castors follow. Wheels on the axis of
//! the turning centre only drive, with castors at both ends. A car has limits for its curves. The
//! controller turns a command (speed, turn rate) into the direction and speed of each wheel. It
//! stops the robot if the commands cease.

use super::floor::{Demand, Footing};
use super::wheel::Wheel;
use super::{Push, Twist};
use crate::chassis::{MASS, Measures};
use afp_core::{Duration, Instant};

/// Without a new command for this time, the controller stops the robot.
pub(crate) const DEAD_MAN: Duration = Duration::from_millis(200);
/// A castor's rolling resistance, in newtons.
const ROLLING: f64 = 0.02 * MASS * 9.81 / 4.0;

#[derive(Clone, Debug)]
pub(crate) struct Drive {
    measures: Measures,
    wheels: [Wheel; 2],
    /// The contacts of the wheels, then of the castors.
    footing: Footing<4>,
    command: (f64, f64),
    commanded: Instant,
    asked: (f64, f64),
    health: Health,
}

/// The effect of faults and the battery on the drive.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Health {
    /// The controller ignores commands.
    pub(crate) dead: bool,
    /// The controller has stopped the wheels and ignores commands.
    pub(crate) halted: bool,
    /// The left and the right motor are blocked.
    pub(crate) stalled: [bool; 2],
    /// The remaining share of the grip.
    pub(crate) grip: f64,
}

impl Default for Health {
    fn default() -> Self {
        Health { dead: false, halted: false, stalled: [false; 2], grip: 1.0 }
    }
}

impl Drive {
    pub(crate) fn new(measures: &Measures) -> Self {
        let [x, y] = measures.wheels;
        let inertia = measures.chassis().inertia();
        let castors = match x > 0.0 {
            // The rear wheels of a car are on the axis of the turning centre.
            true if measures.narrowest > 0.0 => [(0.0, y), (0.0, -y)],
            true => [(-x, y), (-x, -y)],
            false => [(measures.half[0], 0.0), (-measures.half[0], 0.0)],
        };
        Drive {
            measures: *measures,
            wheels: [Wheel::new([x, y]), Wheel::new([x, -y])],
            footing: Footing::new(MASS, inertia, [(x, y), (x, -y), castors[0], castors[1]]),
            command: (0.0, 0.0),
            commanded: Instant::ZERO,
            asked: (0.0, 0.0),
            health: Health::default(),
        }
    }

    pub(crate) fn wheels(&self) -> &[Wheel; 2] {
        &self.wheels
    }

    /// The last command, in metres and radians a second; zeros before the first. A dead controller
    /// and an automatic stop do not change it.
    pub(crate) fn asked(&self) -> (f64, f64) {
        self.asked
    }

    /// Takes a command; a command that is not finite stops the robot.
    pub(crate) fn command(&mut self, speed: f64, turn: f64, now: Instant) {
        let finite = speed.is_finite() && turn.is_finite();
        let (speed, turn) = if finite { (speed, turn) } else { (0.0, 0.0) };
        self.asked = (speed, turn);
        if self.health.dead || self.health.halted {
            return;
        }
        self.commanded = now;
        let (speed, turn) = self.reduced(speed, turn);
        self.obey(speed, turn);
    }

    /// The command as the wheels follow it.
    pub(crate) fn reduced(&self, speed: f64, turn: f64) -> (f64, f64) {
        reduced(&self.measures, speed, turn)
    }

    /// Blocks the wheels immediately.
    pub(crate) fn block(&mut self) {
        self.asked = (0.0, 0.0);
        self.obey(0.0, 0.0);
        for wheel in &mut self.wheels {
            wheel.block();
        }
    }

    pub(crate) fn set_health(&mut self, health: Health) {
        self.health = health;
        if health.halted {
            self.obey(0.0, 0.0);
        }
        for (wheel, stalled) in self.wheels.iter_mut().zip(health.stalled) {
            wheel.set_stalled(stalled);
        }
    }

    fn obey(&mut self, speed: f64, turn: f64) {
        if self.command == (speed, turn) {
            return;
        }
        self.command = (speed, turn);
        for wheel in &mut self.wheels {
            wheel.obey(speed, turn);
        }
    }

    /// Moves wheels and motors for `dt` seconds up to `now`, at the share `power` of the wanted
    /// speed. Returns the push on the body.
    pub(crate) fn step(&mut self, body: Twist, now: Instant, power: f64, dt: f64) -> Push {
        if now.since(self.commanded) > DEAD_MAN {
            self.obey(0.0, 0.0);
        }
        for wheel in &mut self.wheels {
            wheel.step(power, dt);
        }
        let [left, right] = self.wheels.each_ref().map(|wheel| wheel.demand(self.health.grip));
        let castor = Demand { rim: (0.0, 0.0), most: ROLLING, motor: None };
        let push = self.footing.push([left, right, castor, castor], body, dt);
        for (at, wheel) in self.wheels.iter_mut().enumerate() {
            if let Some(speed) = self.footing.yielding(at, wheel.direction()) {
                wheel.give_way(speed);
            }
        }
        push
    }
}

/// The command on the same curve, reduced so that no wheel exceeds the top speed. A curve that is
/// too narrow for a car becomes its narrowest one.
fn reduced(measures: &Measures, speed: f64, turn: f64) -> (f64, f64) {
    let [x, y] = measures.wheels;
    let turn = match measures.narrowest > 0.0 {
        true => {
            let most = speed.abs() / measures.narrowest;
            turn.max(-most).min(most)
        }
        false => turn,
    };
    // The sum of quarters of two finite values is always finite.
    let (ahead, across) = (speed.abs() / 4.0 + turn.abs() / 4.0 * y, turn / 4.0 * x);
    let outer = libm::hypot(ahead, across);
    let top = measures.fastest / 4.0;
    if outer <= top {
        return (speed, turn);
    }
    (speed / outer * top, turn / outer * top)
}

#[cfg(test)]
mod tests {
    use super::*;

    const CARBOT: Measures = Measures::CARBOT;
    const TOP_SPEED: f64 = CARBOT.fastest;

    /// The speed of the faster wheel's rim for a command.
    fn rim((speed, turn): (f64, f64)) -> f64 {
        let [x, y] = CARBOT.wheels;
        let at = |y: f64| (speed - turn * y).hypot(turn * x);
        at(y).max(at(-y))
    }

    #[test]
    fn a_command_within_the_limits_is_not_changed() {
        for command in [(0.0, 0.0), (TOP_SPEED, 0.0), (-TOP_SPEED, 0.0), (0.2, -0.6), (0.0, 1.6)] {
            assert_eq!(reduced(&CARBOT, command.0, command.1), command);
        }
    }

    #[test]
    fn a_reduced_command_has_one_wheel_at_top_speed_and_the_same_radius() {
        for speed in [0.31, -0.31, 0.2, 0.05, 5.0, -1e300, f64::MAX] {
            for turn in [1.8, -1.8, 3.0, 1e3, -f64::MAX] {
                let (slower, slighter) = reduced(&CARBOT, speed, turn);
                let what = format!("{speed} m/s, {turn} rad/s: {slower} m/s, {slighter} rad/s");
                assert!((rim((slower, slighter)) - TOP_SPEED).abs() < 1e-9, "{what}");
                let (radius, wanted) = (slower / slighter, speed / turn);
                assert!(
                    radius == wanted || (radius / wanted - 1.0).abs() < 1e-9,
                    "{what}: {radius}"
                );
            }
        }
    }

    #[test]
    fn a_car_does_not_turn_in_place() {
        let car = Measures { wheels: [0.0872, 0.058], narrowest: 0.151, ..CARBOT };
        assert_eq!(reduced(&car, 0.0, 1.0), (0.0, 0.0));
        assert_eq!(reduced(&car, 0.1, 0.5), (0.1, 0.5));
        let (speed, turn) = reduced(&car, -0.1, -5.0);
        assert!((speed / turn - 0.151).abs() < 1e-9, "{speed} {turn}");
    }
}
