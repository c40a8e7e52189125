//! The simulated robot: motion, sensors and faults.

use std::f64::consts::TAU;

use afp::core::{Invalid, Platform};
use afp::quantity::{Angle, AngularSpeed, Length, Speed};
use afp::{Duration, Environment, Instant, Reading};
use afp_platform::{Grid, Line, Noise, VirtualClock};
use afp_session::frames::{BODY, WORLD};
use afp_session::{
    Active, Figure, FigureValue, Pose2, Refused, Robot, SampleRef, Samples, Simulated, Transform,
    WorldError,
};

use crate::room::{DIRT, DROP, RADIUS, Room};
use crate::templates::devices::{Control, Devices, Fault};
use crate::templates::signal;
use crate::{Nozzle, Senses, Way, Wheels};

/// The step of the simulation.
const TICK: Duration = Duration::from_millis(5);
const DT: f64 = 0.005;
/// The time constant of the wheels, in seconds.
const LAG: f64 = 0.08;
/// The limits of the motors: m/s, rad/s.
const FASTEST: [f64; 2] = [0.3, 2.1];
/// The relative error of the counters, as a standard deviation.
const COUNT_ERROR: f64 = 0.02;
/// The share of a cell's dirt that the nozzle takes in a second.
const SUCTION: f64 = 1.5;
/// The distance at which the switches respond, in metres, and the overlap of the two sides, in
/// radians.
const FEEL: f64 = 0.003;
const SIDE: f64 = 0.15;
const FRONT: f64 = 1.4;

/// The robot in a room.
#[derive(Clone)]
pub struct Vacuum {
    room: Grid,
    ticks: u64,
    now: Instant,
    clock: VirtualClock,
    pose: Pose2,
    /// Speed ahead and turn rate: commanded, and of the wheels.
    asked: [f64; 2],
    moving: [f64; 2],
    way: [f64; 2],
    counters: Noise,
    suction: bool,
    /// The remaining dirt in each cell.
    left: Vec<f64>,
    level: f64,
    touched: [bool; 2],
    held: [bool; 2],
    button: bool,
    /// Stopped permanently.
    stopped: bool,
    blocked: bool,
    dead: bool,
    /// Why the controller does not answer.
    trouble: Option<Invalid>,
    grip: f64,
    lines: Lines,
}

/// The path from each sensor to the plan.
#[derive(Clone, Default)]
struct Lines {
    bumper: Line<[bool; 2]>,
    cliff: Line<bool>,
    dirt: Line<f64>,
    button: Line<bool>,
}

impl Vacuum {
    fn tick(&mut self) {
        for (n, fastest) in FASTEST.into_iter().enumerate() {
            let wanted = if self.is_off() { 0.0 } else { self.asked[n].clamp(-fastest, fastest) };
            self.moving[n] += (wanted - self.moving[n]) * DT / LAG;
            if self.blocked {
                self.moving[n] = 0.0;
            }
            let step = self.moving[n] * DT;
            self.way[n] += step * (1.0 + COUNT_ERROR * self.counters.normal());
        }
        let grip = if self.fallen() { 0.0 } else { self.grip };
        let [ahead, turn] = self.moving.map(|speed| speed * DT * grip);
        self.pose.heading += turn;
        let (sin, cos) = libm::sincos(self.pose.heading);
        self.pose.x += ahead * cos;
        self.pose.y += ahead * sin;
        self.touch();
        self.clean();
        let (bumper, cliff, dirt, button) = self.raw();
        self.lines.bumper.note(bumper, self.now);
        self.lines.cliff.note(cliff, self.now);
        self.lines.dirt.note(dirt, self.now);
        self.lines.button.note(button, self.now);
    }

    /// Pushes the body out of walls and sets the switches.
    fn touch(&mut self) {
        let Pose2 { x, y, heading } = self.pose;
        self.touched = [false; 2];
        for contact in self.room.contacts(x, y, RADIUS + FEEL) {
            let [dx, dy] = contact.towards;
            let bearing = libm::remainder(libm::atan2(dy, dx) - heading, TAU);
            self.touched[0] |= (-SIDE..FRONT).contains(&bearing);
            self.touched[1] |= (-FRONT..SIDE).contains(&bearing);
        }
        self.room.push_out(&mut self.pose, RADIUS);
    }

