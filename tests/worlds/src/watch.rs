//! What must hold in any world, watched while a plan runs.

use afp_carbot::guard::{LATE, PATIENCE};
use afp_core::trace::{ComponentKind, Names, Record};
use afp_core::{Duration, Instant};
use afp_sim::{Fault, Simulation};

use crate::chance::{Chance, Stimulus};
use crate::sensor::Sensor;

mod stand;
#[cfg(test)]
mod tests;

use stand::Stand;

/// Readings of sensors that measure all the time are usable up to this age.
const CURRENT: Duration = Duration::from_millis(100);

/// Watches the readings that a plan gets, the commands that it gives and its trace.
///
/// The rules:
///
/// 1. A command to move comes at the same instant as a valid reading of the odometry that is no
///    older than 100 ms.
/// 2. A command to move comes no later than the templates' [`PATIENCE`], and a poll, after the last
///    usable reading of every sensor that was asked since the active actor started. What the range sensor,
///    the infrared sensor and the camera say now and then is usable once, when it is valid and no older than
///    200 ms, the patience and the patience; what other sensors say is usable while it is valid and no older
///    than 100 ms. So neither silence nor nonsense is free space for longer than that.
/// 3. Whatever interrupts an actor, the command is zero when the next one starts; the same when it
///    fails, and when it is ready.
/// 4. After the end of the plan nothing commands motion, and the command is zero at the end.
/// 5. While the command is zero the robot stands, once the stop time that the templates declare is over,
///    unless something pushes it; on a slippery floor the time that friction needs comes on top, and
///    what a controller that hears nothing takes until it stops by itself.
/// 6. Every body is finite and in the room; valid readings are finite and within what is measured.
#[derive(Debug)]
pub struct Watch {
    sensors: [Use; Sensor::ALL.len()],
    command: (f64, f64),
    /// An actor failed in this step.
    failed: bool,
    ended: bool,
    /// The instants of this step and of the one before.
    steps: [Instant; 2],
    stand: Stand,
    reach: f64,
    broken: Vec<(Instant, String)>,
}

/// How an actor uses a sensor.
#[derive(Clone, Copy, Debug, Default)]
struct Use {
    /// Since when nothing usable came; none if the sensor has not been asked since the actor started.
    waiting: Option<Instant>,
    /// When the latest reading was measured.
    measured: Instant,
    /// When it was asked for.
    asked: Instant,
}

impl Watch {
    pub(crate) fn new(sim: &Simulation, stop: Duration, reach: f64) -> Self {
        Watch {
            sensors: Default::default(),
            command: (0.0, 0.0),
            failed: false,
            ended: false,
            steps: [Instant::ZERO; 2],
            stand: Stand::new(sim.truth().pose(), stop),
            reach,
            broken: Vec::new(),
        }
    }

    /// Notes that a promise is broken.
    pub(crate) fn breaks(&mut self, at: Instant, why: String) {
        if self.broken.len() < 20 {
            self.broken.push((at, why));
        }
    }

    /// What is broken, oldest first.
    pub(crate) fn broken(self) -> Vec<(Instant, String)> {
        self.broken
    }

    /// A step begins.
    pub(crate) fn step(&mut self, now: Instant) {
        self.steps = [now, self.steps[0]];
        self.failed = false;
    }

    /// A plan was told something by a sensor that measured it at `time`.
    pub(crate) fn told(&mut self, sensor: Sensor, valid: bool, time: Instant, now: Instant) {
        let known = &mut self.sensors[sensor as usize];
        let usable = match sensor {
            Sensor::Ultrasonic => time > known.measured && now.since(time) <= LATE,
            Sensor::Infrared | Sensor::Camera => {
                time > known.measured && now.since(time) <= PATIENCE
            }
            _ => now.since(time) <= CURRENT,
        };
        let waiting = known.waiting.get_or_insert(now);
        if valid && usable {
            *waiting = now;
        }
        known.asked = now;
        if valid {
            known.measured = known.measured.max(time);
        }
    }

