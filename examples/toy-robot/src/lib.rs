//! A robot of a few lines: it rolls without inertia through an empty rectangular room, measures
//! almost exactly and never slips. It has the devices of the Carbot, so it runs the Carbot's plans
//! unchanged.

use afp::quantity::{Angle, AngularSpeed, Length, Speed};
use afp::{Duration, Environment, Instant, Platform, StillClock};
use afp_carbot::devices::{
    Beam, Body, Button, Buttons, Echo, Motion, Navigator, Odometry, Reading, RotatingTelemetry,
    Rotator, TouchSensor, Ultrasonic,
};

/// Half the robot's length and width, in metres.
const HALF: (f64, f64) = (0.2, 0.175);
/// The corner of the room opposite the origin, in metres.
pub const ROOM: (f64, f64) = (4.0, 3.0);
/// The validity of a command.
const DEAD_MAN: Duration = Duration::from_millis(200);
/// The largest error of its ranges, in metres; an exactly repeated value would look like a frozen
/// sensor.
const RIPPLE: f64 = 0.0001;
/// The largest step of a motion.
const TICK: Duration = Duration::from_millis(5);

/// The robot.
#[derive(Clone, Debug)]
pub struct Toy {
    now: Instant,
    /// Position in the room, metres.
    pub position: (f64, f64),
    /// Heading, radians.
    pub heading: f64,
    command: (f64, f64),
    commanded: Instant,
    bearing: f64,
    touched: bool,
    /// Whether the escape button is held.
    pub escape: bool,
}

impl Toy {
    /// A robot in the middle of the room, heading along x.
    pub fn new() -> Self {
        Toy {
            now: Instant::ZERO,
            position: (ROOM.0 / 2.0, ROOM.1 / 2.0),
            heading: 0.0,
            command: (0.0, 0.0),
            commanded: Instant::ZERO,
            bearing: 0.0,
            touched: false,
            escape: false,
        }
    }

    /// Distance from the right side to the wall next to it, in metres.
    pub fn right_gap(&self) -> f64 {
        self.range(-90f64.to_radians(), 0.0) - HALF.1
    }

    fn roll(&mut self, seconds: f64) {
        if self.now - self.commanded > DEAD_MAN {
            self.command = (0.0, 0.0);
        }
        let (speed, turn) = self.command;
        self.heading += turn * seconds;
        let (sin, cos) = self.heading.sin_cos();
        let ahead = self.range(0.0, 0.0) - HALF.0;
        self.touched = speed > 0.0 && ahead <= 0.0;
        let way = if speed > 0.0 { (speed * seconds).min(ahead.max(0.0)) } else { speed * seconds };
        let keep = |at: f64, size: f64| at.clamp(HALF.1, size - HALF.1);
        let (x, y) = (self.position.0 + way * cos, self.position.1 + way * sin);
        self.position = (keep(x, ROOM.0), keep(y, ROOM.1));
    }

    /// Distance from a point `forward` of the centre to the nearest wall along a bearing.
    fn range(&self, bearing: f64, forward: f64) -> f64 {
        let (sin, cos) = self.heading.sin_cos();
        let (x, y) = (self.position.0 + forward * cos, self.position.1 + forward * sin);
        let (sin, cos) = (self.heading + bearing).sin_cos();
        let along = |at: f64, size: f64, step: f64| match step {
            step if step > 1e-9 => (size - at) / step,
            step if step < -1e-9 => -at / step,
            _ => f64::INFINITY,
        };
        along(x, ROOM.0, cos).min(along(y, ROOM.1, sin))
    }
}

impl Default for Toy {
    fn default() -> Self {
        Toy::new()
    }
}

impl Environment for Toy {
    fn stop(&mut self, _: Instant) {
        self.command = (0.0, 0.0);
    }

    fn emergency_stop(&mut self) {
        self.command = (0.0, 0.0);
    }
}

impl Platform for Toy {
    type Clock = StillClock;

    fn clock(&self) -> StillClock {
        StillClock
    }

    fn now(&self) -> Instant {
        self.now
    }

    fn advance(&mut self, to: Instant) {
        while self.now < to {
            let next = to.min(self.now + TICK);
            self.roll((next - self.now).as_secs_f64());
            self.now = next;
        }
    }
}

impl Navigator for Toy {
    fn drive(&mut self, speed: Speed, turn: AngularSpeed, now: Instant) {
        self.command = (speed.si(), turn.si());
        self.commanded = now;
    }

    fn body(&self) -> Body {
        let (length, width) = (Length::from_si(HALF.0), Length::from_si(HALF.1));
        Body { front: length, rear: length, half_width: width }
    }
}

impl Odometry for Toy {
    fn motion(&self) -> Reading<Motion> {
        let motion = Motion {
            x: Length::from_si(self.position.0),
            y: Length::from_si(self.position.1),
            heading: Angle::from_si(self.heading),
            speed: Speed::from_si(self.command.0),
            turn: AngularSpeed::from_si(self.command.1),
        };
        Reading::valid(motion, self.now)
    }
}

impl Ultrasonic for Toy {
    fn echo(&self) -> Reading<Echo> {
        let beam = self.beam();
        let bearing = Angle::from_si(self.bearing);
        // Equal at equal times, and soon different.
        let ripple = RIPPLE * (1000.0 * self.now.as_secs_f64()).sin();
        let range = self.range(self.bearing, beam.forward.si()) + ripple;
        let echo = beam.echo(range, bearing).unwrap_or(Echo { distance: None, bearing });
        Reading::valid(echo, self.now)
    }

    fn beam(&self) -> Beam {
        Beam {
            forward: Length::from_si(0.1),
            opening: Angle::from_deg(1.0),
            min: Length::from_si(0.0),
            max: Length::from_si(4.0),
        }
    }
}

impl Rotator for Toy {
    fn point(&mut self, bearing: Angle, _: Instant) {
        self.bearing = bearing.si();
    }
}

impl RotatingTelemetry for Toy {
    fn bearing(&self) -> Reading<Angle> {
        Reading::valid(Angle::from_si(self.bearing), self.now)
    }
}

impl TouchSensor for Toy {
    fn touched(&self) -> Reading<bool> {
        Reading::valid(self.touched, self.now)
    }
}

impl Buttons for Toy {
    fn pressed(&self, button: Button) -> Reading<bool> {
        match button {
            Button::Escape => Reading::valid(self.escape, self.now),
        }
    }
}
