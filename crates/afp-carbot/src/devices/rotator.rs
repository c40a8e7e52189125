//! The rotator that turns the range sensor.

use super::Reading;
use afp_core::Instant;
use afp_core::quantity::Angle;

/// A servo that points the range sensor.
pub trait Rotator {
    /// Commands a bearing against the heading. The servo takes time; a bearing beyond its reach is
    /// clamped.
    fn point(&mut self, bearing: Angle, now: Instant);
}

/// Position feedback of the rotator.
pub trait RotatingTelemetry {
    /// The actual bearing against the heading.
    fn bearing(&self) -> Reading<Angle>;
}