    /// The plan commands a motion.
    pub(crate) fn commanded(&mut self, speed: f64, turn: f64, now: Instant) {
        self.command = (speed, turn);
        self.stand.commanded((speed, turn) == (0.0, 0.0), now);
        if (speed, turn) == (0.0, 0.0) {
            return;
        }
        if self.ended {
            self.breaks(now, format!("{speed} m/s, {turn} rad/s commanded after the end"));
        }
        let odometry = self.sensors[Sensor::Odometry as usize];
        let age = now.since(odometry.measured);
        if odometry.asked != now || age > CURRENT {
            self.breaks(now, format!("it drives with an odometry of {age} before"));
        }
        // Late polls are no reason to fault later than the first one after the patience.
        let late = PATIENCE + self.steps[0].since(self.steps[1]);
        for sensor in Sensor::ALL {
            let patience = late + sensor.asked_every();
            let waited = self.sensors[sensor as usize].waiting.map(|since| now.since(since));
            if let Some(waited) = waited.filter(|waited| *waited > patience) {
                let name = sensor.name();
                self.breaks(now, format!("it drives though {name} said nothing for {waited}"));
            }
        }
    }

    /// Something happened in the plan.
    pub(crate) fn on_record(&mut self, at: Instant, record: &Record<'_>, names: &impl Names) {
        let actor =
            |id| matches!(names.component(id).kind, ComponentKind::Actor | ComponentKind::SubPlan);
        match *record {
            Record::Interrupted { element } if actor(element) => {
                self.must_stand(at, "is interrupted");
            }
            Record::Finished { element, .. } if actor(element) => self.must_stand(at, "is ready"),
            Record::Faulted { component, .. } if actor(component) => self.failed = true,
            Record::Started { component }
                if names.component(component).kind == ComponentKind::Actor =>
            {
                if self.failed {
                    self.must_stand(at, "failed");
                }
                self.sensors.iter_mut().for_each(|known| known.waiting = None);
            }
            Record::Ended { plan, .. } if plan.0 == 0 => self.ended = true,
            _ => {}
        }
    }

    /// A step is over.
    pub(crate) fn stepped(&mut self, now: Instant) {
        if self.failed {
            self.must_stand(now, "failed");
        }
        if self.ended {
            self.must_stand(now, "ended");
        }
    }

    fn must_stand(&mut self, at: Instant, when: &str) {
        if self.command != (0.0, 0.0) {
            let (speed, turn) = self.command;
            self.breaks(at, format!("what drives {when}, but {speed} m/s, {turn} rad/s stay"));
        }
    }

    /// Something happens from outside.
    pub(crate) fn happened(&mut self, chance: &Chance) {
        for (at, stimulus) in &chance.0 {
            match *stimulus {
                Stimulus::Break(Fault::WheelsSlip { share: grip }, during) => {
                    self.stand.slippery(*at, *at + during, grip);
                }
                Stimulus::Break(Fault::ControllerDead, during) => {
                    self.stand.deaf(*at, *at + during)
                }
                _ => {}
            }
        }
    }

    /// Looks at the truth.
    pub(crate) fn look(&mut self, sim: &Simulation) {
        let now = sim.now();
        let pose = sim.truth().pose();
        let end = self.reach + 0.2;
        let inside = |at: f64| at > -0.2 && at < end;
        if !sim.all_bodies_enabled()
            || !inside(pose.x)
            || !inside(pose.y)
            || !pose.heading.is_finite()
        {
            self.breaks(
                now,
                format!(
                    "the robot is at {pose:?}, all bodies enabled: {}",
                    sim.all_bodies_enabled()
                ),
            );
        }
        for mover in sim.movers() {
            let corners = sim.outline(mover);
            if !corners.as_flattened().iter().all(|at| inside(*at)) {
                self.breaks(now, format!("obstacle {mover} is at {corners:?}"));
            }
        }
        if let Some(why) = self.stand.look(sim) {
            self.breaks(now, why);
        }
    }
}
