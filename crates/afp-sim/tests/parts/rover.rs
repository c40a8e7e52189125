//! The rover: round, two wheels, a bumper and a range sensor in front.

use afp::load::Registry;
use afp_core::devices::{DeviceRow, Devices as _};
use afp_core::quantity::Length;
use afp_core::{
    Actor, Duration, Environment, Events, Fault, Instant, Platform, Poll, Reading, Reason,
    Supervisor,
};
use afp_dsl::Toolboxes;
use afp_dsl::compile;
use afp_dsl::files::Texts;
use afp_dsl::graph::Graph;
use afp_platform::{Line, Noise, VirtualClock};
use afp_session::frames::{BODY, WORLD};
use afp_session::{
    Active, Drawing, Figure, FigureValue, Pose2, Refused, Robot, SampleRef, Samples, Simulated,
    Span, Transform, WorldError,
};
use afp_sim::parts::{
    Body, Chassis, Footprint, OwnTables, RangeModel, RangeSensor, STEP, Stage, Switch, TwoWheels,
    WheelModel, WorldOf,
};
use afp_syntax::source::Source;
use serde::Deserialize;

pub mod templates {
    afp_macros::toolbox!("tests/parts/rover.afp", robot: super::Wheels + super::Senses);
}

use templates::devices::{Control, Devices, Fault as Broken};
use templates::{check_bumper, check_range, roam, signal};

pub const DEVICES: &[DeviceRow] = Devices::TABLE;

const RADIUS: f64 = 0.15;
const DT: f64 = 0.005;
/// The number of steps between two pings.
const PING: u64 = 10;

const WHEELS: WheelModel = WheelModel {
    half_track: 0.12,
    castor: 0.1,
    fastest: 0.3,
    lag: 0.08,
    force: 4.0,
    friction: 0.8,
};

const RANGER: RangeModel = RangeModel {
    opening: 0.4,
    most: 3.0,
    threshold: 0.02,
    edge: 0.3,
    noise: [0.003, 0.003],
    calibration: 0.003,
    resolution: 0.01,
    lost: [0.01, 0.4],
};

#[derive(Clone, Debug)]
pub struct Round;

impl Body for Round {
    const CHASSIS: Chassis =
        Chassis { shape: Footprint::Round(RADIUS), mass: 2.0, height: 0.1, ranging_height: 0.06 };
    const DEFAULT: &'static str = super::ROOM;
    type Own = Docks;
}

/// Charging places, which only the rover has.
#[derive(Clone, Debug, Deserialize)]
pub struct Docks {
    #[serde(default, rename = "dock")]
    pub docks: Vec<Dock>,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Dock {
    pub at_m: [f64; 2],
}

impl OwnTables for Docks {
    const KEYS: &'static [&'static str] = &["dock"];

    fn wrong(&self) -> Option<String> {
        (self.docks.len() > 1).then(|| format!("{} docks; the rover knows one", self.docks.len()))
    }

    fn draw(&self, drawing: &mut Drawing) {
        drawing.lights.extend(self.docks.iter().map(|dock| dock.at_m));
    }
}

pub trait Wheels {
    fn drive(&mut self, speed: f64, turn: f64);
}

pub trait Senses {
    fn bumper(&self) -> Reading<bool>;
    fn ranger(&self) -> Reading<Option<Length>>;
}

pub struct Rover {
    stage: Stage,
    wheels: TwoWheels,
    ranger: RangeSensor,
    switch: Switch,
    now: Instant,
    steps: u64,
    clock: VirtualClock,
    heard: Option<f64>,
    held: bool,
    stopped: bool,
    bumper_line: Line<bool>,
    ranger_line: Line<Option<Length>>,
}

impl Rover {
    pub fn stage(&self) -> &Stage {
        &self.stage
    }

    pub fn pose(&self) -> Pose2 {
        self.stage.pose()
    }

    pub fn way(&self) -> [f64; 2] {
        self.wheels.counted()
    }

    pub fn range(&self) -> Option<f64> {
        self.heard
    }

    pub fn touched(&self) -> bool {
        self.switch.says() || self.held
    }

