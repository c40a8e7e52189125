//! Contacts: what the bumper feels, and what the judge counts; and the edge of a map, which nothing feels.

use super::Simulation;
use crate::vehicle::HALF_LENGTH;
use crate::world::is_beyond;
use afp_core::Instant;
use rapier2d::parry::query;

/// Nearer than this is a touch, metres.
const TOUCH: f32 = 0.001;
/// What pushes is no farther away than what comes closer at 1 m/s in a step.
const PUSH: f32 = 0.005;
/// The bumper covers the front face and this much of the sides, metres.
const WRAP: f64 = 0.02;

impl Simulation {
    /// Looks at what the robot touches after a step.
    ///
    /// The engine keeps a pair's contact points over several steps, so the distance is computed
    /// afresh for the few pairs that are near.
    pub(super) fn feel(&mut self, now: Instant) {
        let mut touched = false;
        for pair in self.physics.narrow_phase.contact_pairs_with(self.collider) {
            if !pair.has_any_active_contact() {
                continue;
            }
            let other =
                if pair.collider1 == self.collider { pair.collider2 } else { pair.collider1 };
            let colliders = &self.physics.colliders;
            let (robot, other) = (&colliders[self.collider], &colliders[other]);
            let (at, there) = (robot.position(), other.position());
            // What the engine held apart in this step, in advance of any touch, pushed all the same.
            let near = if pair.total_impulse_magnitude() > 0.0 { PUSH } else { TOUCH };
            let contact = query::contact(at, robot.shape(), there, other.shape(), near);
            let Ok(Some(contact)) = contact else { continue };
            self.collisions.touch(other.user_data as usize, now);
            let ahead = at.inverse_transform_point(contact.point1).x;
            touched |= f64::from(ahead) > HALF_LENGTH - WRAP;
        }
        self.switch.step(touched);
    }

    /// Notes when the robot leaves the map.
    pub(super) fn look_for_edge(&mut self, now: Instant) {
        let at = self.position().translation;
        if self.left_map.is_none() && is_beyond(&self.map, [at.x, at.y].map(f64::from)) {
            self.left_map = Some(now);
        }
    }
}
