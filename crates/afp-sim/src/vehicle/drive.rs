//! The drive: the controller that obeys driving commands, and what its wheels do to the body.
//!
//! Two wheels in front steer and drive independently, two castors roll along behind. The
//! controller turns a command (speed, turn rate) into the direction and speed of each wheel, and
//! stops by itself when commands cease.

use super::MASS;
use super::wheel::{Push, Twist, WHEEL_X, WHEEL_Y, Wheel, limited};
use afp_core::{Duration, Instant};

/// Without a new command for so long the controller stops the robot.
pub(crate) const DEAD_MAN: Duration = Duration::from_millis(200);
/// Top speed, metres a second.
pub(crate) const TOP_SPEED: f64 = 0.31;
/// The fastest turn, radians a second.
const TOP_TURN: f64 = 1.8;
/// A castor's resistance: force per speed, and the most of it, newtons.
const CASTOR: f64 = 30.0;
const ROLLING: f64 = 0.02 * MASS * 9.81 / 4.0;

/// The drive with its controller.
#[derive(Debug)]
pub(crate) struct Drive {
    wheels: [Wheel; 2],
    command: (f64, f64),
    commanded: Instant,
    /// The last command, whatever became of it.
    asked: (f64, f64),
    health: Health,
}

/// What faults and the battery leave of the drive.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Health {
    /// The controller hears no command.
    pub(crate) dead: bool,
    /// The left and the right motor are blocked.
    pub(crate) stalled: [bool; 2],
    /// The share of the grip that is left.
    pub(crate) grip: f64,
}

impl Default for Health {
    fn default() -> Self {
        Health { dead: false, stalled: [false; 2], grip: 1.0 }
    }
}

impl Drive {
    pub(crate) fn new() -> Self {
        Drive {
            wheels: [Wheel::new(WHEEL_Y), Wheel::new(-WHEEL_Y)],
            command: (0.0, 0.0),
            commanded: Instant::ZERO,
            asked: (0.0, 0.0),
            health: Health::default(),
        }
    }

    pub(crate) fn wheels(&self) -> &[Wheel; 2] {
        &self.wheels
    }

    /// The last command, metres and radians a second; zeros before the first. Neither a controller that
    /// is dead nor one that stops by itself changes it.
    pub(crate) fn asked(&self) -> (f64, f64) {
        self.asked
    }

    /// Takes a command; one that is not finite means a standstill.
    pub(crate) fn command(&mut self, speed: f64, turn: f64, now: Instant) {
        let sound = speed.is_finite() && turn.is_finite();
        let (speed, turn) = if sound { (speed, turn) } else { (0.0, 0.0) };
        self.asked = (speed, turn);
        if self.health.dead {
            return;
        }
        self.commanded = now;
        self.obey(speed.clamp(-TOP_SPEED, TOP_SPEED), turn.clamp(-TOP_TURN, TOP_TURN));
    }

    /// Blocks the wheels at once.
    pub(crate) fn block(&mut self) {
        self.asked = (0.0, 0.0);
        self.obey(0.0, 0.0);
        for wheel in &mut self.wheels {
            wheel.block();
        }
    }

    /// Breaks or mends parts of it.
    pub(crate) fn set_health(&mut self, health: Health) {
        self.health = health;
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
    /// speed; returns what pushes the body.
    pub(crate) fn step(&mut self, body: Twist, now: Instant, power: f64, dt: f64) -> Push {
        if now.since(self.commanded) > DEAD_MAN {
            self.obey(0.0, 0.0);
        }
        let mut push = Push::default();
        for wheel in &mut self.wheels {
            wheel.step(power, dt);
            push.add(wheel.force(body, self.health.grip), (WHEEL_X, wheel.y));
        }
        for y in [WHEEL_Y, -WHEEL_Y] {
            let (vx, vy) = (body.x - body.turn * y, body.y - body.turn * WHEEL_X);
            push.add(limited(-CASTOR * vx, -CASTOR * vy, ROLLING), (-WHEEL_X, y));
        }
        push
    }
}
