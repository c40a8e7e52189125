//! The drive: speeds in, motion out.

use afp_core::Instant;
use afp_core::quantity::{AngularSpeed, Length, Speed};

/// The outline of the body, measured from the turning centre.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Body {
    /// To the foremost point.
    pub front: Length,
    /// To the rearmost point.
    pub rear: Length,
    /// To either side.
    pub half_width: Length,
}

impl Body {
    /// How far its farthest corner is from the turning centre: it turns in place wherever nothing is nearer than this.
    pub fn radius(&self) -> Length {
        let length = self.front.si().max(self.rear.si());
        Length::from_si(libm::hypot(length, self.half_width.si()))
    }

    /// What a turn by a radian counts as, beside what is driven: so far it carries the farthest of the body's sides.
    pub fn lever(&self) -> Length {
        let length = self.front.si().max(self.rear.si());
        Length::from_si(length.max(self.half_width.si()))
    }
}

/// The drive controller.
///
/// It keeps a commanded motion only for its dead-man time: a driver that stops sending commands
/// stops the robot. Whether the robot really stands is [`super::Odometry`]'s to tell.
pub trait Navigator {
    /// Asks for a speed ahead (negative: backwards) and a turn rate, until further notice or the
    /// end of the dead-man time. Values beyond what the robot can do are reduced, both by the same
    /// factor, so that the robot keeps to the curve. The robot stops from any motion that is left within the
    /// stop time that the templates declare.
    fn drive(&mut self, speed: Speed, turn: AngularSpeed, now: Instant);

    /// What of a command the robot can do, by default all of it: what it will do when told so. Templates compare the
    /// odometry with this, so a robot that reduces commands says how.
    fn reduced(&self, speed: Speed, turn: AngularSpeed) -> (Speed, AngularSpeed) {
        (speed, turn)
    }

    /// Asks for a standstill.
    fn halt(&mut self, now: Instant) {
        self.drive(Speed::from_si(0.0), AngularSpeed::from_si(0.0), now);
    }

    /// The drive, told to go ahead, did not: something that no sensor may show stands right before the robot. A platform that
    /// keeps what was met keeps this, too, and plans ways round it; by default nobody does.
    fn note_blocked(&mut self, now: Instant) {
        let _ = now;
    }

    /// The robot's outline.
    fn body(&self) -> Body;
}
