//! The robot's recent path, which was free of obstacles.

use crate::devices::{Body, Motion};
use crate::helpers::history::Pose;
use afp_core::quantity::{Angle, Length};

/// Number of places and their least distance, metres. They cover 60 cm driven, or half a turn in
/// place.
const KEPT: usize = 40;
const APART: f64 = 0.015;
/// A larger jump between two readings means that the odometry has restarted, metres.
const JUMP: f64 = 0.3;

/// The latest poses by odometry. Driving back removes the last poses, so that the trail leads
/// farther back.
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
    /// An empty trail.
    pub const fn new() -> Self {
        Trail { places: [Pose { x: 0.0, y: 0.0, heading: 0.0 }; KEPT], next: 0, known: 0 }
    }

    /// Stores the robot's pose if it is far enough from the last. Call this for every reading.
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
            // The robot went back if it is nearer to the place before the newest.
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

    /// The trail back from `here`, without places that are close to it.
    pub(crate) fn back_from(mut self, here: &Pose, lever: Length) -> Self {
        if self.place(1).is_some_and(|newest| newest.distance_to(here, lever) <= APART) {
            self.drop_newest();
        }
        self
    }

    /// The `ago`-th latest place, counted from 1.
    pub(crate) fn place(&self, ago: usize) -> Option<Pose> {
        (ago <= self.known).then(|| self.places[(self.next + KEPT - ago) % KEPT])
    }

    pub(crate) fn drop_newest(&mut self) {
        self.next = (self.next + KEPT - 1) % KEPT;
        self.known = self.known.saturating_sub(1);
    }
}

impl Pose {
    /// Distance to another place, metres; a turn counts by the body's lever.
    pub(crate) fn distance_to(&self, other: &Pose, lever: Length) -> f64 {
        let turn = lever.si() * (other.heading - self.heading);
        let (x, y) = (other.x - self.x, other.y - self.y);
        libm::sqrt(x * x + y * y + turn * turn)
    }

    /// The place at this distance straight behind.
    pub(crate) fn behind(&self, distance: f64) -> Pose {
        let (sin, cos) = libm::sincos(self.heading);
        Pose { x: self.x - distance * cos, y: self.y - distance * sin, heading: self.heading }
    }

    /// The motion of a robot that is stationary there.
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

    /// The trail of a robot whose farthest side is `side` metres from its turning centre.
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
    fn it_remembers_separate_places_newest_first() {
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
    fn a_retraced_part_is_removed() {
        let out = (0..20).map(|n| (0.02 * f64::from(n), 0.0));
        let back = (10..19).rev().map(|n| (0.02 * f64::from(n), 0.0));
        let places: Vec<_> = out.chain(back).collect();
        let ahead: Vec<_> = known(&noted(&places)).iter().map(|at| at.0).collect();
        assert!(ahead[0] < 0.23 && ahead.is_sorted_by(|a, b| a > b), "{ahead:?}");
    }

    #[test]
    fn old_places_are_dropped_and_a_jump_clears_all() {
        let mut places: Vec<_> = (0..100).map(|n| (0.02 * f64::from(n), 0.0)).collect();
        assert_eq!(known(&noted(&places)).len(), KEPT);
        places.push((5.0, 0.0));
        assert_eq!(known(&noted(&places)), [(5.0, 0.0)]);
    }
}
