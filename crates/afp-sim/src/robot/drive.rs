//! Wheels, their motors and the controller that obeys driving commands.
//!
//! Two wheels in front steer and drive independently, two castors roll along behind. A wheel
//! pushes the body through its contact patch: the force grows with the slip and ends at what
//! friction can hold, in every direction alike. The controller turns a command (speed, turn rate)
//! into the direction and speed of each wheel, and stops by itself when commands cease.

use super::MASS;
use super::servo::Servo;
use afp_core::{Duration, Instant};

/// Without a new command for so long the controller stops the robot.
pub(crate) const DEAD_MAN: Duration = Duration::from_millis(200);
/// Top speed, metres a second.
pub(crate) const TOP_SPEED: f64 = 0.31;
/// The fastest turn, radians a second.
const TOP_TURN: f64 = 1.8;
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
/// A wheel's grip: force per slip, newtons per metre a second, and the most it can hold.
const GRIP: f64 = 150.0;
const FRICTION: f64 = 0.7 * MASS * 9.81 / 4.0;
/// A castor's resistance: force per speed, and the most of it, newtons.
const CASTOR: f64 = 30.0;
const ROLLING: f64 = 0.02 * MASS * 9.81 / 4.0;

/// How the body moves, in its own frame: ahead, to the left, turning.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Twist {
    pub(crate) x: f64,
    pub(crate) y: f64,
    pub(crate) turn: f64,
}

/// What pushes the body, in its own frame: newtons and newton metres about the centre.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Push {
    pub(crate) x: f64,
    pub(crate) y: f64,
    pub(crate) turn: f64,
}

impl Push {
    fn add(&mut self, (fx, fy): (f64, f64), (x, y): (f64, f64)) {
        self.x += fx;
        self.y += fy;
        self.turn += x * fy - y * fx;
    }
}

/// A wheel that steers and drives.
#[derive(Debug)]
pub(crate) struct Wheel {
    y: f64,
    steering: Servo,
    /// Direction it rolls in.
    direction: (f64, f64),
    /// How fast its rim goes.
    speed: f64,
    /// How the command wants its contact patch to move.
    wanted: (f64, f64),
}

impl Wheel {
    fn new(y: f64) -> Self {
        Wheel {
            y,
            steering: Servo::new(STEER_REACH, STEER_RATE),
            direction: (1.0, 0.0),
            speed: 0.0,
            wanted: (0.0, 0.0),
        }
    }

    /// The rim's velocity in the body's frame, as a counter on the wheel sees it.
    pub(crate) fn velocity(&self) -> (f64, f64) {
        (self.speed * self.direction.0, self.speed * self.direction.1)
    }

    /// Wants the patch to move as a body with this command would move it.
    fn obey(&mut self, speed: f64, turn: f64) {
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

    fn step(&mut self, dt: f64) {
        if self.steering.step(dt) {
            let (sin, cos) = libm::sincos(self.steering.position());
            self.direction = (cos, sin);
        }
        // A wheel that still steers drives only as far as its direction serves.
        let target = self.wanted.0 * self.direction.0 + self.wanted.1 * self.direction.1;
        let limit = MOTOR_ACCELERATION * dt;
        self.speed += ((target - self.speed) * (dt / MOTOR_LAG)).clamp(-limit, limit);
    }

    /// The force of the patch on the body that moves like this.
    fn force(&self, body: Twist) -> (f64, f64) {
        let rim = self.velocity();
        let slip_x = body.x - body.turn * self.y - rim.0;
        let slip_y = body.y + body.turn * WHEEL_X - rim.1;
        limited(-GRIP * slip_x, -GRIP * slip_y, FRICTION)
    }
}

/// A force no larger than `most`.
fn limited(x: f64, y: f64, most: f64) -> (f64, f64) {
    let square = x * x + y * y;
    if square <= most * most {
        return (x, y);
    }
    let share = most / libm::sqrt(square);
    (x * share, y * share)
}

/// The drive with its controller.
#[derive(Debug)]
pub(crate) struct Drive {
    wheels: [Wheel; 2],
    command: (f64, f64),
    commanded: Instant,
}

impl Drive {
    pub(crate) fn new() -> Self {
        Drive {
            wheels: [Wheel::new(WHEEL_Y), Wheel::new(-WHEEL_Y)],
            command: (0.0, 0.0),
            commanded: Instant::ZERO,
        }
    }

    pub(crate) fn wheels(&self) -> &[Wheel; 2] {
        &self.wheels
    }

    /// Takes a command; one that is not finite means a standstill.
    pub(crate) fn command(&mut self, speed: f64, turn: f64, now: Instant) {
        let sound = speed.is_finite() && turn.is_finite();
        let (speed, turn) = if sound { (speed, turn) } else { (0.0, 0.0) };
        self.commanded = now;
        self.obey(speed.clamp(-TOP_SPEED, TOP_SPEED), turn.clamp(-TOP_TURN, TOP_TURN));
    }

    /// Blocks the wheels at once.
    pub(crate) fn block(&mut self) {
        self.obey(0.0, 0.0);
        for wheel in &mut self.wheels {
            wheel.speed = 0.0;
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

    /// Moves wheels and motors for `dt` seconds up to `now`; returns what pushes the body.
    pub(crate) fn step(&mut self, body: Twist, now: Instant, dt: f64) -> Push {
        if now.since(self.commanded) > DEAD_MAN {
            self.obey(0.0, 0.0);
        }
        let mut push = Push::default();
        for wheel in &mut self.wheels {
            wheel.step(dt);
            push.add(wheel.force(body), (WHEEL_X, wheel.y));
        }
        for y in [WHEEL_Y, -WHEEL_Y] {
            let (vx, vy) = (body.x - body.turn * y, body.y - body.turn * WHEEL_X);
            push.add(limited(-CASTOR * vx, -CASTOR * vy, ROLLING), (-WHEEL_X, y));
        }
        push
    }
}
