//! Devices whose readings and commands the compiler cannot see through.

use core::hint::black_box;

use afp_carbot::devices::{
    Beam, Body, Button, Buttons, Echo, Motion, Navigator, Odometry, Reading, RotatingTelemetry,
    Rotator, TouchSensor, Ultrasonic,
};
use afp_core::quantity::{Angle, AngularSpeed, Length, Speed};
use afp_core::{Environment, Instant};

/// The latest readings and commands.
pub struct Robot {
    /// Whether the plan is asked to stop.
    pub stop_requested: bool,
    pressed: Reading<bool>,
    touched: Reading<bool>,
    motion: Reading<Motion>,
    bearing: Reading<Angle>,
    echo: Reading<Echo>,
}

impl Robot {
    /// Devices that have not measured anything.
    pub fn new() -> Self {
        let at = Instant::ZERO;
        let still = Motion {
            x: Length::from_si(0.0),
            y: Length::from_si(0.0),
            heading: Angle::from_si(0.0),
            speed: Speed::from_si(0.0),
            turn: AngularSpeed::from_si(0.0),
        };
        Robot {
            stop_requested: false,
            pressed: Reading::valid(false, at),
            touched: Reading::valid(false, at),
            motion: Reading::valid(still, at),
            bearing: Reading::valid(Angle::from_si(0.0), at),
            echo: Reading::valid(Echo { distance: None, bearing: Angle::from_si(0.0) }, at),
        }
    }
}

impl Environment for Robot {
    fn stop(&mut self, now: Instant) {
        self.halt(now);
    }

    fn emergency_stop(&mut self) {
        black_box(0.0);
    }
}

impl Navigator for Robot {
    fn drive(&mut self, speed: Speed, turn: AngularSpeed, now: Instant) {
        black_box((speed, turn, now));
    }

    fn body(&self) -> Body {
        let [front, rear, half_width] = black_box([0.2, 0.2, 0.175]).map(Length::from_si);
        Body { front, rear, half_width }
    }
}

impl Odometry for Robot {
    fn motion(&self) -> Reading<Motion> {
        black_box(self.motion)
    }
}

impl Rotator for Robot {
    fn point(&mut self, bearing: Angle, now: Instant) {
        black_box((bearing, now));
    }
}

impl RotatingTelemetry for Robot {
    fn bearing(&self) -> Reading<Angle> {
        black_box(self.bearing)
    }
}

impl TouchSensor for Robot {
    fn touched(&self) -> Reading<bool> {
        black_box(self.touched)
    }
}

impl Buttons for Robot {
    fn pressed(&self, _: Button) -> Reading<bool> {
        black_box(self.pressed)
    }
}

impl Ultrasonic for Robot {
    fn echo(&self) -> Reading<Echo> {
        black_box(self.echo)
    }

    fn beam(&self) -> Beam {
        let [forward, min, max] = black_box([0.1, 0.03, 3.0]).map(Length::from_si);
        Beam { forward, opening: Angle::from_si(black_box(0.5)), min, max }
    }
}
