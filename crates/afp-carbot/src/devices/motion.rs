//! Motion by wheel odometry.

use afp_core::quantity::{Angle, AngularSpeed, Length, Speed};

/// Motion of the robot since its start, by its wheels.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Motion {
    /// Position along the initial heading.
    pub x: Length,
    /// Position to the left of the initial heading.
    pub y: Length,
    /// Heading against the initial heading; not wrapped after a full turn.
    pub heading: Angle,
    /// Forward speed.
    pub speed: Speed,
    /// Turn rate.
    pub turn: AngularSpeed,
}

impl Motion {
    /// Whether the robot is stationary: slower than 6 mm/s and 1.5 deg/s.
    pub fn stands(&self) -> bool {
        self.speed.abs().si() < 0.006 && self.turn.abs().si() < 0.026
    }

    /// This position seen from `origin`: along the heading there, and to the left of it.
    pub fn seen_from(&self, origin: &Motion) -> (Length, Length) {
        let (sin, cos) = libm::sincos(origin.heading.si());
        let (x, y) = ((self.x - origin.x).si(), (self.y - origin.y).si());
        (Length::from_si(x * cos + y * sin), Length::from_si(y * cos - x * sin))
    }
}
