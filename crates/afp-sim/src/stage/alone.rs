//! Steps of a robot without neighbours, computed without the engine.
//!
//! Most steps are of this kind. The engine keeps a box around the robot, some centimetres wider
//! than the robot, and searches for neighbours only when the robot leaves it. If the box has
//! nothing else in it and nothing else moves, the engine only integrates one body. This module does
//! the same operations in the same order.

use super::Stage;
use rapier2d::math::{Pose as Isometry, Rotation};
use rapier2d::parry::bounding_volume::{Aabb, BoundingVolume};

/// Below these speeds the engine neither limits a body's speed nor sweeps its path: metres and
/// radians a second.
const SLOW: f32 = 1.0;
const CALM: f32 = 10.0;

/// The known surroundings of the robot.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Surroundings {
    /// The engine's box around the robot after its last step.
    boxed: Option<Aabb>,
    /// The same box, if the robot is alone in it and nothing else moves.
    free: Option<Aabb>,
}

impl Stage {
    /// Makes the engine's step if the robot stays where nothing can touch it. Returns whether it
    /// did.
    pub(super) fn step_alone(&mut self) -> bool {
        let Some(free) = self.surroundings.free else { return false };
        let parameters = &self.physics.integration_parameters;
        let parts = parameters.num_solver_iterations;
        let dt = parameters.dt / parts as f32;
        let margin = parameters.prediction_distance() / 2.0;
        let body = &self.physics.bodies[self.body];
        let masses = body.mass_properties();
        let faster = body.user_force() * masses.effective_inv_mass * dt;
        let turns = masses.effective_world_inv_inertia * body.user_torque() * dt;
        let middle = masses.local_mprops.local_com;
        let (mut velocity, mut turn) = (body.linvel(), body.angvel());
        let mut pose = body.position().prepend_translation(middle);
        for _ in 0..parts {
            velocity += faster;
            turn += turns;
            let (Rotation { re, im, .. }, angle) = (pose.rotation, turn * dt);
            pose.rotation = Rotation::from_cos_sin_unchecked(re - angle * im, im + angle * re);
            pose.rotation.normalize_mut();
            pose.translation += velocity * dt;
        }
        let pose = pose.prepend_translation(-middle);
        let fits = free.contains(&self.boxed_at(&pose, margin));
        if !fits || velocity.length() > SLOW || turn.abs() > CALM {
            return false;
        }
        let body = &mut self.physics.bodies[self.body];
        body.set_position(pose, false);
        body.set_linvel(velocity, false);
        body.set_angvel(turn, false);
        true
    }

    /// Updates the surroundings after a step of the engine. The engine itself handles a body that
    /// left its box in the next step.
    pub(super) fn look_around(&mut self) {
        let leaf = self.collider.into_raw_parts().0;
        let boxed = self.physics.query_pipeline().bvh.leaf_node(leaf).map(|leaf| leaf.aabb());
        let bodies = &self.physics.bodies;
        let settled = boxed == self.surroundings.boxed
            && self.movers.iter().all(|mover| mover.rests(&bodies[mover.handle()]))
            && self.physics.narrow_phase.contact_pairs_with(self.collider).next().is_none();
        self.surroundings = Surroundings { boxed, free: boxed.filter(|_| settled) };
    }

    /// Forgets the surroundings after an outside change.
    pub(crate) fn disturb(&mut self) {
        self.surroundings = Surroundings::default();
    }

    fn boxed_at(&self, pose: &Isometry, margin: f32) -> Aabb {
        let robot = &self.physics.colliders[self.collider];
        robot.shape().compute_aabb(pose).loosened(robot.contact_skin() + margin)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::chassis::Chassis;
    use crate::stage::STEP;
    use crate::vehicle::Push;
    use crate::world::World;
    use afp_core::Instant;

    /// A push that changes from time to time, against the motion, so that the robot drives back and
    /// forth and into obstacles.
    fn push(stage: &Stage, step: u64) -> Push {
        let twist = stage.twist();
        let [ahead, turn] = [(step / 160) % 3, (step / 110) % 4].map(|n| n as f64);
        Push {
            x: 20.0 * (0.3 - twist.x) - 4.0 * ahead,
            y: -20.0 * twist.y,
            turn: 1.5 * (turn - 1.5 - twist.turn),
        }
    }

    #[test]
    fn steps_without_the_engine_equal_its_steps_bit_for_bit() {
        let (mut alone, mut touches) = (0, 0);
        for room in 0..12 {
            let world = World::random(room);
            let stage = || Stage::new(&world, Chassis::CARBOT).unwrap();
            let (mut ours, mut engine) = (stage(), stage());
            for step in 1..=2000 {
                let now = Instant::from_nanos(step * STEP.as_nanos());
                engine.disturb();
                for stage in [&mut ours, &mut engine] {
                    stage.push(push(stage, step));
                    stage.step(now);
                    stage.feel(now, |_| {});
                }
                alone += u32::from(ours.surroundings.free.is_some());
                assert_eq!(ours.position(), engine.position(), "room {room}, step {step}");
                assert_eq!(ours.twist(), engine.twist(), "room {room}, step {step}");
                let rays = |stage: &Stage| [-0.4, 0.0, 0.4].map(|at| stage.ray(0.1, at, 4.0));
                assert_eq!(rays(&ours), rays(&engine), "room {room}, step {step}");
            }
            assert_eq!(ours.collisions(), engine.collisions(), "room {room}");
            touches += ours.collisions().len();
        }
        assert!(alone > 8000 && touches > 10, "{alone} of 24000 steps, {touches} touches");
    }
}
