//! Motion as counted at the wheels.

use afp_core::quantity::{Angle, AngularSpeed, Length, Speed};

/// How the robot has moved since its start, as far as the wheels can tell.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Motion {
    /// Position along the heading at the start.
    pub x: Length,
    /// Position to the left of it.
    pub y: Length,
    /// Heading against that at the start; counts on past a full turn.
    pub heading: Angle,
    /// Speed ahead.
    pub speed: Speed,
    /// Turn rate.
    pub turn: AngularSpeed,
}

impl Motion {
    /// Whether the robot stands: slower than 6 mm/s and 1.5 deg/s.
    pub fn stands(&self) -> bool {
        self.speed.abs().si() < 0.006 && self.turn.abs().si() < 0.026
    }

    /// Where this is, seen from `origin`: along the heading there, and to the left of it.
    pub fn seen_from(&self, origin: &Motion) -> (Length, Length) {
        let (sin, cos) = libm::sincos(origin.heading.si());
        let (x, y) = ((self.x - origin.x).si(), (self.y - origin.y).si());
        (Length::from_si(x * cos + y * sin), Length::from_si(y * cos - x * sin))
    }
}
