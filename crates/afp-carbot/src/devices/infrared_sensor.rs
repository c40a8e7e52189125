//! The sensor that tells where infrared light comes from.

use super::Reading;
use afp_core::quantity::Angle;

/// Infrared light from a source.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Glow {
    /// Where it comes from, against the heading.
    pub bearing: Angle,
    /// How bright it is: 1 for a source of strength 1 that is one metre away.
    pub strength: f64,
}

/// A direction sensor for infrared light at the front of the robot.
pub trait InfraredSensor {
    /// The brightest source within the field of view, or none where all is dark. Told as finely as it is measured: a sensor
    /// that says exactly the same again and again while the robot moves is taken for a frozen one.
    fn glow(&self) -> Reading<Option<Glow>>;

    /// The whole angle of the field of view, its middle ahead.
    fn field_of_view(&self) -> Angle;
}
