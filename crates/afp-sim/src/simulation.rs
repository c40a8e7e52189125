//! The robot in its world, in virtual time.

mod bare;
mod bumper;
mod devices;
mod faults;
mod hand;
mod locate;
mod obstacles;
mod ping;
mod robot;
mod see;
mod sensors;
mod snapshot;
mod wall;

pub use bare::Bare;
pub use snapshot::{Snapshot, Sonar};

use crate::chassis::Chassis;
use crate::devices::sonar;
use crate::scene::Scene;
use crate::stage::{DT, STEP, Stage};
use crate::truth::{Pose, Truth};
use crate::vehicle::drive::Drive;
use crate::world::{Audible, Light, World, WorldError};
use afp_carbot::devices::Bump;
use afp_carbot::table::Fault;
use afp_carbot::trail::Trail;
use afp_core::Instant;
use afp_core::quantity::Frequency;
use afp_navigation::flow::{FlowJob, FlowSensor, LucasKanade};
use afp_platform::{VirtualClock, VirtualWorker};
use afp_session::Faults;
use locate::{Located, SimulatedLocator, SimulatedPlanner};
use rapier2d::math::Pose as Isometry;
use sensors::Sensors;
use std::sync::Arc;

/// Physics steps between two pings.
const PING_STEPS: u64 = sonar::PERIOD.as_nanos() / STEP.as_nanos();

/// How the flow of the pictures is computed.
type SimulatedFlow = FlowSensor<LucasKanade, VirtualWorker<FlowJob<LucasKanade>>>;

/// A robot in a world. It implements every device trait of the Carbot.
///
/// A clone has the same clock; a keyframe has its own.
#[derive(Clone)]
pub struct Simulation {
    stage: Stage,
    /// Where the robot started.
    start: Pose,
    now: Instant,
    steps: u64,
    drive: Drive,
    sensors: Sensors,
    /// Where the bumper was pressed last.
    bump: Option<Bump>,
    /// The way by which the robot came.
    trail: Trail,
    scene: Scene,
    lights: Vec<Light>,
    /// Made for whoever asks for the flow first.
    flow: Option<Box<SimulatedFlow>>,
    /// What the range sensor should hear; all simulations of a world share it.
    audible: Audible,
    /// Made for whoever asks first where the robot is.
    locator: Option<Box<SimulatedLocator>>,
    /// How far off it was.
    located: Located,
    /// Made for whoever asks first for a way.
    planner: Option<Box<SimulatedPlanner>>,
    /// Whether the lamp is on, and what sounds.
    shown: (bool, Option<Frequency>),
    seed: u64,
    /// After an emergency stop.
    stopped: bool,
    /// What was injected, for those who drive it by hand.
    faults: Faults<Fault>,
    clock: VirtualClock,
    /// The edge of the map, see [`World::map`].
    map: Vec<[f64; 2]>,
    /// When the robot first was beyond it.
    left_map: Option<Instant>,
    /// How many things somebody has dropped.
    dropped: usize,
}

impl Simulation {
    /// The robot at its start, at time zero. `seed` decides on every noise and on how this robot
    /// differs from its twins.
    ///
    /// # Errors
    /// An obstacle without an area; [`World::parse`] lets none through.
    pub fn new(world: &World, seed: u64) -> Result<Self, WorldError> {
        let stage = Stage::new(world, Chassis::CARBOT)?;
        Ok(Simulation {
            stage,
            start: world.start,
            now: Instant::ZERO,
            steps: 0,
            drive: Drive::new(),
            sensors: Sensors::new(world, seed),
            bump: None,
            trail: Trail::new(),
            scene: Scene::new(world),
            lights: world.lights.clone(),
            flow: None,
            locator: None,
            located: Located::default(),
            planner: None,
            audible: world.audible.clone(),
            shown: (false, None),
            seed,
            stopped: false,
            faults: Faults::default(),
            clock: VirtualClock::default(),
            map: world.map.clone(),
            left_map: None,
            dropped: 0,
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
    pub fn all_bodies_enabled(&self) -> bool {
        self.stage.all_enabled()
    }

    /// Holds the escape button down.
    pub fn press_escape(&mut self) {
        self.sensors.escape = true;
    }

    /// Lets the escape button go.
    pub fn release_escape(&mut self) {
        self.sensors.escape = false;
    }

    /// Holds the bumper in, as if something stood there.
    pub fn press_bumper(&mut self) {
        self.sensors.held = true;
    }

    /// Lets the bumper go.
    pub fn release_bumper(&mut self) {
        self.sensors.held = false;
    }

    /// What only a judge may know.
    pub fn truth(&self) -> Truth<'_> {
        let body = &self.stage.physics.bodies[self.stage.body];
        Truth {
            now: self.now,
            motion: (f64::from(body.linvel().length()), f64::from(body.angvel())),
            asked: self.drive.asked(),
            stage: &self.stage,
            left_map: self.left_map,
            pictures: [
                self.sensors.exposed_before.as_ref(),
                self.sensors.exposure.value.as_ref().ok(),
            ]
            .map(|picture| picture.map(Arc::as_ref)),
        }
    }

    fn grid(&self, step: u64) -> Instant {
        Instant::ZERO + STEP * step
    }

    fn position(&self) -> &Isometry {
        self.stage.position()
    }

    /// One physics step and everything that goes on its grid.
    fn step(&mut self) {
        let now = self.grid(self.steps);
        self.push(now);
        let Simulation { stage, scene, .. } = self;
        stage.step_noting(now, |n, at, direction| scene.place(n, at, direction));
        self.sensors.step(self.drive.wheels());
        self.now = now;
        self.feel(now);
        self.note_motion(now);
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
        let push = self.drive.step(self.stage.twist(), now, self.sensors.battery.speed(), DT);
        self.stage.push(push);
    }
}
