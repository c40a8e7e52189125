//! Where the robot is on its map, as far as it can tell.

use super::Reading;
use afp_core::quantity::{Angle, Length};
use afp_core::{Fault, Instant};

/// Where the robot takes itself to be, in the frame of its map.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Belief {
    /// Position along the map's x axis.
    pub x: Length,
    /// Position along its y axis.
    pub y: Length,
    /// Heading against the x axis, within half a turn.
    pub heading: Angle,
    /// How far from there it may be: root mean square of what is held possible.
    pub spread: Length,
    /// The same of the heading.
    pub heading_spread: Angle,
}

/// Finds the robot on a map that it was given, by its sensors. It errs, and it may be lost; nothing tells the true pose.
pub trait Localisation {
    /// The belief now. Who asks for it first makes the robot begin to look for itself, if it has not before.
    ///
    /// # Errors
    /// The computation failed.
    fn belief(&mut self, now: Instant) -> Result<Reading<Belief>, Fault>;
}