    fn clean(&mut self) {
        let rate = if self.suction && !self.dead && !self.is_off() { SUCTION } else { 0.0 };
        let index = self.room.index(self.pose.x, self.pose.y);
        let Some(left) = index.and_then(|index| self.left.get_mut(index)) else { return };
        self.level = if rate > 0.0 { *left } else { 0.0 };
        *left = (*left - rate * DT).max(0.0);
    }

    /// Whether the controller has switched the motors off.
    fn is_off(&self) -> bool {
        self.stopped || self.trouble.is_some()
    }

    /// The reading of a sensor as the controller reports it.
    fn said<T: Copy>(&self, value: T) -> Reading<T> {
        match self.trouble {
            Some(why) => Reading::invalid(why, self.now),
            None => Reading::valid(value, self.now),
        }
    }

    fn fallen(&self) -> bool {
        self.room.letter(self.pose.x, self.pose.y) == DROP
    }

    /// The share of the dirt that is gone; 1 for a clean room.
    fn cleaned(&self) -> f64 {
        let dirty = self.room.letters().iter().filter(|letter| **letter == DIRT).count();
        if dirty == 0 { 1.0 } else { 1.0 - self.left.iter().sum::<f64>() / dirty as f64 }
    }

    /// The values of bumper, cliff sensor, dirt sensor and button before faults.
    fn raw(&self) -> (Reading<[bool; 2]>, Reading<bool>, Reading<f64>, Reading<bool>) {
        let (sin, cos) = libm::sincos(self.pose.heading);
        let edge = [self.pose.x + RADIUS * cos, self.pose.y + RADIUS * sin];
        let drop = self.room.letter(edge[0], edge[1]) == DROP;
        let bumper = [0, 1].map(|side| self.touched[side] || self.held[side]);
        (self.said(bumper), self.said(drop), self.said(self.level), self.said(self.button))
    }
}

impl Environment for Vacuum {
    fn stop(&mut self, _: Instant) {
        self.halt();
        self.suction = false;
    }

    fn emergency_stop(&mut self) {
        self.stopped = true;
        self.suction = false;
    }
}

impl Wheels for Vacuum {
    fn drive(&mut self, speed: Speed, turn: AngularSpeed) {
        let asked = [speed.si(), turn.si()];
        // The motors ignore a command that is not finite.
        self.asked = if asked.iter().all(|number| number.is_finite()) { asked } else { [0.0; 2] };
    }

    fn way(&self) -> Reading<Way> {
        let [ahead, turned] = self.way;
        self.said(Way { ahead: Length::from_si(ahead), turned: Angle::from_si(turned) })
    }
}

impl Nozzle for Vacuum {
    fn suck(&mut self, on: bool) {
        self.suction = on && !self.stopped;
    }
}

impl Senses for Vacuum {
    fn bumper(&self) -> Reading<[bool; 2]> {
        self.lines.bumper.sense(self.raw().0, self.now, &self.clock)
    }

    fn drop(&self) -> Reading<bool> {
        self.lines.cliff.sense(self.raw().1, self.now, &self.clock)
    }

    fn dirt(&self) -> Reading<f64> {
        self.lines.dirt.sense(self.raw().2, self.now, &self.clock)
    }

    fn button(&self) -> Reading<bool> {
        self.lines.button.sense(self.raw().3, self.now, &self.clock)
    }
}

impl Platform for Vacuum {
    type Clock = VirtualClock;

    fn clock(&self) -> VirtualClock {
        self.clock.clone()
    }

    fn now(&self) -> Instant {
        self.now
    }

    fn advance(&mut self, to: Instant) {
        let grid = |ticks: u64| Instant::ZERO + TICK * ticks;
        while grid(self.ticks + 1) <= to {
            self.ticks += 1;
            self.now = grid(self.ticks);
            self.tick();
        }
        self.now = self.now.max(to);
    }

