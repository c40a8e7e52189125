//! Find the widest gap in a distance map.

use crate::helpers::line_fit::Return;
use crate::helpers::sweep::STEP;
use crate::templates;
use crate::templates::widest_gap::{Inputs, State};
use afp_core::quantity::{Angle, Length};
use afp_core::{Computation, Fault};

/// Finds the widest run of neighbouring directions that are free far enough.
///
/// A wide beam hears an obstacle next to a gap half a beam early. So a gap is never overestimated,
/// and gaps narrower than the beam are not found. Surfaces that reflect no sound look like free
/// space; watch the lane while driving into a gap.
#[derive(Clone, Copy, Debug)]
pub struct WidestGap;

/// A run of free neighbouring directions: the first and the last, radians.
#[derive(Clone, Copy, Debug)]
struct Gap(f64, f64);

impl Gap {
    /// Each direction covers half a step to either side.
    fn angle(self) -> f64 {
        (self.1 - self.0).abs() + STEP
    }

    fn middle(self) -> f64 {
        (self.0 + self.1) / 2.0
    }

    /// The wider gap; of equally wide gaps, the gap nearer to the heading.
    fn better(self, other: Gap) -> Gap {
        let wider = other.angle() - self.angle();
        let alike = wider.abs() < STEP / 2.0;
        let ahead = other.middle().abs() < self.middle().abs();
        if (alike && ahead) || (!alike && wider > 0.0) { other } else { self }
    }

    /// Width at a distance: the chord, at most the diameter of the circle.
    fn width(self, distance: f64) -> f64 {
        2.0 * distance * libm::sin(self.angle().min(core::f64::consts::PI) / 2.0)
    }
}

impl Computation<templates::WidestGap> for WidestGap {
    fn compute(inputs: Inputs<'_>) -> Result<State, Fault> {
        let distance = inputs.distance.si();
        let Some(gap) = widest(inputs.map.returns(), distance) else { return Ok(State::NoGap) };
        let width = gap.width(distance);
        Ok(if width < inputs.width.si() {
            State::NoGap
        } else {
            let bearing = Angle::from_si(gap.middle());
            State::GapFound { bearing, found: Length::from_si(width) }
        })
    }
}

fn widest(returns: &[Return], distance: f64) -> Option<Gap> {
    let (mut best, mut open): (Option<Gap>, Option<Gap>) = (None, None);
    for heard in returns {
        open = (heard.range >= distance)
            .then(|| Gap(open.map_or(heard.bearing, |gap| gap.0), heard.bearing));
        if let Some(gap) = open {
            best = Some(best.map_or(gap, |best| best.better(gap)));
        }
    }
    best
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::objects::DistanceMap;

    /// A sweep to 120 deg; the given stretches, in degrees, are `near` metres away.
    fn map(near: f64, stretches: &[(i32, i32)], leftward: bool) -> DistanceMap {
        let mut map = DistanceMap::default();
        for n in 0..49 {
            let deg = if leftward { -120 + 5 * n } else { 120 - 5 * n };
            let blocked = stretches.iter().any(|(from, to)| (*from..=*to).contains(&deg));
            let range = if blocked { near } else { f64::INFINITY };
            map.add(Return { bearing: f64::from(deg).to_radians(), range });
        }
        map
    }

    /// Bearing in degrees and width in centimetres, rounded.
    fn found(map: &DistanceMap, width: f64) -> Option<(i64, i64)> {
        let (distance, width) = (Length::from_si(1.0), Length::from_si(width));
        match WidestGap::compute(Inputs { map, distance, width }).unwrap() {
            State::NoGap => None,
            State::GapFound { bearing, found } => {
                let (deg, cm) = (bearing.si().to_degrees(), found.si() * 100.0);
                Some((deg.round() as i64, cm.round() as i64))
            }
        }
    }

    #[test]
    fn the_wider_of_two_gaps_is_found_in_both_sweep_directions() {
        for leftward in [true, false] {
            let map = map(0.5, &[(-120, -70), (-30, 30), (75, 120)], leftward);
            assert_eq!(found(&map, 0.4), Some((53, 68)));
        }
    }

    #[test]
    fn the_gap_nearer_to_the_heading_wins_a_tie() {
        for leftward in [true, false] {
            let map = map(0.5, &[(-120, -70), (-30, 50), (90, 120)], leftward);
            assert_eq!(found(&map, 0.4), Some((-50, 60)));
        }
    }

    #[test]
    fn free_space_is_one_gap_and_blocked_space_is_no_gap() {
        assert_eq!(found(&map(0.5, &[], true), 2.0), Some((0, 200)));
        assert_eq!(found(&map(0.5, &[(-120, 120)], true), 0.1), None);
        assert_eq!(found(&DistanceMap::default(), 0.1), None);
    }

    #[test]
    fn a_distant_direction_is_free_and_a_narrow_gap_is_not() {
        assert_eq!(found(&map(1.0, &[(-120, 120)], true), 0.1), Some((0, 200)));
        let narrow = map(0.5, &[(-120, -5), (15, 120)], true);
        assert_eq!((found(&narrow, 0.2), found(&narrow, 0.3)), (Some((5, 26)), None));
    }
}
