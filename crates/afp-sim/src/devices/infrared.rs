//! The infrared direction sensor, which finds the brightest visible source.

use crate::noise::{Noise, Source};
use crate::scene::Scene;
use crate::vehicle::Place;
use crate::world::Light;
use afp_carbot::devices::Glow;
use afp_core::Duration;
use afp_core::quantity::Angle;

/// The interval between measurements.
pub(crate) const PERIOD: Duration = Duration::from_millis(50);
/// The whole field of view, in radians.
pub(crate) const FIELD: f64 = 120.0 / 180.0 * core::f64::consts::PI;
/// The sensor's position ahead of the turning centre and above the floor, in metres.
const FORWARD: f64 = 0.18;
const HEIGHT: f64 = 0.12;
/// The minimum strength of a visible source.
const THRESHOLD: f64 = 0.01;
/// A source does not get brighter below this distance, in metres.
const NEAR: f64 = 0.1;
/// Standard deviations of the bearing, radians, and of the strength, as a share.
const BEARING_NOISE: f64 = 3.0 / 180.0 * core::f64::consts::PI;
const STRENGTH_NOISE: f64 = 0.05;

#[derive(Clone, Debug)]
pub(crate) struct Infrared {
    noise: Noise,
}

impl Infrared {
    pub(crate) fn new(seed: u64) -> Self {
        Infrared { noise: Source::Infrared.of(seed) }
    }

    /// Measures the light from a robot at this place.
    pub(crate) fn look(&mut self, lights: &[Light], scene: &Scene, robot: Place) -> Option<Glow> {
        // The noise is drawn every time, so that readings do not shift the stream.
        let (turn, gain) = (self.noise.normal(), self.noise.normal());
        let eye = robot.beyond(FORWARD, 0.0);
        let mut brightest: Option<(f64, f64)> = None;
        for light in lights {
            let to = [light.position[0] - eye[0], light.position[1] - eye[1]];
            let [ahead, left] = robot.towards(to);
            let bearing = libm::atan2(left, ahead);
            let far = libm::hypot(ahead, left).max(NEAR);
            let strength = light.strength / (far * far);
            let seen = bearing.abs() <= FIELD / 2.0
                && strength >= THRESHOLD
                && brightest.is_none_or(|(_, most)| strength > most);
            if seen && !scene.between((eye, HEIGHT), (light.position, light.height)) {
                brightest = Some((bearing, strength));
            }
        }
        brightest.map(|(bearing, strength)| Glow {
            bearing: Angle::from_si(bearing + turn * BEARING_NOISE),
            strength: (strength * (1.0 + gain * STRENGTH_NOISE)).max(0.0),
        })
    }
}