    fn ready(&self) -> Instant {
        self.clock.free()
    }
}

impl Robot for Vacuum {
    type Devices = Devices;

    fn press(&mut self, control: Control, held: bool) -> Result<(), Refused> {
        match control {
            Control::BumperLeft => self.held[0] = held,
            Control::BumperRight => self.held[1] = held,
            Control::ButtonHalt => self.button = held,
        }
        Ok(())
    }

    fn set_faults(&mut self, active: &Active<'_, Fault>) -> Result<(), Refused> {
        self.blocked = active.find(Fault::wheels_blocked).is_some();
        self.grip = active.find(Fault::wheels_slip).unwrap_or(1.0);
        self.dead = active.find(Fault::suction_dead).is_some();
        let restarts = active.find(Fault::controller_restarted).is_some();
        if restarts {
            self.way = [0.0; 2];
        }
        let stalls = active.find(Fault::controller_stalled).map(|()| Invalid::NoAnswer);
        // After a restart it obeys nothing, until another run begins.
        let restarted = self.trouble.filter(|why| *why == Invalid::Restarted);
        self.trouble = if restarts { Some(Invalid::Restarted) } else { restarted.or(stalls) };
        let (bumper, cliff, dirt, button) = self.raw();
        self.lines.bumper.set(active.find(Fault::bumper), bumper);
        self.lines.cliff.set(active.find(Fault::cliff), cliff);
        self.lines.dirt.set(active.find(Fault::dirt), dirt);
        self.lines.button.set(active.find(Fault::button), button);
        Ok(())
    }

    fn sample(&self, to: &mut Samples<'_, '_>) {
        let (bumper, cliff, ..) = self.raw();
        let [left, right] = bumper.value.unwrap_or_default();
        to.put(signal::BUMPER_LEFT, SampleRef::Bool(left));
        to.put(signal::BUMPER_RIGHT, SampleRef::Bool(right));
        to.put(signal::CLIFF_DROP, SampleRef::Bool(cliff.value.unwrap_or_default()));
        to.put(signal::DIRT_LEVEL, SampleRef::Float(self.level));
        to.put(signal::BUTTON_HALT, SampleRef::Bool(self.button));
        to.put(signal::SUCTION_ON, SampleRef::Bool(self.suction && !self.dead));
        let pose = Transform { parent: WORLD, child: BODY, pose: self.pose, height: 0.0 };
        to.put(signal::POSE, SampleRef::Pose(pose));
        to.put(signal::CLEANED, SampleRef::Float(self.cleaned()));
        to.put(signal::FALLEN, SampleRef::Bool(self.fallen()));
    }

    fn figures(&self) -> Vec<Figure> {
        let share = self.cleaned();
        let value = FigureValue::Numbers(vec![("share", share)]);
        let text = format!("{:.0} % of the dirt", share * 100.0);
        vec![Figure { name: "cleaned", value, text }]
    }

    fn keyframe(&self) -> Option<Self> {
        Some(Vacuum { clock: self.clock.split(), ..self.clone() })
    }
}

impl Simulated for Vacuum {
    type World = Room;
    type Error = WorldError;

    fn new(room: &Room, seed: u64) -> Result<Self, WorldError> {
        let Room(grid) = room;
        let dirt = |letter: &char| f64::from(u8::from(*letter == DIRT));
        Ok(Vacuum {
            left: grid.letters().iter().map(dirt).collect(),
            pose: grid.start,
            room: grid.clone(),
            ticks: 0,
            now: Instant::ZERO,
            clock: VirtualClock::default(),
            asked: [0.0; 2],
            moving: [0.0; 2],
            way: [0.0; 2],
            counters: Noise::new(seed, "counters"),
            suction: false,
            level: 0.0,
            touched: [false; 2],
            held: [false; 2],
            button: false,
            stopped: false,
            blocked: false,
            dead: false,
            trouble: None,
            grip: 1.0,
            lines: Lines::default(),
        })
    }
}
