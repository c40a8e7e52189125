//! The rotator that turns the range sensor.

use super::Reading;
use afp_core::Instant;
use afp_core::quantity::Angle;

/// A servo that points the range sensor.
pub trait Rotator {
    /// Asks for a bearing against the heading. The servo takes its time; a bearing beyond its
    /// reach is reduced to the last one within.
    fn point(&mut self, bearing: Angle, now: Instant);
}

/// Where the rotator really is.
pub trait RotatingTelemetry {
    /// The actual bearing against the heading.
    fn bearing(&self) -> Reading<Angle>;
}
