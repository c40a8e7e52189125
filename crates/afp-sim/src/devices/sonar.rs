//! The ultrasonic range sensor: a cone of sound.
//!
//! Several rays stand for the cone. A ray is heard when enough of its sound comes back: less at
//! the cone's edge, from far away, and from a smooth surface at a slant, which mirrors the sound
//! away. The nearest ray that is heard is the echo.

use crate::noise::Noise;
use crate::stage::{Rays, Stage};
use afp_carbot::devices::Beam;
use afp_core::Duration;
use afp_core::quantity::{Angle, Length};

/// The rotator's axis is this far before the turning centre, metres.
pub(crate) const FORWARD: f64 = 0.10;
/// A ping is sent every so often.
pub(crate) const PERIOD: Duration = Duration::from_millis(50);
/// How many rays stand for the cone.
pub(crate) const RAYS: usize = 9;
/// The speed of sound, metres a second.
const SOUND: f64 = 343.0;
/// The least that the sensor can measure, metres.
const MIN: f64 = 0.03;
pub(crate) const MAX: f64 = CARBOT.most;
/// A range sensor that listens to a cone of sound, and how it errs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RangeModel {
    /// The cone's whole angle, radians.
    pub opening: f64,
    /// The most that it measures, metres.
    pub most: f64,
    /// An echo is heard above this amplitude (1: square, on the axis, one metre away).
    pub threshold: f64,
    /// How much of the sound is left at the cone's edge.
    pub edge: f64,
    /// Standard deviation of a range: metres, and share of the range.
    pub noise: [f64; 2],
    /// Standard deviation of the speed of sound that a sensor wrongly assumes, as a share.
    pub calibration: f64,
    /// What it rounds to, metres.
    pub resolution: f64,
    /// Probability that a ping is lost for no reason, and more for one that is barely heard.
    pub lost: [f64; 2],
}

/// The Carbot's.
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

/// How the sensor is mounted.
pub(crate) fn beam() -> Beam {
    Beam {
        forward: Length::from_si(FORWARD),
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
    /// Bearing of each ray against the axis as cosine and sine, and its share of the sound.
    rays: [(f64, f64, f64); RAYS],
}

impl RangeSensor {
    /// One of a model, with a stream of noise for its readings and one for what differs from robot to robot.
    pub fn new(model: RangeModel, noise: Noise, build: &mut Noise) -> Self {
        let mut rays = [(1.0, 0.0, 1.0); RAYS];
        for (i, ray) in rays.iter_mut().enumerate() {
            let share = 2.0 * i as f64 / (RAYS - 1) as f64 - 1.0;
            let (sin, cos) = libm::sincos(share * model.opening / 2.0);
            *ray = (cos, sin, 1.0 - (1.0 - model.edge) * share * share);
        }
        RangeSensor { noise, scale: 1.0 + model.calibration * build.normal(), model, rays }
    }

    /// What comes back from a ping that is sent `forward` of the body's middle, at a bearing against the heading, in
    /// radians: the measured range in metres, or none where nothing is heard or it measures more than its most: such an echo comes
    /// after it has stopped listening.
    pub fn ping(&mut self, stage: &Stage, forward: f64, bearing: f64) -> Option<f64> {
        let rays = stage.rays(forward);
        self.ping_along(rays.along(bearing), &rays)
    }

    /// The same in the direction (`cos`, `sin`) of the world.
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
        // Drawn for every ping, so that what is heard does not shift the stream.
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

/// How much sound a smooth surface sends back, by the cosine of the slant: its 16th power.
fn mirrored(cos: f64) -> f64 {
    let square = cos * cos;
    let fourth = square * square;
    let eighth = fourth * fourth;
    eighth * eighth
}

/// How long the sound is under way, there and back; silence takes as long as the farthest echo.
pub(crate) fn flight(range: Option<f64>) -> Duration {
    Duration::from_secs_f64(2.0 * range.unwrap_or(MAX) / SOUND)
}
