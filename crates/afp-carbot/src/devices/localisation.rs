//! Position estimate of the robot on its map.

use super::Reading;
use afp_core::quantity::{Angle, Length};
use afp_core::{Fault, Instant};

/// The robot's estimated pose, in the map frame.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Belief {
    /// Position along the map's x axis.
    pub x: Length,
    /// Position along its y axis.
    pub y: Length,
    /// Heading against the x axis, within half a turn.
    pub heading: Angle,
    /// Uncertainty of the position: root mean square.
    pub spread: Length,
    /// Uncertainty of the heading: root mean square.
    pub heading_spread: Angle,
}

/// Localises the robot on a given map by its sensors. The estimate errs, and the robot may be lost.
pub trait Localisation {
    /// The current estimate. The first call starts the localisation.
    ///
    /// # Errors
    /// The computation failed.
    fn belief(&mut self, now: Instant) -> Result<Reading<Belief>, Fault>;
}
