//! The drive.

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
    /// Distance of the farthest corner from the turning centre: the free radius for a turn in
    /// place.
    pub fn radius(&self) -> Length {
        let length = self.front.si().max(self.rear.si());
        Length::from_si(libm::hypot(length, self.half_width.si()))
    }

    /// Weight of a turn against a distance, per radian: the farthest extent of the body.
    pub fn lever(&self) -> Length {
        let length = self.front.si().max(self.rear.si());
        Length::from_si(length.max(self.half_width.si()))
    }
}

/// The drive controller.
///
/// It keeps a commanded motion only for its dead-man time, so a driver that stops sending commands
/// stops the robot. [`super::Odometry`] reports whether the robot has stopped.
pub trait Navigator {
    /// Commands a forward speed (negative: backwards) and a turn rate until the next command or the
    /// end of the dead-man time. Values beyond the robot's limits are reduced by one common factor,
    /// so that the robot keeps to the curve. The robot stops from every motion within the stop time
    /// that the templates declare.
    fn drive(&mut self, speed: Speed, turn: AngularSpeed, now: Instant);

    /// The motion with which the robot follows a command; by default the command itself. Templates
    /// compare the odometry with this, so override it if your robot reduces commands.
    fn reduced(&self, speed: Speed, turn: AngularSpeed) -> (Speed, AngularSpeed) {
        (speed, turn)
    }

    /// Commands a standstill.
    fn halt(&mut self, now: Instant) {
        self.drive(Speed::from_si(0.0), AngularSpeed::from_si(0.0), now);
    }

    /// Notes that the drive did not move forward as commanded: an obstacle that no sensor shows may
    /// be right in front. A platform that remembers obstacles stores it and plans around it; by
    /// default it is ignored.
    fn note_blocked(&mut self, now: Instant) {
        let _ = now;
    }

    /// The robot's outline.
    fn body(&self) -> Body;
}
