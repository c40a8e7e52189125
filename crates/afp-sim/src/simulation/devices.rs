//! The simulation as the Carbot's devices.

use super::Simulation;
use crate::robot::{HALF_LENGTH, HALF_WIDTH, sonar};
use afp_carbot::devices::{
    Beam, Body, Button, Buttons, Echo, Motion, Navigator, Odometry, Reading, RotatingTelemetry,
    Rotator, TouchSensor, Ultrasonic,
};
use afp_core::quantity::{Angle, AngularSpeed, Length, Speed};
use afp_core::{Environment, Instant};

impl Environment for Simulation {
    fn stop(&mut self, now: Instant) {
        self.drive.command(0.0, 0.0, now);
        self.rotator.hold();
    }

    fn emergency_stop(&mut self) {
        self.drive.block();
        self.rotator.hold();
    }
}

impl Navigator for Simulation {
    fn drive(&mut self, speed: Speed, turn: AngularSpeed, now: Instant) {
        self.drive.command(speed.si(), turn.si(), now);
    }

    fn body(&self) -> Body {
        Body {
            front: Length::from_si(HALF_LENGTH),
            rear: Length::from_si(HALF_LENGTH),
            half_width: Length::from_si(HALF_WIDTH),
        }
    }
}

impl Odometry for Simulation {
    fn motion(&self) -> Reading<Motion> {
        Reading::valid(self.odometer.motion(), self.grid(self.steps))
    }
}

impl Ultrasonic for Simulation {
    fn echo(&self) -> Reading<Echo> {
        self.echo
    }

    fn beam(&self) -> Beam {
        sonar::beam()
    }
}

impl Rotator for Simulation {
    fn point(&mut self, bearing: Angle, _: Instant) {
        self.rotator.aim(bearing.si());
    }
}

impl RotatingTelemetry for Simulation {
    fn bearing(&self) -> Reading<Angle> {
        Reading::valid(self.telemetry(), self.grid(self.steps))
    }
}

impl TouchSensor for Simulation {
    fn touched(&self) -> Reading<bool> {
        Reading::valid(self.touched, self.grid(self.steps))
    }
}

impl Buttons for Simulation {
    fn pressed(&self, button: Button) -> Reading<bool> {
        match button {
            Button::Escape => Reading::valid(self.escape, self.now),
        }
    }
}
