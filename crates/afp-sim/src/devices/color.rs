//! The colour sensor, which measures the floor under the front of the robot.

use crate::noise::{Noise, Source};
use crate::scene::Scene;
use crate::vehicle::Place;
use afp_carbot::devices::Color;
use afp_core::Duration;

/// The interval between measurements.
pub(crate) const PERIOD: Duration = Duration::from_millis(20);
/// The distance ahead of the turning centre, in metres.
const FORWARD: f64 = 0.15;
/// Standard deviation of each colour.
const NOISE: f64 = 0.01;

#[derive(Clone, Debug)]
pub(crate) struct ColorSensor {
    noise: Noise,
}

impl ColorSensor {
    pub(crate) fn new(seed: u64) -> Self {
        ColorSensor { noise: Source::Color.of(seed) }
    }

    /// Measures the colour from a robot at this place.
    pub(crate) fn look(&mut self, scene: &Scene, robot: Place) -> Color {
        let [red, green, blue] = scene
            .floor(robot.beyond(FORWARD, 0.0))
            .map(|part| (f64::from(part) / 255.0 + self.noise.normal() * NOISE).clamp(0.0, 1.0));
        Color { red, green, blue }
    }
}
