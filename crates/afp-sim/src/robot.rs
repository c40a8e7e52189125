//! The robot's parts: drive, odometer, rotator, range sensor.
//!
//! Each is stepped with the physics and knows nothing of rapier but what it needs.

pub(crate) mod drive;
pub(crate) mod odometer;
pub(crate) mod servo;
pub(crate) mod sonar;

/// Half the body's length, metres; the turning centre is its middle.
pub const HALF_LENGTH: f64 = 0.20;
/// Half the body's width, metres.
pub const HALF_WIDTH: f64 = 0.175;
/// Mass, kilograms.
pub(crate) const MASS: f64 = 4.7;
/// The sensor looks over anything that is lower than this, metres.
pub(crate) const SONAR_HEIGHT: f64 = 0.15;
/// The rotator's axis is this far before the turning centre, metres.
pub(crate) const SONAR_FORWARD: f64 = 0.10;
