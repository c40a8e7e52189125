//! Fits one wall to the echoes of a sweep.
//!
//! An ultrasonic beam is wide: it hears the perpendicular echo while the wall's normal is within
//! the beam. So a plane wall with its normal at bearing `a` and distance `d` is heard from bearing
//! `b` at `d / cos(max(0, |b - a| - beam/2))`. Fitting this model prevents the bend that a straight
//! line through points on the beam's axis would have.
//!
//! The search over the bearing is exhaustive, so it needs no initial guess. Echoes of other objects
//! are outliers and have no weight.

use crate::devices::Echo;
use crate::helpers::motion::wrap;
use heapless::Vec;

/// An echo of a sweep.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Return {
    /// Bearing of the sensor, radians.
    pub(crate) bearing: f64,
    /// Distance of the echo, metres.
    pub(crate) range: f64,
}

impl Return {
    /// Infinitely far away if nothing was heard.
    pub(crate) fn of(echo: &Echo) -> Self {
        let range = echo.distance.map_or(f64::INFINITY, |distance| distance.si());
        Return { bearing: echo.bearing.si(), range }
    }
}

/// A wall, seen from the sensor's position.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Wall {
    /// Bearing of its normal, radians.
    pub(crate) bearing: f64,
    /// Perpendicular distance, metres.
    pub(crate) distance: f64,
    /// Root mean square deviation of the inliers, metres.
    pub(crate) residual: f64,
    /// Number of echoes that belong to the wall.
    pub(crate) inliers: usize,
}

/// An echo belongs to the wall if it deviates by less than this, metres.
const TOLERANCE: f64 = 0.03;
/// Largest angle between the beam's axis and the wall's normal for an echo.
const SLANT: f64 = 65.0 / 180.0 * core::f64::consts::PI;
/// Fewest echoes that make a wall.
const FEWEST: usize = 6;
/// Smallest angle of echoes that determines a wall's direction.
const SPREAD: f64 = 20.0 / 180.0 * core::f64::consts::PI;
/// Largest residual of a wall, metres.
const RESIDUAL: f64 = 0.02;
/// Standard deviation of one echo, metres, to weigh directions that fit almost equally.
const SIGMA: f64 = 0.006;
/// Steps of the coarse and of the fine search, radians.
const COARSE: f64 = 3.0 / 180.0 * core::f64::consts::PI;
const FINE: f64 = 0.5 / 180.0 * core::f64::consts::PI;

/// The wall with the most returns; `None` if there are too few or the fit is poor.
///
/// Uses at most [`MOST`] returns. Time grows with their square.
pub(crate) fn fit(returns: &[Return], half_beam: f64) -> Option<Wall> {
    let (low, high) = bearings(returns)?;
    let mut best: Option<(f64, f64, f64)> = None;
    let steps = ((high - low + 2.0 * half_beam) / COARSE) as u32;
    for step in 0..=steps.min(MOST_STEPS) {
        let bearing = low - half_beam + f64::from(step) * COARSE;
        let (score, distance) = vote(returns, bearing, half_beam);
        if best.is_none_or(|(most, ..)| score > most) {
            best = Some((score, bearing, distance));
        }
    }
    let (_, bearing, distance) = best?;
    let wall = refine(returns, bearing, distance, half_beam)?;
    (wall.inliers >= FEWEST && wall.residual <= RESIDUAL).then_some(wall)
}

/// A full turn in coarse steps, the bound of the search.
const MOST_STEPS: u32 = 120;
/// More returns are ignored.
pub(crate) const MOST: usize = 64;

fn bearings(returns: &[Return]) -> Option<(f64, f64)> {
    let first = returns.first()?.bearing;
    Some(
        returns
            .iter()
            .fold((first, first), |(low, high), r| (low.min(r.bearing), high.max(r.bearing))),
    )
}

/// The perpendicular distance of a return from a wall with its normal at `bearing`.
fn perpendicular(r: &Return, bearing: f64, half_beam: f64) -> Option<f64> {
    let slant = wrap(r.bearing - bearing).abs();
    (slant < SLANT).then(|| r.range * libm::cos((slant - half_beam).max(0.0)))
}

/// The distance to a wall at `bearing` with the most agreement, and that agreement (the weight of a
/// return falls with its deviation).
fn vote(returns: &[Return], bearing: f64, half_beam: f64) -> (f64, f64) {
    let mut distances = Vec::<f64, MOST>::new();
    for distance in returns.iter().filter_map(|r| perpendicular(r, bearing, half_beam)) {
        let _ = distances.push(distance);
    }
    let mut best = (0.0, 0.0);
    for candidate in &distances {
        let score = distances.iter().map(|d| agreement(d - candidate)).sum();
        if score > best.0 {
            best = (score, *candidate);
        }
    }
    best
}

