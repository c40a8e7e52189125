//! The sensor for the direction of infrared light.

use super::Reading;
use afp_core::quantity::Angle;

/// Infrared light from a source.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Glow {
    /// Direction of the source, against the heading.
    pub bearing: Angle,
    /// Brightness: 1 for a source of strength 1 at one metre.
    pub strength: f64,
}

/// A direction sensor for infrared light at the front of the robot.
pub trait InfraredSensor {
    /// The brightest source within the field of view; `None` in darkness. Report full precision: a
    /// sensor that repeats exactly the same value while the robot moves counts as frozen.
    fn glow(&self) -> Reading<Option<Glow>>;

    /// The whole angle of the field of view, centred ahead.
    fn field_of_view(&self) -> Angle;
}
