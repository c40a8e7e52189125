//! Motion as counted at the wheels.

use super::Reading;
use crate::helpers::trail::Trail;
use afp_core::Instant;
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

/// Where the robot was when its bumper was pressed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bump {
    /// By the odometry.
    pub at: Motion,
    /// When it was last pressed there.
    pub time: Instant,
}

/// Dead reckoning. It drifts with time and way; nothing corrects it.
pub trait Odometry {
    /// The motion counted so far.
    fn motion(&self) -> Reading<Motion>;

    /// Where the bumper was last pressed; none before, or where nobody keeps it. Templates last for an element of a plan,
    /// what was met stays where it is: so the platform keeps it.
    fn last_bump(&self) -> Option<Bump> {
        None
    }

    /// The way by which the robot came; nothing is known where nobody keeps it, and then what goes back goes straight back.
    fn trail(&self) -> Trail {
        Trail::new()
    }
}
