//! A world and the body of one robot in the engine: pushes, rays and contacts.
//!
//! It knows neither wheels nor sensors. The simulation of a robot pushes the body, makes a step,
//! and reads the results.

mod alone;
mod build;
mod collisions;
mod movers;
mod ray;
mod split;
mod touch;

use crate::chassis::Chassis;
use crate::truth::Pose;
use crate::vehicle::{Push, Twist};
use crate::world::{Obstacle, World, WorldError};
use afp_core::{Duration, Instant};
use alone::Surroundings;
use collisions::Collisions;
use rapier2d::math::{Pose as Isometry, Vector};
use rapier2d::parry::shape::SharedShape;
use rapier2d::prelude::{ColliderHandle, PhysicsWorld, RigidBodyHandle};

pub use collisions::Collision;
pub use ray::Met;
pub use touch::Touch;

pub(crate) use build::{Built, HIGH, ROBOT, build, collider};
pub(crate) use movers::Mover;
pub(crate) use ray::Rays;

/// The fixed step of the physics.
pub const STEP: Duration = Duration::from_millis(5);

/// The step in seconds.
pub(crate) const DT: f64 = STEP.as_nanos() as f64 / 1e9;

/// A world and the body of one robot, stepped every [`STEP`].
pub struct Stage {
    pub(crate) physics: PhysicsWorld,
    pub(crate) body: RigidBodyHandle,
    collider: ColliderHandle,
    pub(crate) chassis: Chassis,
    pub(crate) obstacles: Vec<Obstacle>,
    pub(crate) shapes: Vec<(Isometry, SharedShape)>,
    pub(crate) movers: Vec<Mover>,
    collisions: Collisions,
    touches: Vec<Touch>,
    surroundings: Surroundings,
}

impl Stage {
    /// A world with a robot's body at its start.
    ///
    /// # Errors
    /// An obstacle without an area; [`World::parse`] rejects it.
    pub fn new(world: &World, chassis: Chassis) -> Result<Stage, WorldError> {
        let Built { physics, body, collider, shapes, movers } = build(world, &chassis)?;
        Ok(Stage {
            physics,
            body,
            collider,
            chassis,
            obstacles: world.obstacles.clone(),
            shapes,
            movers,
            collisions: Collisions::default(),
            touches: Vec::new(),
            surroundings: Surroundings::default(),
        })
    }

    /// The pose of the body's middle.
    pub fn pose(&self) -> Pose {
        let at = self.position();
        let heading = libm::atan2(f64::from(at.rotation.im), f64::from(at.rotation.re));
        let [x, y] = [at.translation.x, at.translation.y].map(f64::from);
        Pose { x, y, heading }
    }

    /// The body's motion, in its own frame.
    pub fn twist(&self) -> Twist {
        let body = &self.physics.bodies[self.body];
        let velocity = body.rotation().inverse_transform_vector(body.linvel());
        let [x, y] = [velocity.x, velocity.y].map(f64::from);
        Twist { x, y, turn: f64::from(body.angvel()) }
    }

    /// Sets the push on the body for the next step, in its own frame.
    pub fn push(&mut self, push: Push) {
        let body = &mut self.physics.bodies[self.body];
        let force = body.rotation().transform_vector(Vector::new(push.x as f32, push.y as f32));
        body.reset_forces(false);
        body.reset_torques(false);
        body.add_force(force, false);
        body.add_torque(push.turn as f32, false);
    }

    /// Makes the step that ends at `now`.
    pub fn step(&mut self, now: Instant) {
        self.step_noting(now, |_, _, _| {});
    }

    /// Like [`Stage::step`]. Calls `moved` for each obstacle that has moved: its index among the
    /// movable obstacles, its place relative to its start, and its direction as cosine and sine.
    pub(crate) fn step_noting(
        &mut self,
        now: Instant,
        moved: impl FnMut(usize, [f64; 2], [f64; 2]),
    ) {
        if self.step_alone() {
            return;
        }
        self.begin_movers(now);
        self.physics.step();
        self.note_movers(moved);
        self.look_around();
    }

    /// All obstacles: those of the world file in its order, then the dropped ones.
    pub fn obstacles(&self) -> &[Obstacle] {
        &self.obstacles
    }

    /// All collisions so far, in the order of their beginnings.
    pub fn collisions(&self) -> &[Collision] {
        self.collisions.all()
    }

    /// The current collisions at an instant, in the order of their beginnings.
    pub fn touching(&self, now: Instant) -> impl DoubleEndedIterator<Item = &Collision> {
        self.collisions.lasting(now)
    }

    /// Whether all bodies are still in the engine: it disables a body whose pose or velocity is not
    /// finite.
    pub fn all_enabled(&self) -> bool {
        let mut bodies = self.physics.bodies.iter();
        let mut colliders = self.physics.colliders.iter();
        bodies.all(|(_, body)| body.is_enabled())
            && colliders.all(|(_, collider)| collider.is_enabled())
    }

    pub(crate) fn position(&self) -> &Isometry {
        self.physics.bodies[self.body].position()
    }
}
