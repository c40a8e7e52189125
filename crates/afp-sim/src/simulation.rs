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

use crate::chassis::Measures;
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

/// The number of physics steps between two pings.
const PING_STEPS: u64 = sonar::PERIOD.as_nanos() / STEP.as_nanos();

/// The optical flow sensor in virtual time.
type SimulatedFlow = FlowSensor<LucasKanade, VirtualWorker<FlowJob<LucasKanade>>>;

/// A robot in a world. It implements every device trait of the Carbot.
///
/// A clone shares the clock; a keyframe has its own clock.
#[derive(Clone)]
pub struct Simulation {
    stage: Stage,
    measures: Measures,
    start: Pose,
    now: Instant,
    steps: u64,
    drive: Drive,
    sensors: Sensors,
    /// The place of the bumper's last press.
    bump: Option<Bump>,
    /// The robot's recent path.
    trail: Trail,
    scene: Scene,
    lights: Vec<Light>,
    flow: Option<Box<SimulatedFlow>>,
    /// The expected readings of the range sensor, shared by all simulations of a world.
    audible: Audible,
    locator: Option<Box<SimulatedLocator>>,
    /// The errors of the localisation.
    located: Located,
    planner: Option<Box<SimulatedPlanner>>,
    /// The lamp and the tone.
    shown: (bool, Option<Frequency>),
    seed: u64,
    stopped: bool,
    /// The injected faults, for manual driving.
    faults: Faults<Fault>,
    /// Whether the controller of the drive has restarted.
    restarted: bool,
    clock: VirtualClock,
    /// The edge of the map, see [`World::map`].
    map: Vec<[f64; 2]>,
    /// The time when the robot first left the map.
    left_map: Option<Instant>,
    /// The number of dropped objects.
    dropped: usize,
}

impl Simulation {
    /// The robot at its start, at time zero. `seed` determines every noise and the robot's
    /// calibration.
    ///
    /// # Errors
    /// An obstacle without an area; [`World::parse`] rejects it.
    pub fn new(world: &World, seed: u64) -> Result<Self, WorldError> {
        let measures = world.measures;
        let stage = Stage::new(world, measures.chassis())?;
        Ok(Simulation {
            stage,
            start: world.start,
            now: Instant::ZERO,
            steps: 0,
            drive: Drive::new(&measures),
            measures,
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
            restarted: false,
            clock: VirtualClock::default(),
            map: world.map.clone(),
            left_map: None,
            dropped: 0,
        })
    }

    /// Runs every physics step up to and including `to`. Time never goes back.
    pub fn advance_to(&mut self, to: Instant) {
        while self.faults.next_change() <= to {
            self.pass(self.faults.next_change());
            self.break_and_mend();
        }
        self.pass(to);
    }

    /// Runs steps in which no fault begins or ends.
    fn pass(&mut self, to: Instant) {
        while self.grid(self.steps + 1) <= to {
            self.steps += 1;
            self.step();
        }
        self.now = self.now.max(to);
        self.receive();
        self.note();
    }

    /// The clock for timed polls. Within a step it only advances by the cost of slow devices. A
    /// driver with slow devices makes no step before [`VirtualClock::free`].
    pub fn clock(&self) -> VirtualClock {
        self.clock.clone()
    }

    /// The current instant.
    pub fn now(&self) -> Instant {
        self.now
    }

    /// The number of physics steps so far.
    pub fn steps(&self) -> u64 {
        self.steps
    }

    /// Whether all bodies are still in the engine: it disables a body whose pose or velocity is not
    /// finite.
    pub fn all_bodies_enabled(&self) -> bool {
        self.stage.all_enabled()
    }

    /// Holds the escape button down.
    pub fn press_escape(&mut self) {
        self.sensors.escape = true;
    }

    /// Releases the escape button.
    pub fn release_escape(&mut self) {
        self.sensors.escape = false;
    }

    /// Holds the bumper pressed, as if it touched an obstacle.
    pub fn press_bumper(&mut self) {
        self.sensors.held = true;
    }

    /// Releases the bumper.
    pub fn release_bumper(&mut self) {
        self.sensors.held = false;
    }

    /// The ground truth, for judges.
    pub fn truth(&self) -> Truth<'_> {
        let body = &self.stage.physics.bodies[self.stage.body];
        Truth {
            now: self.now,
            motion: (f64::from(body.linvel().length()), f64::from(body.angvel())),
            asked: self.drive.asked(),
            stage: &self.stage,
            measures: self.measures,
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

    /// Makes one physics step, and everything on its grid.
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

    /// Applies the wheels' push to the body.
    fn push(&mut self, now: Instant) {
        let push = self.drive.step(self.stage.twist(), now, self.sensors.battery.speed(), DT);
        self.stage.push(push);
    }
}
