//! The contacts of the robot's body.

use super::Stage;
use afp_core::Instant;
use rapier2d::parry::query;

/// The maximum distance of a touch, in metres.
const TOUCH: f32 = 0.001;
/// The maximum distance of a pushing obstacle. The engine keeps a pair's contact points during
/// small motions. It once pushed across a gap of 13 mm at a passing corner.
const PUSH: f32 = 0.02;

/// A contact of the robot's body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Touch {
    /// The index in [`Stage::obstacles`].
    pub obstacle: usize,
    /// The place in the body's frame: ahead and to the left of its middle, in metres.
    pub at: [f64; 2],
    /// The direction from the body into the obstacle, a unit vector in the body's frame.
    pub into: [f64; 2],
}

impl Touch {
    /// The speed of a motion of the body into the obstacle, in metres a second; negative away from
    /// it. The motion is in metres and radians a second about the middle.
    pub fn speed_into(&self, (ahead, turn): (f64, f64)) -> f64 {
        let [x, y] = self.at;
        (ahead - turn * y) * self.into[0] + turn * x * self.into[1]
    }
}

impl Stage {
    /// The contacts at the last check.
    pub fn touches(&self) -> &[Touch] {
        &self.touches
    }

    /// Checks the robot's contacts after a step, records them as collisions, and calls `felt` for
    /// each.
    ///
    /// The engine keeps a pair's contact points over several steps. This function computes the
    /// distances of near pairs again.
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
            // The engine separates bodies before they touch; such a pair has pushed in this step,
            // too.
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
