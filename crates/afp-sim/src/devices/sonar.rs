//! The ultrasonic range sensor: a cone of sound.
//!
//! Several rays represent the cone. A ray is heard when enough of its sound comes back. Less sound
//! comes back at the cone's edge, from far away, and from a smooth surface at a slant, which
//! mirrors the sound away. The nearest heard ray is the echo.

use crate::noise::Noise;
use crate::stage::{Rays, Stage};
use afp_carbot::devices::Beam;
use afp_core::Duration;
use afp_core::quantity::{Angle, Length};

/// The interval between pings.
pub(crate) const PERIOD: Duration = Duration::from_millis(50);
/// The number of rays in the cone.
pub(crate) const RAYS: usize = 9;
/// The speed of sound, metres a second.
const SOUND: f64 = 343.0;
/// The minimum range, in metres.
const MIN: f64 = 0.03;
pub(crate) const MAX: f64 = CARBOT.most;
/// A range sensor with a cone of sound, and its errors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RangeModel {
    /// The cone's full angle, in radians.
    pub opening: f64,
    /// The maximum range, in metres.
    pub most: f64,
    /// The minimum amplitude of an audible echo (1: square, on the axis, at one metre).
    pub threshold: f64,
    /// The remaining share of the sound at the cone's edge.
    pub edge: f64,
    /// Standard deviation of a range: metres, and share of the range.
    pub noise: [f64; 2],
    /// Standard deviation of the sensor's assumed speed of sound, as a share.
    pub calibration: f64,
    /// The resolution, in metres.
    pub resolution: f64,
    /// The probability of a lost ping, and the additional probability for a barely audible ping.
    pub lost: [f64; 2],
}

/// The Carbot's sensor.
pub(crate) const CARBOT: RangeModel = RangeModel {
    opening: 30.0 / 180.0 * core::f64::consts::PI,
    most: 4.0,
    threshold: 0.02,
    edge: 0.3,
    noise: [0.003, 0.003],
    calibration: 0.003,
    resolution: 0.001,
    lost: [0.01, 0.4],
};

/// The beam of the Carbot's sensor at this distance ahead of the turning centre, in metres.
pub(crate) fn beam(forward: f64) -> Beam {
    Beam {
        forward: Length::from_si(forward),
        opening: Angle::from_si(CARBOT.opening),
        min: Length::from_si(MIN),
        max: Length::from_si(MAX),
    }
}

/// A range sensor of a robot.
#[derive(Clone, Debug)]
pub struct RangeSensor {
    model: RangeModel,
    noise: Noise,
    scale: f64,
    /// The bearing of each ray against the axis, as cosine and sine, and its share of the sound.
    rays: [(f64, f64, f64); RAYS],
}

impl RangeSensor {
    /// A sensor with one noise stream for its readings and one for its calibration.
    pub fn new(model: RangeModel, noise: Noise, build: &mut Noise) -> Self {
        let mut rays = [(1.0, 0.0, 1.0); RAYS];
        for (i, ray) in rays.iter_mut().enumerate() {
            let share = 2.0 * i as f64 / (RAYS - 1) as f64 - 1.0;
            let (sin, cos) = libm::sincos(share * model.opening / 2.0);
            *ray = (cos, sin, 1.0 - (1.0 - model.edge) * share * share);
        }
        RangeSensor { noise, scale: 1.0 + model.calibration * build.normal(), model, rays }
    }

    /// Returns the range of a ping's echo, in metres. The ping starts `forward` of the body's
    /// middle, at a bearing against the heading in radians.
    ///
    /// Returns `None` without an echo, or if the echo comes from beyond the maximum range: the
    /// sensor no longer listens for it.
    pub fn ping(&mut self, stage: &Stage, forward: f64, bearing: f64) -> Option<f64> {
        let rays = stage.rays(forward);
        self.ping_along(rays.along(bearing), &rays)
    }

    /// Like [`RangeSensor::ping`], in the world's direction (`cos`, `sin`).
    pub(crate) fn ping_along(&mut self, (cos, sin): (f64, f64), rays: &Rays<'_>) -> Option<f64> {
        let RangeModel { most, threshold, noise, resolution, lost, .. } = self.model;
        let mut nearest: Option<(f64, f64)> = None;
        for &(ray_cos, ray_sin, share) in &self.rays {
            let direction = (cos * ray_cos - sin * ray_sin, sin * ray_cos + cos * ray_sin);
            let Some(met) = rays.cast(direction, most) else { continue };
            let echo = rays.echo(met.obstacle);
            let loudness = share * echo * mirrored(met.cos) / (met.range * met.range).max(0.01);
            let loud = loudness > threshold;
            if loud && nearest.is_none_or(|(range, _)| met.range < range) {
                nearest = Some((met.range, loudness));
            }
        }
        // The noise is drawn for every ping, so that readings do not shift the stream.
        let (chance, error) = (self.noise.uniform(), self.noise.normal());
        let (range, loudness) = nearest?;
        let faint = (2.0 - loudness / threshold).max(0.0);
        if chance < lost[0] + lost[1] * faint {
            return None;
        }
        let measured = range * self.scale + error * (noise[0] + noise[1] * range);
        let rounded = libm::round(measured / resolution) * resolution;
        (rounded <= most).then_some(rounded)
    }
}

/// The share of sound that a smooth surface returns: the 16th power of the slant's cosine.
fn mirrored(cos: f64) -> f64 {
    let square = cos * cos;
    let fourth = square * square;
    let eighth = fourth * fourth;
    eighth * eighth
}

/// The sound's travel time, there and back. Silence takes as long as the farthest echo.
pub(crate) fn flight(range: Option<f64>) -> Duration {
    Duration::from_secs_f64(2.0 * range.unwrap_or(MAX) / SOUND)
}
