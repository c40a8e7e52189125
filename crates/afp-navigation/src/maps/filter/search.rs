//! Searches for a place that explains the latest echoes better than the belief, for robots that
//! were carried.
//!
//! The best rival of the belief is kept and moved with the odometry like a particle. Each update
//! tries to improve it: with places near it, and with some anywhere on the map.

use super::cloud::is_near;
use super::memory::Echo;
use super::sonar::{self, likelihood};
use crate::maps::field::{EchoField, Expected};
use afp_platform::Noise;
use afp_session::Pose2;
use std::f64::consts::TAU;

/// The number of places anywhere that each update tries while the belief is doubted, and while it
/// is not.
const DOUBTING: usize = 250;
const CONTENT: usize = 25;
/// A belief that explains the latest echoes less well than this is doubted; 1 is the maximum.
const DOUBT: f64 = 0.6;
/// The number of echoes in a first test of a place, and the margin for rejecting it against the
/// rival.
const PROBES: usize = 8;
const HOPELESS: f64 = 0.2;
/// The number of places near the rival, and their spread in metres and radians.
const NEARBY: usize = 12;
const OFF: f64 = 0.12;
const TURNED: f64 = 0.12;

/// How well a place explains echoes: the mean likelihood, or 1 without echoes.
pub(super) fn explained(field: &EchoField, echoes: &[Echo], place: Pose2) -> f64 {
    mean(summed(field, echoes.iter(), place, f64::NEG_INFINITY, likelihood), echoes)
}

/// How well the belief explains echoes. A rival must explain them by the map. The belief may also
/// have unknown obstacles, so that a box in front of the robot does not move it to a wall at that
/// distance.
pub(super) fn excused(field: &EchoField, echoes: &[Echo], place: Pose2) -> f64 {
    mean(summed(field, echoes.iter(), place, f64::NEG_INFINITY, sonar::excused), echoes)
}

fn mean(sum: f64, echoes: &[Echo]) -> f64 {
    if echoes.is_empty() { 1.0 } else { sum / echoes.len() as f64 }
}

/// The sum of the likelihoods, or a smaller value than `least` if they cannot reach it.
fn sum(field: &EchoField, echoes: &[Echo], place: Pose2, least: f64) -> f64 {
    summed(field, echoes.iter(), place, least, likelihood)
}

/// Whether a place may be better than a likelihood sum of `least`, by some of the echoes.
fn is_promising(field: &EchoField, echoes: &[Echo], place: Pose2, least: f64) -> bool {
    let probes = echoes.iter().step_by((echoes.len() / PROBES).max(1)).take(PROBES);
    let least = (least / echoes.len() as f64 - HOPELESS) * probes.len() as f64;
    summed(field, probes, place, least, likelihood) >= least
}

fn summed<'e>(
    field: &EchoField,
    echoes: impl ExactSizeIterator<Item = &'e Echo>,
    place: Pose2,
    least: f64,
    likelihood: fn(Expected, Option<f64>) -> f64,
) -> f64 {
    let (sin, cos) = libm::sincos(place.heading);
    // Only the loss against the maximum is counted, so that hopeless places are left early.
    let (mut sum, enough) = (echoes.len() as f64, least);
    for echo in echoes {
        let at = [place.x + echo.x * cos - echo.y * sin, place.y + echo.x * sin + echo.y * cos];
        let expected = field.expected(at, place.heading + echo.direction);
        sum -= 1.0 - likelihood(expected, echo.distance);
        if sum < enough {
            break;
        }
    }
    sum
}

/// The best place so far, other than the belief.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Rival(Option<Pose2>);

impl Rival {
    pub(super) fn drive(&mut self, moved: Pose2) {
        self.0 = self.0.map(|place| place.beyond(moved));
    }

    /// Tries places away from the belief, which has the explanation `explained`; returns the best
    /// place, and its explanation.
    pub(super) fn improve(
        &mut self,
        field: &EchoField,
        echoes: &[Echo],
        (belief, doubted): (Pose2, f64),
        noise: &mut Noise,
    ) -> Option<(Pose2, f64)> {
        let mut best = self
            .0
            .filter(|place| !is_near(*place, belief))
            .map(|place| (place, sum(field, echoes, place, f64::NEG_INFINITY)));
        let attempt = |best: &mut Option<(Pose2, f64)>, place: Pose2| {
            let least = best.map_or(0.0, |(_, sum)| sum);
            let sum = sum(field, echoes, place, least);
            if sum > least && !is_near(place, belief) {
                *best = Some((place, sum));
            }
        };
        let [low, high] = field.map().bounds();
        for _ in 0..if doubted < DOUBT { DOUBTING } else { CONTENT } {
            let [x, y] = [0, 1].map(|i| low[i] + (high[i] - low[i]) * noise.uniform());
            let place = Pose2 { x, y, heading: TAU * noise.uniform() };
            if is_promising(field, echoes, place, best.map_or(0.0, |(_, sum)| sum)) {
                attempt(&mut best, place);
            }
        }
        for _ in 0..NEARBY {
            let Some((place, _)) = best else { break };
            let [x, y] = [place.x, place.y].map(|at| at + OFF * noise.normal());
            let heading = place.heading + TURNED * noise.normal();
            attempt(&mut best, Pose2 { x, y, heading });
        }
        self.0 = best.map(|(place, _)| place);
        best.map(|(place, sum)| (place, sum / echoes.len().max(1) as f64))
    }
}