/// 1 for no deviation, 0 beyond the tolerance.
fn agreement(deviation: f64) -> f64 {
    let share = deviation / TOLERANCE;
    (1.0 - share * share).max(0.0)
}

/// The mean of the bearings around `bearing`, weighted by how well they explain the inliers.
fn refine(returns: &[Return], bearing: f64, distance: f64, half_beam: f64) -> Option<Wall> {
    let mut inliers = Vec::<Return, MOST>::new();
    for r in returns {
        let at = perpendicular(r, bearing, half_beam);
        if at.is_some_and(|at| (at - distance).abs() < TOLERANCE) {
            let _ = inliers.push(*r);
        }
    }
    let (low, high) = bearings(&inliers)?;
    if high - low < SPREAD {
        return None;
    }
    let around = |step: i32| bearing + f64::from(step) * FINE;
    let least = (-20..=20).map(|step| misfit(&inliers, around(step), half_beam).0);
    let least = least.fold(f64::INFINITY, f64::min);
    let (mut weight, mut sum) = (0.0, 0.0);
    for step in -20..=20 {
        let excess = misfit(&inliers, around(step), half_beam).0 - least;
        let w = libm::exp(-excess / (2.0 * SIGMA * SIGMA));
        (weight, sum) = (weight + w, sum + w * around(step));
    }
    let bearing = sum / weight;
    let (squares, distance) = misfit(&inliers, bearing, half_beam);
    let residual = libm::sqrt(squares / inliers.len() as f64);
    Some(Wall { bearing, distance, residual, inliers: inliers.len() })
}

/// The sum of squared deviations from the best wall at `bearing`, and the wall's distance.
fn misfit(inliers: &[Return], bearing: f64, half_beam: f64) -> (f64, f64) {
    let (mut sum, mut squares, mut count) = (0.0, 0.0, 0.0);
    for r in inliers {
        // Beyond the slant limit a return cannot be explained and counts as an outlier.
        let Some(distance) = perpendicular(r, bearing, half_beam) else {
            squares += TOLERANCE * TOLERANCE;
            continue;
        };
        (sum, squares, count) = (sum + distance, squares + distance * distance, count + 1.0);
    }
    if count == 0.0 {
        return (f64::INFINITY, 0.0);
    }
    ((squares - sum * sum / count).max(0.0), sum / count)
}

#[cfg(test)]
mod tests {
    use super::{RESIDUAL, Return, fit};
    use std::vec::Vec;

    const HALF_BEAM: f64 = 0.26;

    /// A sweep of +-60 degrees over a wall, with a deterministic ripple of 4 mm.
    fn sweep(normal_deg: f64, distance: f64) -> Vec<Return> {
        let returns = (-12..=12).map(|step| {
            let bearing = f64::from(step * 5).to_radians();
            let slant = (bearing - normal_deg.to_radians()).abs();
            let ripple = 0.004 * f64::from((step * 7_i32).rem_euclid(3) - 1);
            (
                slant,
                Return { bearing, range: distance / (slant - HALF_BEAM).max(0.0).cos() + ripple },
            )
        });
        returns.filter(|(slant, _)| slant.to_degrees() < 45.0).map(|(_, r)| r).collect()
    }

    #[test]
    fn finds_the_normal_of_a_plane_wall_within_three_degrees() {
        for normal in [-45, -30, -12, 0, 20, 40] {
            let wall = fit(&sweep(f64::from(normal), 0.6), HALF_BEAM).expect("a wall");
            assert!(
                (wall.bearing.to_degrees() - f64::from(normal)).abs() < 3.0,
                "{normal}: {wall:?}"
            );
            assert!((wall.distance - 0.6).abs() < 0.01, "{normal}: {wall:?}");
            assert!(wall.residual < RESIDUAL);
        }
    }

    #[test]
    fn an_outlier_in_the_sweep_does_not_change_the_line() {
        let mut returns = sweep(0.0, 0.6);
        returns.extend(
            (8..12).map(|step| Return { bearing: f64::from(step * 5).to_radians(), range: 0.4 }),
        );
        let wall = fit(&returns, HALF_BEAM).expect("a wall");
        assert!(wall.bearing.to_degrees().abs() < 3.0, "{wall:?}");
    }

    #[test]
    fn a_scatter_or_a_post_is_not_a_wall() {
        let scatter = (0..20).map(|i| Return {
            bearing: f64::from(i * 6 - 60).to_radians(),
            range: 0.5 + 0.15 * f64::from((i * 7) % 6),
        });
        assert_eq!(fit(&scatter.collect::<Vec<_>>(), HALF_BEAM), None);
        let post = (0..4).map(|i| Return { bearing: f64::from(i).to_radians(), range: 0.5 });
        assert_eq!(fit(&post.collect::<Vec<_>>(), HALF_BEAM), None);
        assert_eq!(fit(&[], HALF_BEAM), None);
    }
}
