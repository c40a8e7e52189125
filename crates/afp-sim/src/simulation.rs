//! The robot in its world, in virtual time.

mod bare;
mod build;
mod bumper;
mod devices;
mod faults;
mod hand;
mod keyframe;
mod locate;
mod movers;
mod ping;
mod robot;
mod see;
mod snapshot;

pub use bare::Bare;
pub use snapshot::{Snapshot, Sonar};

use crate::devices::battery::Battery;
use crate::devices::bumper::Switch;
use crate::devices::camera::Exposure;
use crate::devices::color::ColorSensor;
use crate::devices::infrared::Infrared;
use crate::devices::odometer::Odometer;
use crate::devices::rotator::Rotator;
use crate::devices::sonar;
use crate::noise::Source;
use crate::scene::Scene;
use crate::truth::{Collisions, Pose, Truth};
use crate::vehicle::Twist;
use crate::vehicle::drive::Drive;
use crate::world::{Light, Obstacle, World, WorldError};
use afp_carbot::devices::{Color, Echo, Glow, Invalid, Reading};
use afp_carbot::table::Fault;
use afp_core::quantity::Frequency;
use afp_core::{Duration, Instant};
use afp_flow::{FlowJob, FlowSensor, LucasKanade};
use afp_session::Faults;
use afp_session::parts::VirtualClock;
use afp_worker::VirtualWorker;
use build::{Built, build};
use faults::Lines;
use locate::{Located, SimulatedLocator, SimulatedPlanner};
use movers::Mover;
use rapier2d::math::{Pose as Isometry, Vector};
use rapier2d::parry::shape::SharedShape;
use rapier2d::prelude::{ColliderHandle, PhysicsWorld, RigidBodyHandle};
use std::sync::Arc;

/// The physics' own grid.
pub const STEP: Duration = Duration::from_millis(5);

/// The step in seconds.
const DT: f64 = 0.005;
/// Physics steps between two pings.
const PING_STEPS: u64 = sonar::PERIOD.as_nanos() / STEP.as_nanos();

/// How the flow of the pictures is computed.
type SimulatedFlow = FlowSensor<LucasKanade, VirtualWorker<FlowJob<LucasKanade>>>;

/// A robot in a world. It implements every device trait of the Carbot.
pub struct Simulation {
    physics: PhysicsWorld,
    body: RigidBodyHandle,
    collider: ColliderHandle,
    obstacles: Vec<Obstacle>,
    shapes: Vec<(Isometry, SharedShape)>,
    /// Where the robot started.
    start: Pose,
    now: Instant,
    steps: u64,
    drive: Drive,
    odometer: Odometer,
    rotator: Rotator,
    sonar: sonar::Sonar,
    /// The ping that is under way: when its echo arrives and what it will say.
    ping: Option<(Instant, Reading<Echo>)>,
    echo: Reading<Echo>,
    switch: Switch,
    battery: Battery,
    scene: Scene,
    lights: Vec<Light>,
    movers: Vec<Mover>,
    infrared: Infrared,
    glow: Reading<Option<Glow>>,
    color_sensor: ColorSensor,
    color: Reading<Color>,
    exposure: Reading<Arc<Exposure>>,
    /// The one before, for the truth about how pictures move.
    exposed_before: Option<Arc<Exposure>>,
    /// Made for whoever asks for the flow first.
    flow: Option<Box<SimulatedFlow>>,
    /// Made for whoever asks first where the robot is.
    locator: Option<Box<SimulatedLocator>>,
    /// How far off it was.
    located: Located,
    /// Made for whoever asks first for a way.
    planner: Option<Box<SimulatedPlanner>>,
    /// Whether the lamp is on, and what sounds.
    shown: (bool, Option<Frequency>),
    seed: u64,
    /// Whether somebody holds the bumper in.
    held: bool,
    escape: bool,
    /// After an emergency stop.
    stopped: bool,
    /// What was injected, for those who drive it by hand.
    faults: Faults<Fault>,
    lines: Lines,
    /// Whether a line delays.
    delayed: bool,
    clock: VirtualClock,
    collisions: Collisions,
    /// The edge of the map, see [`World::map`].
    map: Vec<[f64; 2]>,
    /// When the robot first was beyond it.
    left_map: Option<Instant>,
}

