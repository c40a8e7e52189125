//! Obstacles that move: pushable obstacles and obstacles on a path.

use super::{DT, Stage};
use crate::vehicle::Place;
use crate::world::{Mobility, Obstacle, Path};
use afp_core::Instant;
use rapier2d::math::{Pose as Isometry, Vector};
use rapier2d::parry::shape::SharedShape;
use rapier2d::prelude::{RigidBody, RigidBodyBuilder, RigidBodyHandle};

/// The deceleration of a sliding object, in metres a second squared.
const FLOOR: f32 = 0.4 * 9.81;

#[derive(Clone)]
pub(crate) struct Mover {
    obstacle: usize,
    body: RigidBodyHandle,
    start: Isometry,
    moved_by: MovedBy,
}

#[derive(Clone)]
enum MovedBy {
    /// Follows a path.
    Scripted(Path),
    /// It is pushed; its radius of gyration is in metres and at least a centimetre.
    Pushed { gyration: f32 },
}

impl Mover {
    pub(crate) fn body(obstacle: &Obstacle, at: Isometry) -> Option<RigidBodyBuilder> {
        match obstacle.mobility {
            Mobility::Fixed => None,
            Mobility::Movable { .. } => Some(RigidBodyBuilder::dynamic().pose(at)),
            Mobility::Scripted(_) => Some(RigidBodyBuilder::kinematic_position_based().pose(at)),
        }
    }

    /// The `i`-th obstacle with its body, at `start` and with a shape.
    pub(crate) fn new(
        i: usize,
        body: RigidBodyHandle,
        (start, shape): (Isometry, &SharedShape),
        obstacle: &Obstacle,
    ) -> Self {
        let moved_by = match &obstacle.mobility {
            Mobility::Scripted(path) => MovedBy::Scripted(path.clone()),
            Mobility::Fixed | Mobility::Movable { .. } => {
                let spread = shape.mass_properties(1.0);
                let gyration = (spread.principal_inertia() * spread.inv_mass).sqrt();
                MovedBy::Pushed { gyration: gyration.max(0.01) }
            }
        };
        Mover { obstacle: i, body, start, moved_by }
    }

    pub(crate) fn obstacle(&self) -> usize {
        self.obstacle
    }

    pub(crate) fn handle(&self) -> RigidBodyHandle {
        self.body
    }

    pub(crate) fn start(&self) -> Isometry {
        self.start
    }

    /// Whether it stays in place until it is pushed. An obstacle on a path may only be waiting.
    pub(super) fn rests(&self, body: &RigidBody) -> bool {
        matches!(self.moved_by, MovedBy::Pushed { .. }) && body.is_sleeping()
    }

    /// Prepares the step that ends at `now`.
    fn step(&self, body: &mut RigidBody, now: Instant) {
        match &self.moved_by {
            MovedBy::Scripted(path) => {
                let [x, y] = path.offset(now.as_secs_f64());
                let by = Vector::new(x as f32, y as f32);
                body.set_next_kinematic_translation(self.start.translation + by);
            }
            MovedBy::Pushed { gyration } if !body.is_sleeping() => slide(body, *gyration),
            MovedBy::Pushed { .. } => {}
        }
    }
}

/// The floor's friction of one step. It acts at four places at the radius of gyration, so that a
/// turning object slides more easily and a sliding object turns more easily.
fn slide(body: &mut RigidBody, gyration: f32) {
    let less = FLOOR * DT as f32;
    let (velocity, turn) = (body.linvel(), body.angvel());
    let arm = body.rotation().transform_vector(Vector::new(gyration, 0.0));
    let (mut slower, mut calmer) = (Vector::ZERO, 0.0);
    for place in [arm, arm.perp(), -arm, -arm.perp()] {
        let moves = velocity + place.perp() * turn;
        let lost = moves * (less / moves.length().max(less)) / 4.0;
        slower += lost;
        calmer += place.perp_dot(lost) / (gyration * gyration);
    }
    body.set_linvel(velocity - slower, false);
    body.set_angvel(turn - calmer, false);
}

impl Stage {
    /// Begins the step that ends at `now` for all moving obstacles.
    pub(super) fn begin_movers(&mut self, now: Instant) {
        for mover in &self.movers {
            mover.step(&mut self.physics.bodies[mover.body], now);
        }
    }

    /// The present corners of an obstacle, by its index in [`Stage::obstacles`]: metres,
    /// counter-clockwise; empty for an unknown index.
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

    /// The moving obstacles, by their indices in [`Stage::obstacles`].
    pub fn movers(&self) -> impl Iterator<Item = usize> {
        self.movers.iter().map(|mover| mover.obstacle)
    }

    /// Records the places of all moving obstacles and reports the obstacles that have moved.
    pub(crate) fn note_movers(&mut self, mut moved: impl FnMut(usize, [f64; 2], [f64; 2])) {
        for (n, mover) in self.movers.iter().enumerate() {
            let at = *self.physics.bodies[mover.body].position();
            let Some((noted, _)) = self.shapes.get_mut(mover.obstacle) else { continue };
            if *noted != at {
                *noted = at;
                let (at, direction) = Place::new(&(at * mover.start.inverse())).parts();
                moved(n, at, direction);
            }
        }
    }
}
