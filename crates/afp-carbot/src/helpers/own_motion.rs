//! Compares optical flow with the robot's own motion.
//!
//! A place shows an object between the nearest possible depth and, below the horizon, the floor. A
//! stationary object there moves in the picture along a straight stretch, between the displacements
//! at both depths. Flow off this stretch is of an object that moves.

use crate::devices::Lens;
use crate::helpers::history::History;
use afp_core::Instant;

/// Smallest depth, metres: the bumper would touch a nearer object.
const NEAREST: f64 = 0.25;
/// Uncertainty of the floor's depth: the robot pitches a little.
const FLOOR: f64 = 1.15;

/// The camera's motion between two pictures, in the earlier picture's frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Step {
    /// Metres.
    ahead: f64,
    left: f64,
    /// Sine and cosine of the turn to the left.
    turn: (f64, f64),
}

/// A place relative to the picture's centre, pixels to the right and down.
pub(crate) type Place = [f64; 2];

impl Step {
    /// The camera's motion between two instants, if both poses are known.
    pub(crate) fn between(
        history: &History,
        lens: &Lens,
        from: Instant,
        to: Instant,
    ) -> Option<Step> {
        let (from, to) = (history.at(from)?, history.at(to)?);
        let (sin, cos) = libm::sincos(from.heading);
        let (x, y) = (to.x - from.x, to.y - from.y);
        let (sin_turn, cos_turn) = libm::sincos(to.heading - from.heading);
        let arm = lens.forward.si();
        Some(Step {
            ahead: x * cos + y * sin + arm * (cos_turn - 1.0),
            left: y * cos - x * sin + arm * sin_turn,
            turn: (sin_turn, cos_turn),
        })
    }

    /// Compares a stationary object seen at `place` with the flow's end at `found`. `focus` is the
    /// lens's focal length in pixels.
    pub(crate) fn unexplained(
        &self,
        lens: &Lens,
        focus: f64,
        place: Place,
        found: Place,
    ) -> Option<Unexplained> {
        let floor = lens.height.si() * focus / place[1];
        let farthest = if place[1] > 0.0 { floor * FLOOR } else { f64::INFINITY };
        let far = self.seen(focus, place, farthest)?;
        let near = self.seen(focus, place, NEAREST.min(farthest))?;
        let along = [near[0] - far[0], near[1] - far[1]];
        let off = [found[0] - far[0], found[1] - far[1]];
        let length = along[0] * along[0] + along[1] * along[1];
        let share = if length > 0.0 {
            ((off[0] * along[0] + off[1] * along[1]) / length).clamp(0.0, 1.0)
        } else {
            0.0
        };
        let still = [0, 1].map(|i| far[i] + along[i] * share);
        Some(Unexplained {
            pixels: libm::hypot(found[0] - still[0], found[1] - still[1]),
            explained: libm::hypot(still[0] - place[0], still[1] - place[1]),
        })
    }

    /// Where an object at `place` and `depth` appears after the step.
    fn seen(&self, focus: f64, [right, down]: Place, depth: f64) -> Option<Place> {
        // Divided by the depth, which may be infinite.
        let ahead = 1.0 - self.ahead / depth;
        let left = -right / focus - self.left / depth;
        let (sin, cos) = self.turn;
        let (ahead, left) = (ahead * cos + left * sin, left * cos - ahead * sin);
        (ahead > 0.0).then(|| [-left / ahead * focus, down / ahead])
    }
}

/// Flow relative to the robot's own motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Unexplained {
    /// Smallest distance from the explained stretch, pixels.
    pub(crate) pixels: f64,
    /// Largest displacement that the motion explains, pixels.
    pub(crate) explained: f64,
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::devices::{Motion, Reading};
    use afp_core::Duration;
    use afp_core::quantity::{Angle, Length};

    const FOCUS: f64 = 114.0;

    fn lens() -> Lens {
        Lens {
            forward: Length::from_si(0.18),
            height: Length::from_si(0.2),
            opening: Angle::from_deg(70.0),
            columns: 160,
            rows: 120,
        }
    }

    fn at(millis: u64) -> Instant {
        Instant::ZERO + Duration::from_millis(millis)
    }

    /// The step of 50 ms of steady driving and turning.
    fn step(ahead: f64, turned: f64) -> Step {
        let mut history = History::new();
        for tick in 0..=10 {
            let share = tick as f64 / 10.0;
            let motion = Motion {
                x: Length::from_si(ahead * share),
                heading: Angle::from_si(turned * share),
                ..Motion::default()
            };
            history.note(Reading::valid(motion, at(5 * tick)));
        }
        Step::between(&history, &lens(), at(0), at(50)).unwrap()
    }

    fn off(step: Step, place: Place, found: Place) -> f64 {
        step.unexplained(&lens(), FOCUS, place, found).unwrap().pixels
    }

    #[test]
    fn a_stationary_robot_causes_no_flow() {
        let step = step(0.0, 0.0);
        assert!(off(step, [10.0, -5.0], [10.0, -5.0]) < 1e-9);
        assert!((off(step, [10.0, -5.0], [13.0, -1.0]) - 5.0).abs() < 1e-9);
    }

    #[test]
    fn a_turn_to_the_left_moves_everything_to_the_right() {
        let step = step(0.0, 0.02);
        let expected = FOCUS * 0.02;
        assert!(off(step, [0.0, -10.0], [expected, -10.0]) < 0.1);
        assert!(off(step, [0.0, -10.0], [-expected, -10.0]) > expected);
    }

    #[test]
    fn while_driving_ahead_no_pixel_leaves_the_middle_faster_than_near_ones() {
        let step = step(0.02, 0.0);
        assert!(off(step, [40.0, -20.0], [40.4, -20.2]) < 1e-9, "a wall");
        assert!(off(step, [40.0, -20.0], [39.0, -19.5]) > 1.0, "it comes towards the middle");
        assert!(off(step, [40.0, -20.0], [41.0, -23.0]) > 2.0, "it goes across");
        assert!(off(step, [40.0, -20.0], [60.0, -30.0]) > 15.0, "nothing is as near as that");
    }

    #[test]
    fn the_distance_of_the_floor_is_not_overestimated() {
        // The floor in this row is 0.2 m * 114 / 50 ahead of the lens.
        let (depth, step) = (0.456, step(0.02, 0.0));
        let scale = depth / (depth - 0.02);
        assert!(off(step, [30.0, 50.0], [30.0 * scale, 50.0 * scale]) < 1e-9);
        assert!(off(step, [30.0, 50.0], [30.0, 50.0]) > 1.0, "it comes along");
    }
}
