//! The vehicle: its body's measures, its wheels and the controller that drives them.

mod place;

pub(crate) mod drive;
pub(crate) mod servo;
pub(crate) mod wheel;

pub(crate) use place::Place;

/// Half the body's length, metres; the turning centre is its middle.
pub const HALF_LENGTH: f64 = 0.20;
/// Half the body's width, metres.
pub const HALF_WIDTH: f64 = 0.175;
/// Mass, kilograms.
pub(crate) const MASS: f64 = 4.7;
