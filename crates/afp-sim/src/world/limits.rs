//! The limits for numbers in a world.

/// The maximum distance from the origin, in metres: beyond it, single precision is coarse.
pub(crate) const FARTHEST: f64 = 1000.0;
/// The minimum of sizes, masses, speeds and strengths, in metres, kilograms, metres a second and
/// the strength of lights. In single precision, much smaller values vanish or cannot be pushed.
pub(super) const SMALLEST: f64 = 0.001;
