//! Rules for any world, checked while a plan runs.

use afp_carbot::guard::{LATE, PATIENCE};
use afp_core::trace::{ComponentKind, Names, Record};
use afp_core::{Duration, Instant};
use afp_sim::{Fault, Simulation};

use crate::chance::{Chance, Stimulus};
use crate::sensor::Sensor;

mod order;
mod stand;
#[cfg(test)]
mod tests;

use order::Order;
use stand::Stand;

/// The largest usable age of readings from continuous sensors.
const CURRENT: Duration = Duration::from_millis(100);

/// Watches a plan's readings, commands and trace.
///
/// The rules:
///
/// 1. A command to move comes at the instant of a valid odometry reading that is no older than 100
///    ms.
/// 2. A command to move comes no later than the templates' [`PATIENCE`], and a poll, after the last
///    usable reading of every sensor used since the active actor started. A valid reading of the
///    range sensor, the infrared sensor or the camera is usable once, up to an age of 200 ms for
///    the range sensor and of the patience for the others. Readings of other sensors are usable
///    while they are valid and no older than 100 ms. Silence and invalid readings therefore never
///    count as free space for longer.
/// 3. After any interruption of an actor, the command is zero when the next one starts. The command
///    is also zero when an actor fails, and when it is ready.
/// 4. After the end of the plan there are no commands to move, and the command is zero at the end.
/// 5. While the command is zero, the robot has stopped after the stop time of the templates, unless
///    something pushes it. On a slippery floor the time for friction is added, and for a deaf
///    controller the time until it stops by itself.
/// 6. Every body is finite and in the room; commands are finite; valid readings are finite and
///    within the measuring range.
/// 7. One actor is active at a time, and none after the end, unless a controller that restarts ends
///    the plan at once. Another one starts only after it has ended or was interrupted or suspended.
/// 8. A commit writes each entry once, and nothing else changes an entry.
#[derive(Debug)]
pub struct Watch {
    sensors: [Use; Sensor::ALL.len()],
    command: (f64, f64),
    /// Whether an actor failed in this step.
    failed: bool,
    ended: bool,
    /// The instants of this step and of the one before.
    steps: [Instant; 2],
    stand: Stand,
    order: Order,
    reach: f64,
    broken: Vec<(Instant, String)>,
}

/// An actor's use of a sensor.
#[derive(Clone, Copy, Debug, Default)]
struct Use {
    /// The time since the last usable reading; `None` if the actor has not used the sensor.
    waiting: Option<Instant>,
    /// The measuring time of the latest reading.
    measured: Instant,
    /// The time of its request.
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
            order: Order::default(),
            reach,
            broken: Vec::new(),
        }
    }

    /// Records a violated rule.
    pub(crate) fn breaks(&mut self, at: Instant, why: String) {
        if self.broken.len() < 20 {
            self.broken.push((at, why));
        }
    }

    /// The violated rules, oldest first.
    pub(crate) fn broken(self) -> Vec<(Instant, String)> {
        self.broken
    }

    pub(crate) fn step(&mut self, now: Instant) {
        self.steps = [now, self.steps[0]];
        self.failed = false;
    }

    /// Records that the plan ends at once, without calls of its components.
    pub(crate) fn aborted(&mut self) {
        self.order.aborted();
    }

    /// Records a reading that a plan received, measured at `time`.
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

    /// Records a command to move.
    pub(crate) fn commanded(&mut self, speed: f64, turn: f64, now: Instant) {
        self.command = (speed, turn);
        self.stand.commanded((speed, turn) == (0.0, 0.0), now);
        if !(speed.is_finite() && turn.is_finite()) {
            self.breaks(now, format!("{speed} m/s, {turn} rad/s are not finite"));
        }
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
        // A late poll delays the first possible fault after the patience.
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

    /// Records an event of the plan.
    pub(crate) fn on_record(&mut self, at: Instant, record: &Record<'_>, names: &impl Names) {
        if let Some(why) = self.order.on_record(record, names) {
            self.breaks(at, why);
        }
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

    /// Ends a step.
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
            self.breaks(
                at,
                format!("a driving actor {when}, but {speed} m/s, {turn} rad/s remain"),
            );
        }
    }

    /// Records a stimulus.
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

    /// Compares with ground truth.
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