    pub fn set_wheels(&mut self, grip: f64, blocked: [bool; 2]) {
        self.wheels.set_grip(grip);
        self.wheels.block(blocked);
    }

    fn step(&mut self) {
        self.steps += 1;
        let now = Instant::from_nanos(self.steps * STEP.as_nanos());
        let push = self.wheels.step(self.stage.twist(), DT);
        self.stage.push(push);
        self.stage.step(now);
        self.now = now;
        let mut touched = false;
        self.stage.feel(now, |touch| touched |= touch.at[0] > 0.0);
        self.switch.step(touched);
        if self.steps.is_multiple_of(PING) {
            self.heard = self.ranger.ping(&self.stage, RADIUS, 0.0);
        }
        let (bumper, ranger) = self.raw();
        self.bumper_line.note(bumper, now);
        self.ranger_line.note(ranger, now);
    }

    fn raw(&self) -> (Reading<bool>, Reading<Option<Length>>) {
        let heard = self.heard.map(Length::from_si);
        (Reading::valid(self.touched(), self.now), Reading::valid(heard, self.now))
    }
}

impl Environment for Rover {
    fn stop(&mut self, _: Instant) {
        self.drive(0.0, 0.0);
    }

    fn emergency_stop(&mut self) {
        self.drive(0.0, 0.0);
        self.stopped = true;
    }
}

impl Wheels for Rover {
    fn drive(&mut self, speed: f64, turn: f64) {
        if !self.stopped {
            self.wheels.ask(speed, turn);
        }
    }
}

impl Senses for Rover {
    fn bumper(&self) -> Reading<bool> {
        self.bumper_line.sense(self.raw().0, self.now, &self.clock)
    }

    fn ranger(&self) -> Reading<Option<Length>> {
        self.ranger_line.sense(self.raw().1, self.now, &self.clock)
    }
}

impl Platform for Rover {
    type Clock = VirtualClock;

    fn clock(&self) -> VirtualClock {
        self.clock.clone()
    }

    fn now(&self) -> Instant {
        self.now
    }

    fn advance(&mut self, to: Instant) {
        while Instant::from_nanos((self.steps + 1) * STEP.as_nanos()) <= to {
            self.step();
        }
        self.now = self.now.max(to);
    }

    fn ready(&self) -> Instant {
        self.clock.free()
    }
}

impl Robot for Rover {
    type Devices = Devices;

    fn press(&mut self, _: Control, held: bool) -> Result<(), Refused> {
        self.held = held;
        Ok(())
    }

    fn set_faults(&mut self, active: &Active<'_, Broken>) -> Result<(), Refused> {
        let blocked = active.find(Broken::wheels_blocked).is_some();
        self.set_wheels(active.find(Broken::wheels_slip).unwrap_or(1.0), [blocked; 2]);
        let (bumper, ranger) = self.raw();
        self.bumper_line.set(active.find(Broken::bumper), bumper);
        self.ranger_line.set(active.find(Broken::ranger), ranger);
        Ok(())
    }

    fn sample(&self, to: &mut Samples<'_, '_>) {
        let pose = self.pose();
        let pose = Transform { parent: WORLD, child: BODY, pose, height: 0.0 };
        to.put(signal::POSE, SampleRef::Pose(pose));
        to.put(signal::BUMPER_FRONT, SampleRef::Bool(self.touched()));
        let touching = self.stage.touching(self.now).last();
        let name = touching.and_then(|it| self.stage.obstacles().get(it.obstacle));
        to.put(signal::CONTACT, SampleRef::Text(name.map_or("", |it| &it.name)));
        if let Some(heard) = self.heard {
            to.put(signal::RANGER_DISTANCE, SampleRef::Float(heard));
        }
    }

    fn figures(&self) -> Vec<Figure> {
        let span = |it: &afp_sim::parts::Collision| Span {
            name: self.stage.obstacles()[it.obstacle].name.clone(),
            begin: it.begin,
            end: it.end,
        };
        let spans = self.stage.collisions().iter().map(span).collect();
        let value = FigureValue::Spans { of: "obstacle", spans };
        vec![Figure { name: "contacts", value, text: String::new() }]
    }

