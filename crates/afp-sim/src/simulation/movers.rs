//! Obstacles that move: those that can be pushed and those that go their own way.

use super::{DT, Simulation};
use crate::vehicle::Place;
use crate::world::{Mobility, Obstacle, Path};
use afp_core::Instant;
use rapier2d::math::{Pose as Isometry, Vector};
use rapier2d::prelude::{RigidBody, RigidBodyBuilder, RigidBodyHandle};

/// How fast something that slides over the floor gets slower, metres a second squared.
const FLOOR: f32 = 0.4 * 9.81;
/// And how fast the edge of something that turns does, as a share of that.
const TURNING: f32 = 4.0 / 3.0;

/// An obstacle that moves.
pub(super) struct Mover {
    obstacle: usize,
    body: RigidBodyHandle,
    /// Where it was at the start.
    start: Isometry,
    way: Way,
}

/// How it moves.
enum Way {
    /// By itself.
    Scripted(Path),
    /// When it is pushed; its middle is so far from its rim, metres.
    Pushed { radius: f32 },
}

impl Mover {
    /// A body for an obstacle that moves; none for one that does not.
    pub(super) fn body(obstacle: &Obstacle, at: Isometry) -> Option<RigidBodyBuilder> {
        match obstacle.mobility {
            Mobility::Fixed => None,
            Mobility::Movable { .. } => Some(RigidBodyBuilder::dynamic().pose(at)),
            Mobility::Scripted(_) => Some(RigidBodyBuilder::kinematic_position_based().pose(at)),
        }
    }

    /// The `i`-th obstacle, with its body.
    pub(super) fn new(i: usize, body: RigidBodyHandle, at: Isometry, obstacle: &Obstacle) -> Self {
        let way = match &obstacle.mobility {
            Mobility::Scripted(path) => Way::Scripted(path.clone()),
            Mobility::Fixed | Mobility::Movable { .. } => Way::Pushed { radius: radius(obstacle) },
        };
        Mover { obstacle: i, body, start: at, way }
    }

    /// Prepares the step that ends at `now`.
    fn step(&self, body: &mut RigidBody, now: Instant) {
        match &self.way {
            Way::Scripted(path) => {
                let [x, y] = path.offset(now.as_secs_f64());
                let by = Vector::new(x as f32, y as f32);
                body.set_next_kinematic_translation(self.start.translation + by);
            }
            Way::Pushed { radius } if !body.is_sleeping() => slide(body, *radius),
            Way::Pushed { .. } => {}
        }
    }
}

/// Half the distance between the corners that are farthest apart, or a little more.
fn radius(obstacle: &Obstacle) -> f32 {
    let corners = obstacle.outline.corners();
    let first = corners.first().copied().unwrap_or_default();
    let far = |c: &[f64; 2]| libm::hypot(c[0] - first[0], c[1] - first[1]) / 2.0;
    corners.iter().map(far).fold(0.01, f64::max) as f32
}

/// The floor's friction of one step.
fn slide(body: &mut RigidBody, radius: f32) {
    let less = FLOOR * DT as f32;
    let velocity = body.linvel();
    let speed = velocity.length();
    let slower = if speed > less { velocity * (1.0 - less / speed) } else { Vector::ZERO };
    let (turn, less) = (body.angvel(), TURNING * less / radius);
    body.set_linvel(slower, false);
    body.set_angvel(if turn.abs() > less { turn - less * turn.signum() } else { 0.0 }, false);
}

impl Simulation {
    /// Lets everything that moves begin the step that ends at `now`.
    pub(super) fn move_obstacles(&mut self, now: Instant) {
        for mover in &self.movers {
            mover.step(&mut self.physics.bodies[mover.body], now);
        }
    }

    /// The corners of an obstacle, by its place in [`World::obstacles`](crate::World), where it is now: metres,
    /// counter-clockwise; none for an obstacle that is not there.
    pub fn outline(&self, obstacle: usize) -> Vec<[f64; 2]> {
        let Some(there) = self.obstacles.get(obstacle) else { return Vec::new() };
        let corners = there.outline.corners();
        let Some(mover) = self.movers.iter().find(|mover| mover.obstacle == obstacle) else {
            return corners;
        };
        let moved =
            Place::new(&(self.physics.bodies[mover.body].position() * mover.start.inverse()));
        corners.into_iter().map(|[x, y]| moved.beyond(x, y)).collect()
    }

    /// The obstacles that move, by their places in [`World::obstacles`](crate::World).
    pub fn movers(&self) -> impl Iterator<Item = usize> {
        self.movers.iter().map(|mover| mover.obstacle)
    }

    /// Notes where everything that moves is after a step.
    pub(super) fn note_obstacles(&mut self) {
        for (n, mover) in self.movers.iter().enumerate() {
            let at = *self.physics.bodies[mover.body].position();
            let Some((noted, _)) = self.shapes.get_mut(mover.obstacle) else { continue };
            if *noted != at {
                *noted = at;
                let (at, direction) = Place::new(&(at * mover.start.inverse())).parts();
                self.scene.place(n, at, direction);
            }
        }
    }
}