impl Simulation {
    /// The robot at its start, at time zero. `seed` decides on every noise and on how this robot
    /// differs from its twins.
    ///
    /// # Errors
    /// An obstacle without an area; [`World::parse`] lets none through.
    pub fn new(world: &World, seed: u64) -> Result<Self, WorldError> {
        let Built { physics, body, collider, shapes, movers } = build(world)?;
        let mut differences = Source::Build.of(seed);
        Ok(Simulation {
            physics,
            body,
            collider,
            obstacles: world.obstacles.clone(),
            shapes,
            start: world.start,
            now: Instant::ZERO,
            steps: 0,
            drive: Drive::new(),
            odometer: Odometer::new(seed, &mut differences),
            rotator: Rotator::new(),
            sonar: sonar::Sonar::new(seed, &mut differences),
            ping: None,
            echo: Reading::invalid(Invalid::NotYet, Instant::ZERO),
            switch: Switch::new(seed),
            battery: Battery::new(world.charge),
            scene: Scene::new(world),
            lights: world.lights.clone(),
            movers,
            infrared: Infrared::new(seed),
            glow: Reading::invalid(Invalid::NotYet, Instant::ZERO),
            color_sensor: ColorSensor::new(seed),
            color: Reading::invalid(Invalid::NotYet, Instant::ZERO),
            exposure: Reading { time: Instant::ZERO, value: Err(Invalid::NotYet) },
            exposed_before: None,
            flow: None,
            locator: None,
            located: Located::default(),
            planner: None,
            shown: (false, None),
            seed,
            held: false,
            escape: false,
            stopped: false,
            faults: Faults::default(),
            lines: Lines::default(),
            delayed: false,
            clock: VirtualClock::default(),
            collisions: Collisions::default(),
            map: world.map.clone(),
            left_map: None,
        })
    }

    /// Lets time pass: every physics step up to and including `to`. Time never goes back.
    pub fn advance_to(&mut self, to: Instant) {
        while self.faults.next_change() <= to {
            self.pass(self.faults.next_change());
            self.break_and_mend();
        }
        self.pass(to);
    }

    /// Lets time pass in which no fault begins or ends.
    fn pass(&mut self, to: Instant) {
        while self.grid(self.steps + 1) <= to {
            self.steps += 1;
            self.step();
        }
        self.now = self.now.max(to);
        self.receive();
        self.note();
    }

    /// The clock that times polls: it stands still within a step but for what slow devices cost.
    /// A driver that knows slow devices makes no step before [`VirtualClock::free`].
    pub fn clock(&self) -> VirtualClock {
        self.clock.clone()
    }

    /// The instant up to which time has passed.
    pub fn now(&self) -> Instant {
        self.now
    }

    /// How many physics steps have been made.
    pub fn steps(&self) -> u64 {
        self.steps
    }

    /// Whether the engine has taken no body out for being nowhere: where a pose or a velocity is not
    /// finite, it lets the body take no more part.
    pub fn sound(&self) -> bool {
        let mut bodies = self.physics.bodies.iter();
        let mut colliders = self.physics.colliders.iter();
        bodies.all(|(_, body)| body.is_enabled())
            && colliders.all(|(_, collider)| collider.is_enabled())
    }

    /// Holds the escape button down.
    pub fn press_escape(&mut self) {
        self.escape = true;
    }

    /// Lets the escape button go.
    pub fn release_escape(&mut self) {
        self.escape = false;
    }

    /// Holds the bumper in, as if something stood there.
    pub fn press_bumper(&mut self) {
        self.held = true;
    }

    /// Lets the bumper go.
    pub fn release_bumper(&mut self) {
        self.held = false;
    }

    /// What only a judge may know.
    pub fn truth(&self) -> Truth<'_> {
        let body = &self.physics.bodies[self.body];
        Truth {
            now: self.now,
            motion: (f64::from(body.linvel().length()), f64::from(body.angvel())),
            asked: self.drive.asked(),
            position: self.position(),
            obstacles: &self.obstacles,
            shapes: &self.shapes,
            collisions: &self.collisions,
            left_map: self.left_map,
            pictures: [self.exposed_before.as_ref(), self.exposure.value.as_ref().ok()]
                .map(|picture| picture.map(Arc::as_ref)),
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
        self.move_obstacles(now);
        self.physics.step();
        self.note_obstacles();
        self.odometer.step(self.drive.wheels(), DT);
        self.rotator.step(DT);
        let [left, right] = self.drive.wheels();
        self.battery.step([left.speed(), right.speed()], DT);
        self.now = now;
        self.feel(now);
        self.look_for_edge(now);
        if self.steps.is_multiple_of(PING_STEPS) {
            self.receive();
            self.locate();
            self.ping(now);
        }
        self.see(now);
        self.note();
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
        let push = self.drive.step(twist, now, self.battery.speed(), DT);
        let force = turn.transform_vector(Vector::new(push.x as f32, push.y as f32));
        body.reset_forces(false);
        body.reset_torques(false);
        body.add_force(force, false);
        body.add_torque(push.turn as f32, false);
    }
}
