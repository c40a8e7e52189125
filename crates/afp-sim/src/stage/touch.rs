//! What the robot's body touches.

use super::Stage;
use afp_core::Instant;
use rapier2d::parry::query;

/// Nearer than this is a touch, metres.
const TOUCH: f32 = 0.001;
/// What pushes is no farther away: the engine keeps a pair's contact points while it moves little, and has been seen to push
/// across a gap of 13 mm at a corner that went by.
const PUSH: f32 = 0.02;

/// Something that the robot's body touches.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Touch {
    /// By its place among the [`Stage::obstacles`].
    pub obstacle: usize,
    /// Where, in the body's frame: ahead and to the left of its middle, metres.
    pub at: [f64; 2],
    /// Out of the body into the thing, a unit vector of the body's frame.
    pub into: [f64; 2],
}

impl Touch {
    /// How fast a motion of the body, metres and radians a second about its middle, would go into the thing, metres a
    /// second; negative where it leaves it.
    pub fn speed_into(&self, (ahead, turn): (f64, f64)) -> f64 {
        let [x, y] = self.at;
        (ahead - turn * y) * self.into[0] + turn * x * self.into[1]
    }
}

impl Stage {
    /// What the robot touched when it was last looked at.
    pub fn touches(&self) -> &[Touch] {
        &self.touches
    }

    /// Looks at what the robot touches after a step, notes it as collisions, and tells of each touch.
    ///
    /// The engine keeps a pair's contact points over several steps, so the distance is computed
    /// afresh for the few pairs that are near.
    pub fn feel(&mut self, now: Instant, mut felt: impl FnMut(Touch)) {
        self.touches.clear();
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
            let obstacle = other.user_data as usize;
            self.collisions.touch(obstacle, now);
            let point = at.inverse_transform_point(contact.point1);
            let into = at.rotation.inverse_transform_vector(contact.normal1);
            let [at, into] = [point, into].map(|it| [it.x, it.y].map(f64::from));
            let touch = Touch { obstacle, at, into };
            self.touches.push(touch);
            felt(touch);
        }
    }
}
