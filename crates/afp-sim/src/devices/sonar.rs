//! The ultrasonic range sensor: a cone of sound.
//!
//! Several rays stand for the cone. A ray is heard when enough of its sound comes back: less at
//! the cone's edge, from far away, and from a smooth surface at a slant, which mirrors the sound
//! away. The nearest ray that is heard is the echo.

use crate::noise::{Noise, Source};
use afp_carbot::devices::Beam;
use afp_core::Duration;
use afp_core::quantity::{Angle, Length};

/// The rotator's axis is this far before the turning centre, metres.
pub(crate) const FORWARD: f64 = 0.10;
/// The sensor looks over anything that is lower than this, metres.
pub(crate) const HEIGHT: f64 = 0.15;
/// A ping is sent every so often.
pub(crate) const PERIOD: Duration = Duration::from_millis(50);
/// How many rays stand for the cone.
pub(crate) const RAYS: usize = 9;
/// What the sensor can measure, metres.
const MIN: f64 = 0.03;
pub(crate) const MAX: f64 = 4.0;
/// The cone's whole angle, radians.
const OPENING: f64 = 30.0 / 180.0 * core::f64::consts::PI;
/// The speed of sound, metres a second.
const SOUND: f64 = 343.0;
/// An echo is heard above this amplitude (1: square, on the axis, one metre away).
const THRESHOLD: f64 = 0.02;
/// How much of the sound is left at the cone's edge.
const EDGE: f64 = 0.3;
/// Standard deviation of a range: metres, and share of the range.
const NOISE: f64 = 0.003;
const NOISE_SHARE: f64 = 0.003;
/// Standard deviation of the speed of sound that a robot wrongly assumes, as a share.
const CALIBRATION: f64 = 0.003;
/// What the sensor rounds to, metres.
const RESOLUTION: f64 = 0.001;
/// Probability that a ping is lost for no reason, and for one that is barely heard.
const LOST: f64 = 0.01;
const LOST_FAINT: f64 = 0.4;

/// What a ray met: how far away, the cosine of the angle to the surface's normal, and how much of
/// the sound the surface sends back.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Hit {
    pub(crate) range: f64,
    pub(crate) cos: f64,
    pub(crate) echo: f64,
}

/// How the sensor is mounted.
pub(crate) fn beam() -> Beam {
    Beam {
        forward: Length::from_si(FORWARD),
        opening: Angle::from_si(OPENING),
        min: Length::from_si(MIN),
        max: Length::from_si(MAX),
    }
}

/// The sensor's electronics.
#[derive(Clone, Debug)]
pub(crate) struct Sonar {
    noise: Noise,
    scale: f64,
    /// Bearing of each ray against the axis as cosine and sine, and its share of the sound.
    rays: [(f64, f64, f64); RAYS],
}

impl Sonar {
    pub(crate) fn new(seed: u64, build: &mut Noise) -> Self {
        let mut rays = [(1.0, 0.0, 1.0); RAYS];
        for (i, ray) in rays.iter_mut().enumerate() {
            let share = 2.0 * i as f64 / (RAYS - 1) as f64 - 1.0;
            let (sin, cos) = libm::sincos(share * OPENING / 2.0);
            *ray = (cos, sin, 1.0 - (1.0 - EDGE) * share * share);
        }
        Sonar {
            noise: Source::Ultrasonic.of(seed),
            scale: 1.0 + CALIBRATION * build.normal(),
            rays,
        }
    }

    /// What comes back from a ping sent in the direction (`cos`, `sin`): the measured range, or
    /// none where nothing is heard. `cast` gives what a ray in a direction meets.
    pub(crate) fn ping(
        &mut self,
        (cos, sin): (f64, f64),
        cast: impl Fn((f64, f64)) -> Option<Hit>,
    ) -> Option<f64> {
        let mut nearest: Option<(f64, f64)> = None;
        for &(ray_cos, ray_sin, share) in &self.rays {
            let direction = (cos * ray_cos - sin * ray_sin, sin * ray_cos + cos * ray_sin);
            let Some(hit) = cast(direction) else { continue };
            let loudness = share * hit.echo * mirrored(hit.cos) / (hit.range * hit.range).max(0.01);
            let loud = loudness > THRESHOLD;
            if loud && nearest.is_none_or(|(range, _)| hit.range < range) {
                nearest = Some((hit.range, loudness));
            }
        }
        // Drawn for every ping, so that what is heard does not shift the stream.
        let (chance, error) = (self.noise.uniform(), self.noise.normal());
        let (range, loudness) = nearest?;
        let faint = (2.0 - loudness / THRESHOLD).max(0.0);
        if chance < LOST + LOST_FAINT * faint {
            return None;
        }
        let measured = range * self.scale + error * (NOISE + NOISE_SHARE * range);
        Some(libm::round(measured / RESOLUTION) * RESOLUTION)
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
