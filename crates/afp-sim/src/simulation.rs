//! The robot in its world, in virtual time.

mod bare;
mod bumper;
mod devices;
mod snapshot;

pub use bare::Bare;
pub use snapshot::{Snapshot, Sonar};

use crate::noise::{Noise, Source};
use crate::robot::drive::{Drive, Twist};
use crate::robot::odometer::Odometer;
use crate::robot::servo::Servo;
use crate::robot::sonar::{self, Hit};
use crate::robot::{HALF_LENGTH, HALF_WIDTH, MASS, SONAR_FORWARD, SONAR_HEIGHT};
use crate::truth::{Collisions, Truth};
use crate::world::{Obstacle, World, WorldError, isometry};
use afp_carbot::devices::{Echo, Invalid, Reading};
use afp_core::quantity::Angle;
use afp_core::{Duration, Instant};
use rapier2d::geometry::{Group, InteractionGroups, InteractionTestMode};
use rapier2d::math::{Pose as Isometry, Vector};
use rapier2d::parry::shape::SharedShape;
use rapier2d::prelude::{
    ColliderBuilder, ColliderHandle, PhysicsWorld, QueryFilter, Ray, RigidBodyBuilder,
    RigidBodyHandle,
};

/// The physics' own grid.
pub const STEP: Duration = Duration::from_millis(5);

/// The step in seconds.
const DT: f64 = 0.005;
/// What the range sensor hears.
const HIGH: Group = Group::GROUP_1;
/// What it looks over.
const LOW: Group = Group::GROUP_2;
/// The robot.
const ROBOT: Group = Group::GROUP_3;
/// The rotator turns so far to either side, radians, and so fast, radians a second.
const ROTATOR_REACH: f64 = 130.0 / 180.0 * core::f64::consts::PI;
const ROTATOR_RATE: f64 = 300.0 / 180.0 * core::f64::consts::PI;
/// The rotator's telemetry rounds to this, radians.
const ROTATOR_RESOLUTION: f64 = 0.25 / 180.0 * core::f64::consts::PI;
/// Physics steps between two pings.
const PING_STEPS: u64 = sonar::PERIOD.as_nanos() / STEP.as_nanos();

/// A robot in a world. It implements every device trait of the Carbot.
pub struct Simulation {
    physics: PhysicsWorld,
    body: RigidBodyHandle,
    collider: ColliderHandle,
    obstacles: Vec<Obstacle>,
    shapes: Vec<(Isometry, SharedShape)>,
    now: Instant,
    steps: u64,
    drive: Drive,
    odometer: Odometer,
    rotator: Servo,
    sonar: sonar::Sonar,
    /// The ping that is under way: when its echo arrives and what it will say.
    ping: Option<(Instant, Reading<Echo>)>,
    echo: Reading<Echo>,
    touched: bool,
    escape: bool,
    collisions: Collisions,
}

impl Simulation {
    /// The robot at its start, at time zero. `seed` decides on every noise and on how this robot
    /// differs from its twins.
    ///
    /// # Errors
    /// An obstacle without an area; [`World::parse`] lets none through.
    pub fn new(world: &World, seed: u64) -> Result<Self, WorldError> {
        let Built { physics, body, collider, shapes } = build(world)?;
        let mut differences = Noise::new(seed, Source::Build);
        Ok(Simulation {
            physics,
            body,
            collider,
            obstacles: world.obstacles.clone(),
            shapes,
            now: Instant::ZERO,
            steps: 0,
            drive: Drive::new(),
            odometer: Odometer::new(seed, &mut differences),
            rotator: Servo::new(ROTATOR_REACH, ROTATOR_RATE),
            sonar: sonar::Sonar::new(seed, &mut differences),
            ping: None,
            echo: Reading::invalid(Invalid::NotYet, Instant::ZERO),
            touched: false,
            escape: false,
            collisions: Collisions::default(),
        })
    }

    /// Lets time pass: every physics step up to and including `to`. Time never goes back.
    pub fn advance_to(&mut self, to: Instant) {
        while self.grid(self.steps + 1) <= to {
            self.steps += 1;
            self.step();
        }
        self.now = self.now.max(to);
        self.receive();
    }

    /// The instant up to which time has passed.
    pub fn now(&self) -> Instant {
        self.now
    }

    /// How many physics steps have been made.
    pub fn steps(&self) -> u64 {
        self.steps
    }

    /// Holds the escape button down.
    pub fn press_escape(&mut self) {
        self.escape = true;
    }

    /// Lets the escape button go.
    pub fn release_escape(&mut self) {
        self.escape = false;
    }

