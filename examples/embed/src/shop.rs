//! The program's side: a shop with a robot. A template calls it.

use afp::quantity::{Angle, AngularSpeed, Speed};
use afp::{Actor, Environment, Fault, Instant, Platform, Poll};
use afp_carbot::devices::{
    Beam, Body, Bump, Button, Buttons, Echo, Motion, Navigator, Odometry, Reading,
    RotatingTelemetry, Rotator, TouchSensor, Ultrasonic,
};
use afp_carbot::trail::Trail;
use afp_sim::Simulation;

/// The shop's templates, declared in `shop.afp`.
pub mod templates {
    afp::toolbox!("shop.afp", robot: super::Loudspeaker);
}

/// The platform: the robot and its shop.
pub struct Shop {
    /// The robot.
    pub robot: Simulation,
    /// The announcements.
    pub announced: Vec<String>,
}

/// The shop's offer to templates, in addition to the robot.
pub trait Loudspeaker {
    /// Announces a text.
    fn announce(&mut self, text: &str);
}

impl Loudspeaker for Shop {
    fn announce(&mut self, text: &str) {
        self.announced.push(text.to_owned());
    }
}

/// Calls the program.
#[derive(Clone, Debug)]
pub struct Announce;

impl<E: Loudspeaker + ?Sized> Actor<templates::Announce, E> for Announce {
    fn start(
        inputs: templates::announce::Inputs<'_>,
        env: &mut E,
        _: Instant,
    ) -> Result<Self, Fault> {
        env.announce(inputs.text);
        Ok(Announce)
    }

    fn poll(
        &mut self,
        _: templates::announce::Live,
        _: &mut E,
        _: Instant,
    ) -> Result<Poll<templates::announce::State>, Fault> {
        Ok(Poll::Ready(templates::announce::State::Announced))
    }

    fn interrupt(&mut self, _: &mut E, _: Instant) -> Result<(), Fault> {
        Ok(())
    }
}

impl Environment for Shop {
    fn stop(&mut self, now: Instant) {
        self.robot.stop(now);
    }

    fn emergency_stop(&mut self) {
        self.robot.emergency_stop();
    }
}

impl Platform for Shop {
    type Clock = <Simulation as Platform>::Clock;

    fn clock(&self) -> Self::Clock {
        self.robot.clock()
    }

    fn now(&self) -> Instant {
        self.robot.now()
    }

    fn advance(&mut self, to: Instant) {
        self.robot.advance_to(to);
    }

    fn ready(&self) -> Instant {
        self.robot.ready()
    }
}

// Methods with defaults must be forwarded, too, since templates call them on the robot.
impl Navigator for Shop {
    fn drive(&mut self, speed: Speed, turn: AngularSpeed, now: Instant) {
        self.robot.drive(speed, turn, now);
    }

    fn reduced(&self, speed: Speed, turn: AngularSpeed) -> (Speed, AngularSpeed) {
        self.robot.reduced(speed, turn)
    }

    fn halt(&mut self, now: Instant) {
        self.robot.halt(now);
    }

    fn note_blocked(&mut self, now: Instant) {
        self.robot.note_blocked(now);
    }

    fn body(&self) -> Body {
        self.robot.body()
    }
}

impl Odometry for Shop {
    fn motion(&self) -> Reading<Motion> {
        self.robot.motion()
    }

    fn last_bump(&self) -> Option<Bump> {
        self.robot.last_bump()
    }

    fn trail(&self) -> Trail {
        self.robot.trail()
    }
}

impl Ultrasonic for Shop {
    fn echo(&self) -> Reading<Echo> {
        self.robot.echo()
    }

    fn beam(&self) -> Beam {
        self.robot.beam()
    }
}

impl Rotator for Shop {
    fn point(&mut self, bearing: Angle, now: Instant) {
        self.robot.point(bearing, now);
    }
}

impl RotatingTelemetry for Shop {
    fn bearing(&self) -> Reading<Angle> {
        self.robot.bearing()
    }
}

impl TouchSensor for Shop {
    fn touched(&self) -> Reading<bool> {
        self.robot.touched()
    }
}

impl Buttons for Shop {
    fn pressed(&self, button: Button) -> Reading<bool> {
        self.robot.pressed(button)
    }
}
