//! The greatest and the least number that a world may have.

/// Nothing lies farther from the origin than this, metres: beyond it single precision is coarse.
pub(crate) const FARTHEST: f64 = 1000.0;
/// Nothing is smaller, lighter, slower or weaker than this, metres, kilograms, metres a second and the strength of lights: in
/// single precision what is much less is nothing, or pushed by nothing.
pub(super) const SMALLEST: f64 = 0.001;
