//! A copy of a stage with its own future.

use super::Stage;
use rapier2d::prelude::{CCDSolver, CollisionPipeline, PhysicsPipeline, PhysicsWorld};

/// The same state at the same instant: both copies continue alike.
impl Clone for Stage {
    fn clone(&self) -> Self {
        Stage {
            physics: physics(&self.physics),
            body: self.body,
            collider: self.collider,
            chassis: self.chassis,
            obstacles: self.obstacles.clone(),
            shapes: self.shapes.clone(),
            movers: self.movers.clone(),
            collisions: self.collisions.clone(),
            touches: self.touches.clone(),
            surroundings: self.surroundings,
        }
    }
}

/// The state of the engine. Its pipelines are only buffers and begin empty.
fn physics(of: &PhysicsWorld) -> PhysicsWorld {
    PhysicsWorld {
        gravity: of.gravity,
        integration_parameters: of.integration_parameters,
        physics_pipeline: PhysicsPipeline::new(),
        collision_pipeline: CollisionPipeline::new(),
        islands: of.islands.clone(),
        broad_phase: of.broad_phase.clone(),
        narrow_phase: of.narrow_phase.clone(),
        bodies: of.bodies.clone(),
        colliders: of.colliders.clone(),
        impulse_joints: of.impulse_joints.clone(),
        multibody_joints: of.multibody_joints.clone(),
        soft_bodies: of.soft_bodies.clone(),
        ccd_solver: CCDSolver::new(),
    }
}
