//! Looks for a place that explains the latest echoes better than the belief does: a robot that was carried is there.
//!
//! A rival of the belief is kept, moved with the odometry like a particle. Each update tries to better it: by places near
//! it, and by some anywhere on the map.

use super::cloud::is_near;
use super::memory::Echo;
use super::sonar::{self, likelihood};
use crate::maps::field::{EchoField, Expected};
use afp_platform::Noise;
use afp_session::Pose2;
use std::f64::consts::TAU;

/// So many places anywhere are tried at each update while the belief is doubted, and while it is not.
const DOUBTING: usize = 250;
const CONTENT: usize = 25;
/// A belief that explains the latest echoes less well than this is doubted; 1 is as well as can be.
const DOUBT: f64 = 0.6;
/// A place is tried by so many of the echoes first, and left when it explains them so much less well than the rival does all.
const PROBES: usize = 8;
const HOPELESS: f64 = 0.2;
/// So many places near the rival, metres and radians.
const NEARBY: usize = 12;
const OFF: f64 = 0.12;
const TURNED: f64 = 0.12;

/// How well a place explains echoes: the mean likelihood, 1 where there are none.
pub(super) fn explained(field: &EchoField, echoes: &[Echo], place: Pose2) -> f64 {
    mean(summed(field, echoes.iter(), place, f64::NEG_INFINITY, likelihood), echoes)
}

/// The same for the belief. A rival has to explain echoes by the map; the belief need not, so that a box that was put before
/// the robot does not carry it off to where a wall is as near.
pub(super) fn excused(field: &EchoField, echoes: &[Echo], place: Pose2) -> f64 {
    mean(summed(field, echoes.iter(), place, f64::NEG_INFINITY, sonar::excused), echoes)
}

fn mean(sum: f64, echoes: &[Echo]) -> f64 {
    if echoes.is_empty() { 1.0 } else { sum / echoes.len() as f64 }
}

/// The likelihoods added up, or something below `least` where they cannot reach it.
fn sum(field: &EchoField, echoes: &[Echo], place: Pose2, least: f64) -> f64 {
    summed(field, echoes.iter(), place, least, likelihood)
}

/// Whether a place may be better than one of which the likelihoods add up to `least`, by some of the echoes.
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
    // Of all likelihoods only what is lost against the best is counted, so that hopeless places are left early.
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

/// The best place so far that is not the belief's.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Rival(Option<Pose2>);

impl Rival {
    /// Goes with the robot.
    pub(super) fn drive(&mut self, moved: Pose2) {
        self.0 = self.0.map(|place| place.beyond(moved));
    }

    /// Tries other places than those near the belief, which explains the echoes so well; the best one, and how well that
    /// does.
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
