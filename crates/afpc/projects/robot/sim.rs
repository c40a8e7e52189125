//! The simulated robot: its motion, its sensors and its faults.

use afp::core::Platform;
use afp::quantity::{Angle, AngularSpeed, Length, Speed};
use afp::{Duration, Environment, Instant, Reading};
use afp_session::frames;
use afp_platform::{Grid, Line, Noise, VirtualClock};
use afp_session::{
    Active, Drawing, Pose2, Refused, Robot, SampleRef, Samples, Shape, Simulated, Transform, World,
    WorldError,
};

use crate::templates::devices::{Control, Devices, Fault};
use crate::templates::signal;
use crate::{Bumper, Wheels};

/// The simulation step.
const TICK: Duration = Duration::from_millis(5);
/// Radius and height of the body, metres.
const BODY: [f64; 2] = [0.15, 0.1];
/// The time constant of the wheels, in seconds.
const LAG: f64 = 0.08;
/// The relative error of the counters, as a standard deviation.
const COUNT_ERROR: f64 = 0.02;

/// The robot's surroundings: a floor drawn with letters.
#[derive(Clone, Debug)]
pub struct Floor(Grid);

/// The robot on a floor.
#[derive(Clone)]
pub struct {{Name}} {
    floor: Grid,
    ticks: u64,
    now: Instant,
    clock: VirtualClock,
    pose: Pose2,
    /// Forward speed and turn rate: commanded, actual, and integrated by the counters.
    asked: [f64; 2],
    moving: [f64; 2],
    counted: [f64; 2],
    counters: Noise,
    /// Whether the robot has stopped permanently.
    stopped: bool,
    grip: f64,
    touched: bool,
    held: bool,
    bumper: Line<bool>,
}

impl {{Name}} {
    fn tick(&mut self) {
        let seconds = TICK.as_secs_f64();
        for part in 0..2 {
            let asked = if self.stopped { 0.0 } else { self.asked[part] };
            self.moving[part] += (asked - self.moving[part]) * seconds / LAG;
            let error = 1.0 + COUNT_ERROR * self.counters.normal();
            self.counted[part] += self.moving[part] * seconds * error;
        }
        let [ahead, turn] = self.moving.map(|speed| speed * seconds * self.grip);
        self.pose.heading += turn;
        let (sin, cos) = libm::sincos(self.pose.heading);
        self.pose.x += ahead * cos;
        self.pose.y += ahead * sin;
        let in_front = |towards: [f64; 2]| towards[0] * cos + towards[1] * sin > 0.3;
        let mut contacts = self.floor.contacts(self.pose.x, self.pose.y, BODY[0] + 0.002);
        self.touched = contacts.any(|contact| in_front(contact.towards));
        drop(contacts);
        self.floor.push_out(&mut self.pose, BODY[0]);
        self.bumper.note(self.raw_bumper(), self.now);
    }

    /// The raw reading of the bumper.
    fn raw_bumper(&self) -> Reading<bool> {
        Reading::valid(self.touched || self.held, self.now)
    }
}

impl Environment for {{Name}} {
    fn stop(&mut self, _: Instant) {
        self.halt();
    }

    fn emergency_stop(&mut self) {
        self.stopped = true;
    }
}

impl Wheels for {{Name}} {
    fn drive(&mut self, speed: Speed, turn: AngularSpeed) {
        let asked = [speed.si(), turn.si()];
        // The motors ignore a command that is not a number.
        self.asked = if asked.iter().all(|number| number.is_finite()) { asked } else { [0.0; 2] };
    }

    fn counted(&self) -> (Length, Angle) {
        (Length::from_si(self.counted[0]), Angle::from_si(self.counted[1]))
    }
}

impl Bumper for {{Name}} {
    fn pressed(&self) -> Reading<bool> {
        self.bumper.sense(self.raw_bumper(), self.now, &self.clock)
    }
}

impl Platform for {{Name}} {
    type Clock = VirtualClock;

    fn clock(&self) -> VirtualClock {
        self.clock.clone()
    }

    fn now(&self) -> Instant {
        self.now
    }

    fn advance(&mut self, to: Instant) {
        let at = |ticks: u64| Instant::ZERO + TICK * ticks;
        while at(self.ticks + 1) <= to {
            self.ticks += 1;
            self.now = at(self.ticks);
            self.tick();
        }
        self.now = self.now.max(to);
    }

    fn ready(&self) -> Instant {
        self.clock.free()
    }
}

impl Robot for {{Name}} {
    type Devices = Devices;

    fn press(&mut self, control: Control, held: bool) -> Result<(), Refused> {
        match control {
            Control::BumperFront => self.held = held,
        }
        Ok(())
    }

    fn set_faults(&mut self, active: &Active<'_, Fault>) -> Result<(), Refused> {
        self.grip = active.find(Fault::wheels_slip).unwrap_or(1.0);
        let raw = self.raw_bumper();
        self.bumper.set(active.find(Fault::bumper), raw);
        Ok(())
    }

    fn sample(&self, to: &mut Samples<'_, '_>) {
        to.put(signal::BUMPER_PRESSED, SampleRef::Bool(self.touched || self.held));
        let pose = self.pose;
        let pose = Transform { parent: frames::WORLD, child: frames::BODY, pose, height: 0.0 };
        to.put(signal::POSE, SampleRef::Pose(pose));
    }

    fn keyframe(&self) -> Option<Self> {
        Some({{Name}} { clock: self.clock.split(), ..self.clone() })
    }
}

impl Simulated for {{Name}} {
    type World = Floor;
    type Error = WorldError;

    fn new(floor: &Floor, seed: u64) -> Result<Self, WorldError> {
        Ok({{Name}} {
            pose: floor.0.start,
            floor: floor.0.clone(),
            ticks: 0,
            now: Instant::ZERO,
            clock: VirtualClock::default(),
            asked: [0.0; 2],
            moving: [0.0; 2],
            counted: [0.0; 2],
            counters: Noise::new(seed, "counters"),
            stopped: false,
            grip: 1.0,
            touched: false,
            held: false,
            bumper: Line::default(),
        })
    }
}

impl World for Floor {
    const DEFAULT: &'static str = include_str!("../floors/room.txt");

    fn read(text: &str) -> Result<Self, WorldError> {
        Grid::read(text, "").map(Floor)
    }

    fn made_up(seed: u64) -> Option<String> {
        Some(Grid::made_up(seed, 20, 12, &[('#', 6)]))
    }

    fn name(&self) -> &str {
        &self.0.name
    }

    fn started_at(&self, start: Pose2) -> Result<Self, WorldError> {
        self.0.started_at(start, BODY[0]).map(Floor)
    }

    fn scene(&self) -> Vec<Shape> {
        self.0.scene(BODY[0], BODY[1])
    }

    fn drawing(&self) -> Drawing {
        self.0.drawing(BODY[0], &[])
    }
}
