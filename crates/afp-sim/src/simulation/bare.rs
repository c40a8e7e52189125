//! The engine alone: what a benchmark measures the simulation against.

use super::{Built, build};
use crate::world::{World, WorldError};
use rapier2d::math::Vector;
use rapier2d::prelude::{PhysicsWorld, QueryFilter, Ray, RigidBodyHandle};

/// The same world and body without wheels, sensors, bumper and judge.
pub struct Bare {
    physics: PhysicsWorld,
    body: RigidBodyHandle,
}

impl Bare {
    /// The engine with the world's obstacles and the robot's body, which moves freely.
    ///
    /// # Errors
    /// As for [`crate::Simulation::new`].
    pub fn new(world: &World) -> Result<Self, WorldError> {
        let Built { mut physics, body, .. } = build(world)?;
        physics.bodies[body].set_linvel(Vector::new(0.01, 0.0), true);
        Ok(Bare { physics, body })
    }

    /// One physics step.
    pub fn step(&mut self) {
        self.physics.step();
    }

    /// Casts the rays of one ping straight ahead; returns how many met something.
    pub fn ping(&self) -> usize {
        let at = self.physics.bodies[self.body].position();
        let filter = QueryFilter::new().exclude_rigid_body(self.body);
        let queries = self.physics.query_pipeline_with_filter(filter);
        let rays = (0..crate::robot::sonar::RAYS).map(|i| {
            let aside = i as f32 * 0.06 - 0.24;
            at.transform_vector(Vector::new(1.0 - aside * aside / 2.0, aside))
        });
        let range = crate::robot::sonar::MAX as f32;
        rays.filter(|way| {
            let ray = Ray::new(at.translation, *way);
            queries.cast_ray_and_get_normal(&ray, range, true).is_some()
        })
        .count()
    }
}