    /// What only a judge may know.
    pub fn truth(&self) -> Truth<'_> {
        Truth {
            position: self.position(),
            obstacles: &self.obstacles,
            shapes: &self.shapes,
            collisions: &self.collisions,
        }
    }

    fn grid(&self, step: u64) -> Instant {
        Instant::from_nanos(step.saturating_mul(STEP.as_nanos()))
    }

    fn position(&self) -> &Isometry {
        self.physics.bodies[self.body].position()
    }

    /// One physics step and everything that goes on its grid.
    fn step(&mut self) {
        let now = self.grid(self.steps);
        self.push(now);
        self.physics.step();
        self.odometer.step(self.drive.wheels(), DT);
        self.rotator.step(DT);
        self.now = now;
        self.feel(now);
        if self.steps.is_multiple_of(PING_STEPS) {
            self.receive();
            self.ping(now);
        }
    }

    /// Lets the wheels push the body.
    fn push(&mut self, now: Instant) {
        let body = &mut self.physics.bodies[self.body];
        let turn = *body.rotation();
        let velocity = turn.inverse_transform_vector(body.linvel());
        let twist = Twist {
            x: f64::from(velocity.x),
            y: f64::from(velocity.y),
            turn: f64::from(body.angvel()),
        };
        let push = self.drive.step(twist, now, DT);
        let force = turn.transform_vector(Vector::new(push.x as f32, push.y as f32));
        body.reset_forces(false);
        body.reset_torques(false);
        body.add_force(force, false);
        body.add_torque(push.turn as f32, false);
    }

    /// Sends a ping from where the sensor is now.
    fn ping(&mut self, now: Instant) {
        let (at, turn) = (self.position().translation, self.position().rotation);
        let bearing = self.rotator.position();
        let (sin, cos) = libm::sincos(bearing);
        let (re, im) = (f64::from(turn.re), f64::from(turn.im));
        let axis = (re * cos - im * sin, im * cos + re * sin);
        let origin = at + Vector::new(turn.re, turn.im) * SONAR_FORWARD as f32;
        let heard = InteractionGroups::new(ROBOT, HIGH, InteractionTestMode::And);
        let queries = self.physics.query_pipeline_with_filter(QueryFilter::new().groups(heard));
        let range = self.sonar.ping(axis, |(x, y)| {
            let direction = Vector::new(x as f32, y as f32);
            let ray = Ray::new(origin, direction);
            let (_, hit) = queries.cast_ray_and_get_normal(&ray, sonar::MAX as f32, true)?;
            let cos = f64::from(-hit.normal.dot(direction));
            Some(Hit { range: f64::from(hit.time_of_impact), cos })
        });
        let bearing = self.telemetry();
        let value = match range {
            Some(range) => sonar::beam().echo(range, bearing),
            None => Ok(Echo { distance: None, bearing }),
        };
        self.ping = Some((now + sonar::flight(range), Reading { time: now, value }));
    }

    /// Takes the echo that has arrived by now.
    fn receive(&mut self) {
        if let Some((_, echo)) = self.ping.take_if(|(arrival, _)| *arrival <= self.now) {
            self.echo = echo;
        }
    }

    /// The rotator's bearing as its telemetry tells it.
    fn telemetry(&self) -> Angle {
        let steps = libm::round(self.rotator.position() / ROTATOR_RESOLUTION);
        Angle::from_si(steps * ROTATOR_RESOLUTION)
    }
}

/// What the engine knows of a world.
struct Built {
    physics: PhysicsWorld,
    body: RigidBodyHandle,
    collider: ColliderHandle,
    shapes: Vec<(Isometry, SharedShape)>,
}

/// Builds a world and the robot in it for the engine.
fn build(world: &World) -> Result<Built, WorldError> {
    let mut physics = PhysicsWorld::new();
    physics.gravity = Vector::ZERO;
    physics.integration_parameters.dt = DT as f32;
    let mut shapes = Vec::with_capacity(world.obstacles.len());
    for (i, obstacle) in world.obstacles.iter().enumerate() {
        let (at, shape) = obstacle.outline.shape().ok_or_else(|| WorldError {
            place: None,
            message: format!("'{}' has no area", obstacle.name),
        })?;
        physics.insert_collider(fixed(obstacle, at, shape.clone(), i), None);
        shapes.push((at, shape));
    }
    let body = RigidBodyBuilder::dynamic().pose(isometry(world.start)).can_sleep(false);
    let (body, collider) = physics.insert(body, robot());
    // Rays meet nothing before the first update of the search tree.
    physics.detect_collisions(&(), &());
    Ok(Built { physics, body, collider, shapes })
}

/// An obstacle's collider; its index in the world is its user data.
fn fixed(obstacle: &Obstacle, at: Isometry, shape: SharedShape, i: usize) -> ColliderBuilder {
    let group = if obstacle.height >= SONAR_HEIGHT { HIGH } else { LOW };
    ColliderBuilder::new(shape)
        .position(at)
        .friction(0.3)
        .restitution(0.0)
        .collision_groups(InteractionGroups::new(group, ROBOT | HIGH, InteractionTestMode::And))
        .user_data(i as u128)
}

/// The robot's collider.
fn robot() -> ColliderBuilder {
    ColliderBuilder::cuboid(HALF_LENGTH as f32, HALF_WIDTH as f32)
        .mass(MASS as f32)
        .friction(0.3)
        .restitution(0.0)
        .collision_groups(InteractionGroups::new(ROBOT, HIGH | LOW, InteractionTestMode::And))
}
