//! The path on which the robot came: where nothing stood a moment ago.

use crate::devices::{Body, Motion};
use crate::helpers::history::Pose;
use afp_core::quantity::{Angle, Length};

/// So many places are remembered, no closer than this, metres: 60 cm driven, or half a turn in place.
const KEPT: usize = 40;
const APART: f64 = 0.015;
/// Wheels do not carry a robot this far between two readings: it has begun to count anew.
const JUMP: f64 = 0.3;

/// The latest places of a robot by its odometry. What it goes back is taken off again, so that the trail leads on to
/// where it was before.
#[derive(Clone, Copy, Debug)]
pub struct Trail {
    /// The newest is before `next`.
    places: [Pose; KEPT],
    next: usize,
    known: usize,
}

impl Default for Trail {
    fn default() -> Self {
        Trail::new()
    }
}

impl Trail {
    /// Nothing is known yet.
    pub const fn new() -> Self {
        Trail { places: [Pose { x: 0.0, y: 0.0, heading: 0.0 }; KEPT], next: 0, known: 0 }
    }

    /// Remembers where a robot with this body is, if that is far enough from where it was. To be called for every reading.
    pub fn note(&mut self, motion: Motion, body: &Body) {
        let here = motion.into();
        let lever = body.lever();
        let far = |newest: Pose, distance| newest.distance_to(&here, lever) > distance;
        if self.place(1).is_some_and(|newest| far(newest, JUMP)) {
            self.known = 0;
        }
        while let Some(newest) = self.place(1) {
            if !far(newest, APART) {
                return;
            }
            // Nearer to the place before the newest than that one is, it went back.
            let went_back = |before: Pose| {
                before.distance_to(&here, lever) < before.distance_to(&newest, lever)
            };
            if !self.place(2).is_some_and(went_back) {
                break;
            }
            self.drop_newest();
        }
        self.places[self.next] = here;
        self.next = (self.next + 1) % KEPT;
        self.known = (self.known + 1).min(KEPT);
    }

    /// Where it leads back to from a place: the newest that is not about there.
    pub(crate) fn back_from(mut self, here: &Pose, lever: Length) -> Self {
        if self.place(1).is_some_and(|newest| newest.distance_to(here, lever) <= APART) {
            self.drop_newest();
        }
        self
    }

    /// The place that the robot came by last, the one before it, and so on, counted from 1; none where nothing is known.
    pub(crate) fn place(&self, ago: usize) -> Option<Pose> {
        (ago <= self.known).then(|| self.places[(self.next + KEPT - ago) % KEPT])
    }

    /// Takes off the place that it came by last.
    pub(crate) fn drop_newest(&mut self) {
        self.next = (self.next + KEPT - 1) % KEPT;
        self.known = self.known.saturating_sub(1);
    }
}

impl Pose {
    /// How far it is to another place, metres; a turn counts by a body's lever.
    pub(crate) fn distance_to(&self, other: &Pose, lever: Length) -> f64 {
        let turn = lever.si() * (other.heading - self.heading);
        let (x, y) = (other.x - self.x, other.y - self.y);
        libm::sqrt(x * x + y * y + turn * turn)
    }

    /// The place so far straight behind.
    pub(crate) fn behind(&self, distance: f64) -> Pose {
        let (sin, cos) = libm::sincos(self.heading);
        Pose { x: self.x - distance * cos, y: self.y - distance * sin, heading: self.heading }
    }

    /// As a motion of a robot that stands there.
    pub(crate) fn standing(&self) -> Motion {
        Motion {
            x: Length::from_si(self.x),
            y: Length::from_si(self.y),
            heading: Angle::from_si(self.heading),
            ..Motion::default()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::vec::Vec;

    /// Of a robot whose farthest side is so far from its turning centre, metres.
    fn noted_by(side: f64, places: &[(f64, f64)]) -> Trail {
        let [front, rear, half_width] = [0.1, side, 0.1].map(Length::from_si);
        let mut trail = Trail::new();
        for &(x, heading) in places {
            let motion = Pose { x, y: 0.0, heading }.standing();
            trail.note(motion, &Body { front, rear, half_width });
        }
        trail
    }

    fn noted(places: &[(f64, f64)]) -> Trail {
        noted_by(0.2, places)
    }

    fn known(trail: &Trail) -> Vec<(f64, f64)> {
        (1..).map_while(|ago| trail.place(ago)).map(|at| (at.x, at.heading)).collect()
    }

    #[test]
    fn remembers_places_apart_newest_first() {
        let trail = noted(&[(0.0, 0.0), (0.01, 0.0), (0.02, 0.0), (0.02, 0.05), (0.02, 0.1)]);
        assert_eq!(known(&trail), [(0.02, 0.1), (0.02, 0.0), (0.0, 0.0)]);
    }

    #[test]
    fn a_turn_carries_a_larger_robot_farther() {
        let turn: Vec<_> = (0..20).map(|n| (0.0, 0.02 * f64::from(n))).collect();
        let places = |side| known(&noted_by(side, &turn)).len();
        assert_eq!((places(0.2), places(0.4), places(0.8)), (5, 10, 20));
    }

    #[test]
    fn what_is_gone_back_is_taken_off() {
        let out = (0..20).map(|n| (0.02 * f64::from(n), 0.0));
        let back = (10..19).rev().map(|n| (0.02 * f64::from(n), 0.0));
        let places: Vec<_> = out.chain(back).collect();
        let ahead: Vec<_> = known(&noted(&places)).iter().map(|at| at.0).collect();
        assert!(ahead[0] < 0.23 && ahead.is_sorted_by(|a, b| a > b), "{ahead:?}");
    }

    #[test]
    fn the_oldest_make_room_and_a_jump_forgets_all() {
        let mut places: Vec<_> = (0..100).map(|n| (0.02 * f64::from(n), 0.0)).collect();
        assert_eq!(known(&noted(&places)).len(), KEPT);
        places.push((5.0, 0.0));
        assert_eq!(known(&noted(&places)), [(5.0, 0.0)]);
    }
}
