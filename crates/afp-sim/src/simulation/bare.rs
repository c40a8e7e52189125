//! Only the engine: the baseline for benchmarks of the simulation.

use crate::chassis::Measures;
use crate::devices::sonar;
use crate::stage::{Built, HIGH, ROBOT, build};
use crate::truth::Pose;
use crate::world::{World, WorldError};
use rapier2d::geometry::{InteractionGroups, InteractionTestMode};
use rapier2d::math::Vector;
use rapier2d::prelude::{PhysicsWorld, QueryFilter, Ray};

/// The same world and body without wheels, sensors, bumper and judge.
pub struct Bare {
    physics: PhysicsWorld,
}

impl Bare {
    /// The engine with the world's obstacles and the robot's body, which moves freely.
    ///
    /// # Errors
    /// As for [`crate::Simulation::new`].
    pub fn new(world: &World) -> Result<Self, WorldError> {
        let Built { mut physics, body, .. } = build(world, &world.measures.chassis())?;
        physics.bodies[body].set_linvel(Vector::new(0.01, 0.0), true);
        Ok(Bare { physics })
    }

    /// One physics step.
    pub fn step(&mut self) {
        self.physics.step();
    }

    /// Casts the rays of one ping from a robot at `from`, with the sensor at `bearing` against the
    /// heading, in radians. Returns how many rays hit an obstacle.
    pub fn ping(&self, from: Pose, bearing: f64) -> usize {
        let heard = InteractionGroups::new(ROBOT, HIGH, InteractionTestMode::And);
        let queries = self.physics.query_pipeline_with_filter(QueryFilter::new().groups(heard));
        let (sin, cos) = libm::sincos(from.heading);
        let ahead = Measures::CARBOT.sonar;
        let origin = Vector::new((from.x + ahead * cos) as f32, (from.y + ahead * sin) as f32);
        let rays = (0..sonar::RAYS).map(|i| {
            let (sin, cos) = libm::sincos(from.heading + bearing + i as f64 * 0.06 - 0.24);
            Ray::new(origin, Vector::new(cos as f32, sin as f32))
        });
        let range = sonar::MAX as f32;
        rays.filter(|ray| queries.cast_ray_and_get_normal(ray, range, true).is_some()).count()
    }
}