    fn keyframe(&self) -> Option<Self> {
        Some(Rover {
            stage: self.stage.clone(),
            wheels: self.wheels.clone(),
            ranger: self.ranger.clone(),
            switch: self.switch.clone(),
            now: self.now,
            steps: self.steps,
            clock: self.clock.split(),
            heard: self.heard,
            held: self.held,
            stopped: self.stopped,
            bumper_line: self.bumper_line.clone(),
            ranger_line: self.ranger_line.clone(),
        })
    }
}

impl Simulated for Rover {
    type World = WorldOf<Round>;
    type Error = WorldError;

    fn new(world: &WorldOf<Round>, seed: u64) -> Result<Self, WorldError> {
        let stage = Stage::new(&world.world, Round::CHASSIS)?;
        let (noise, mut build) = (Noise::new(seed, "ranger"), Noise::new(seed, "build"));
        Ok(Rover {
            stage,
            wheels: TwoWheels::new(WHEELS, &Round::CHASSIS),
            ranger: RangeSensor::new(RANGER, noise, &mut build),
            switch: Switch::new(Noise::new(seed, "bumper")),
            now: Instant::ZERO,
            steps: 0,
            clock: VirtualClock::default(),
            heard: None,
            held: false,
            stopped: false,
            bumper_line: Line::default(),
            ranger_line: Line::default(),
        })
    }
}

const BLIND: Fault = Fault::new(&Reason { code: "blind", text: "a sensor does not answer" });
/// Older readings are ignored.
const FRESH: Duration = Duration::from_millis(200);

#[derive(Clone)]
pub struct Roam(roam::Inputs);

impl<E: Wheels + ?Sized> Actor<templates::Roam, E> for Roam {
    fn start(inputs: roam::Inputs, _: &mut E, _: Instant) -> Result<Self, Fault> {
        Ok(Roam(inputs))
    }

    fn poll(&mut self, _: roam::Live, env: &mut E, _: Instant) -> Result<Poll<roam::State>, Fault> {
        env.drive(self.0.speed.si(), self.0.turn.si());
        Ok(Poll::Pending)
    }

    fn interrupt(&mut self, env: &mut E, _: Instant) -> Result<(), Fault> {
        env.drive(0.0, 0.0);
        Ok(())
    }
}

#[derive(Clone)]
pub struct CheckBumper;

impl<E: Senses + ?Sized> Supervisor<templates::CheckBumper, E> for CheckBumper {
    fn start(_: check_bumper::Inputs, _: &mut E, _: Instant) -> Result<Self, Fault> {
        Ok(CheckBumper)
    }

    fn poll(
        &mut self,
        _: check_bumper::Live,
        _: Events,
        env: &mut E,
        now: Instant,
    ) -> Result<Option<check_bumper::Event>, Fault> {
        let pressed = env.bumper().fresh(now, FRESH).ok_or(BLIND)?;
        Ok(pressed.then_some(check_bumper::Event::Pressed))
    }
}

#[derive(Clone)]
pub struct CheckRange;

impl<E: Senses + ?Sized> Supervisor<templates::CheckRange, E> for CheckRange {
    fn start(_: check_range::Inputs, _: &mut E, _: Instant) -> Result<Self, Fault> {
        Ok(CheckRange)
    }

    fn poll(
        &mut self,
        live: check_range::Live,
        _: Events,
        env: &mut E,
        now: Instant,
    ) -> Result<Option<check_range::Event>, Fault> {
        let heard = env.ranger().fresh(now, FRESH).ok_or(BLIND)?;
        let near = heard.is_some_and(|distance| distance < live.limit);
        Ok(near.then_some(check_range::Event::Near))
    }
}

pub fn register(registry: &mut Registry<Rover>) {
    afp_std::templates::register(registry);
    templates::register(registry);
}

pub fn graph(plan: &str) -> Graph {
    let mut toolboxes: Toolboxes = afp_toolboxes::sources().collect();
    toolboxes.add(Source::new("rover.afp", templates::SOURCE), "rover");
    let compiled = compile(&Source::new("plan.afp", plan), &toolboxes, &Texts::default());
    compiled.graph.clone().unwrap_or_else(|| panic!("{}", compiled.render(false)))
}
