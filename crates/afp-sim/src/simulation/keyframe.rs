//! A copy of the simulation that goes on by itself: a keyframe to come back to.

use rapier2d::prelude::{CCDSolver, CollisionPipeline, PhysicsPipeline, PhysicsWorld};

use super::Simulation;

impl Simulation {
    /// The same robot in the same world at the same instant, every noise where it is, with a clock of its own: both go
    /// on alike.
    pub(super) fn split(&self) -> Simulation {
        Simulation {
            physics: physics(&self.physics),
            body: self.body,
            collider: self.collider,
            obstacles: self.obstacles.clone(),
            shapes: self.shapes.clone(),
            start: self.start,
            now: self.now,
            steps: self.steps,
            drive: self.drive.clone(),
            odometer: self.odometer.clone(),
            rotator: self.rotator.clone(),
            sonar: self.sonar.clone(),
            ping: self.ping,
            echo: self.echo,
            switch: self.switch.clone(),
            battery: self.battery.clone(),
            scene: self.scene.clone(),
            lights: self.lights.clone(),
            movers: self.movers.clone(),
            infrared: self.infrared.clone(),
            glow: self.glow,
            color_sensor: self.color_sensor.clone(),
            color: self.color,
            exposure: self.exposure.clone(),
            exposed_before: self.exposed_before.clone(),
            flow: self.flow.clone(),
            locator: self.locator.clone(),
            located: self.located.clone(),
            planner: self.planner.clone(),
            shown: self.shown,
            seed: self.seed,
            held: self.held,
            escape: self.escape,
            stopped: self.stopped,
            faults: self.faults.clone(),
            lines: self.lines.clone(),
            delayed: self.delayed,
            clock: self.clock.split(),
            collisions: self.collisions.clone(),
            map: self.map.clone(),
            left_map: self.left_map,
        }
    }
}

/// The state of the engine. Its pipelines are room to compute in and begin empty.
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
