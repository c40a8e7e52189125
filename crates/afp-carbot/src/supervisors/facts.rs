//! The implementations report what the toolbox declares: exclusive events never together, and no event before its time.

use std::string::String;
use std::vec::Vec;

use super::{CheckColor, CheckDistance, CheckDrivingLane, CheckInfrared, CheckProgress};
use crate::devices::Color;
use crate::fake::{Fake, plane};
use crate::templates::{
    self, check_color, check_distance, check_driving_lane, check_infrared, check_progress,
};
use afp_core::quantity::{Angle, Length, Time};
use afp_core::{Events, Supervisor, SupervisorTemplate, Value};
use afp_dsl::graph::Formula;
use afp_dsl::toolbox::case::value;
use afp_dsl::toolbox::{Condition, Fact, Template, Toolbox};
use afp_syntax::source::Source;

/// Pairs of supervisors for each fact.
const PAIRS: u32 = 300;
/// Polls of each pair.
const POLLS: u32 = 120;

/// The templates with facts.
fn declared() -> Vec<Template> {
    let source = Source::new("carbot.afp", templates::SOURCE);
    let (toolbox, _) = Toolbox::parse(&source, 0, "afp_carbot");
    let mut templates = toolbox.map(|toolbox| toolbox.templates).unwrap_or_default();
    templates.retain(|template| !template.facts.is_empty());
    templates
}

/// Random numbers by a xorshift generator.
struct Draws(u64);

impl Draws {
    /// A number between two others.
    fn within(&mut self, least: f64, greatest: f64) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        least + (greatest - least) * (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// One of some values.
    fn one_of(&mut self, values: &[f64]) -> f64 {
        values[self.within(0.0, values.len() as f64) as usize]
    }
}

/// The inputs of a supervisor: those of its start, and those of each poll.
type Ports<T> =
    (<T as SupervisorTemplate>::Inputs<'static>, <T as SupervisorTemplate>::Live<'static>);

/// How to sample a template.
struct Sampled<T: SupervisorTemplate> {
    /// Draws values of all inputs, in their order.
    inputs: fn(&mut Draws) -> Vec<f64>,
    ports: fn(&[f64]) -> Ports<T>,
    /// Changes the robot's surroundings, for supervisors with these inputs.
    change: fn(&mut Fake, &mut Draws, [&[f64]; 2]),
}

/// Pairs of supervisors for which a fact says that they exclude each other, and other pairs: how many reported only the
/// first event at some poll, only the second event, and both events.
type Counts = [[u32; 3]; 2];

/// Whether two supervisors reported their events alone and together, as for [`Counts`].
fn reports<T: SupervisorTemplate, S: Supervisor<T, Fake>>(
    sampled: &Sampled<T>,
    events: [u16; 2],
    inputs: [&[f64]; 2],
    draws: &mut Draws,
) -> [bool; 3] {
    let robot = &mut Fake::new(&[]);
    let start = robot.now;
    let mut watch = inputs.map(|values| S::start((sampled.ports)(values).0, robot, start).unwrap());
    let mut seen = [false; 3];
    for _ in 0..POLLS {
        if draws.within(0.0, 1.0) < 0.02 {
            (sampled.change)(robot, draws, inputs);
        }
        robot.tick();
        let now = robot.now;
        let mut poll = |which: usize| {
            let (live, wanted) =
                ((sampled.ports)(inputs[which]).1, Events::from_bits(1 << events[which]));
            watch[which].poll(live, wanted, robot, now).unwrap().is_some()
        };
        match (poll(0), poll(1)) {
            (true, true) => seen[2] = true,
            (true, false) => seen[0] = true,
            (false, true) => seen[1] = true,
            (false, false) => {}
        }
    }
    seen
}

/// Samples pairs of supervisors that report exclusive events.
fn sample_pairs<T: SupervisorTemplate, S: Supervisor<T, Fake>>(
    sampled: &Sampled<T>,
    (events, conditions): ([u16; 2], &[Condition]),
    draws: &mut Draws,
) {
    let mut counts: Counts = [[0; 3]; 2];
    for _ in 0..PAIRS {
        let (first, second) = ((sampled.inputs)(draws), (sampled.inputs)(draws));
        let both = [first.as_slice(), second.as_slice()].concat();
        let known = |port: u16| both.get(usize::from(port)).copied().map(Value::Float);
        let exclude = conditions.iter().all(|one| one.holds(&known).unwrap());
        let seen = reports::<T, S>(sampled, events, [&first, &second], draws);
        assert!(!(exclude && seen[2]), "{first:?} and {second:?} report both of {events:?}");
        for (count, seen) in counts[usize::from(exclude)].iter_mut().zip(seen) {
            *count += u32::from(seen);
        }
    }
    let [[_, _, together], [first, second, _]] = counts;
    assert!(first > 3 && second > 3 && together > 3, "{events:?}: {counts:?}");
}

/// Samples supervisors that report an event after a time.
fn sample_times<T: SupervisorTemplate, S: Supervisor<T, Fake>>(
    sampled: &Sampled<T>,
    (event, time): (u16, &Formula),
    draws: &mut Draws,
) {
    let mut count = 0;
    for _ in 0..PAIRS {
        let inputs = (sampled.inputs)(draws);
        let known = |port: u16| inputs.get(usize::from(port)).copied().map(Value::Float);
        let Some(Value::Float(time)) = value(time, &known) else { panic!("{time:?}") };
        let robot = &mut Fake::new(&[]);
        for _ in 0..draws.within(0.0, 10.0) as u32 {
            (sampled.change)(robot, draws, [&inputs; 2]);
            robot.tick();
        }
        let start = robot.now;
        let mut watch = S::start((sampled.ports)(&inputs).0, robot, start).unwrap();
        for _ in 0..POLLS {
            let (live, wanted) = ((sampled.ports)(&inputs).1, Events::from_bits(1 << event));
            let now = robot.now;
            let reported = watch.poll(live, wanted, robot, now).unwrap().is_some();
            let elapsed = now.since(start).as_secs_f64();
            assert!(!reported || elapsed >= time, "{event} after {elapsed} s: {inputs:?}");
            count += u32::from(reported);
            robot.tick();
        }
    }
    assert!(count > 300, "{event}: {count}");
}

/// Samples all facts of a template.
fn sample<T: SupervisorTemplate, S: Supervisor<T, Fake>>(name: &str, sampled: &Sampled<T>) {
    let template = declared().into_iter().find(|template| template.name == name).unwrap();
    let draws = &mut Draws(20);
    assert_eq!((sampled.inputs)(draws).len(), template.inputs.len());
    for fact in &*template.facts {
        match fact {
            Fact::Exclusive(events, conditions) => {
                sample_pairs::<T, S>(sampled, (*events, conditions), draws);
            }
            Fact::After(event, time) => sample_times::<T, S>(sampled, (*event, time), draws),
            Fact::When(..) => panic!("{fact:?}"),
        }
    }
}

#[test]
fn every_template_with_facts_is_sampled() {
    let names: Vec<String> = declared().into_iter().map(|template| template.name).collect();
    assert_eq!(
        names,
        ["CheckDrivingLane", "CheckDistance", "CheckInfrared", "CheckColor", "CheckProgress"]
    );
}

#[test]
fn distances_exclude_each_other_and_need_an_echo() {
    sample::<templates::CheckDistance, CheckDistance>(
        "CheckDistance",
        &Sampled {
            inputs: |draws| Vec::from([draws.one_of(&[0.0, 0.03]), draws.within(0.2, 0.8)]),
            ports: |inputs| {
                let (bearing, distance) = (Angle::from_si(inputs[0]), Length::from_si(inputs[1]));
                (check_distance::Inputs { bearing }, check_distance::Live { distance })
            },
            change: |robot, draws, _| {
                robot.walls = Vec::from([plane(0.0, draws.within(0.3, 1.2))]);
            },
        },
    );
}

#[test]
fn strengths_of_light_exclude_each_other_and_need_a_reading() {
    sample::<templates::CheckInfrared, CheckInfrared>(
        "CheckInfrared",
        &Sampled {
            inputs: |draws| Vec::from([draws.within(0.05, 1.0)]),
            ports: |inputs| {
                (check_infrared::Inputs {}, check_infrared::Live { strength: inputs[0] })
            },
            change: |robot, draws, _| robot.light = Some((draws.within(0.8, 4.0), 0.0)),
        },
    );
}

#[test]
fn an_obstacle_in_the_lane_needs_an_echo() {
    sample::<templates::CheckDrivingLane, CheckDrivingLane>(
        "CheckDrivingLane",
        &Sampled {
            inputs: |draws| Vec::from([draws.within(0.2, 0.8), 0.1, 0.1, 0.25]),
            ports: |inputs| {
                let [distance, clearance, margin, halfwidth] = inputs[..] else {
                    panic!("{inputs:?}")
                };
                let [clearance, margin, halfwidth] =
                    [clearance, margin, halfwidth].map(Length::from_si);
                let distance = Length::from_si(distance);
                (
                    check_driving_lane::Inputs { clearance, margin, halfwidth },
                    check_driving_lane::Live { distance },
                )
            },
            change: |robot, draws, _| {
                robot.walls = Vec::from([plane(0.0, draws.within(0.3, 1.2))]);
            },
        },
    );
}

#[test]
fn missing_progress_takes_a_time() {
    sample::<templates::CheckProgress, CheckProgress>(
        "CheckProgress",
        &Sampled {
            inputs: |draws| Vec::from([0.1, 0.5, draws.one_of(&[0.1, 0.3, 0.8])]),
            ports: |inputs| {
                let [distance, angle, within] = inputs[..] else { panic!("{inputs:?}") };
                let (distance, angle) = (Length::from_si(distance), Angle::from_si(angle));
                let within = Time::from_si(within);
                (check_progress::Inputs { distance, angle, within }, check_progress::Live {})
            },
            change: |_, _, _| {},
        },
    );
}

#[test]
fn colours_exclude_each_other() {
    sample::<templates::CheckColor, CheckColor>(
        "CheckColor",
        &Sampled {
            inputs: |draws| {
                let mut share = || draws.within(0.0, 1.0);
                Vec::from([share(), share(), share(), 0.1 + share() * 0.4])
            },
            ports: |inputs| {
                let [red, green, blue, tolerance] = inputs[..] else { panic!("{inputs:?}") };
                (check_color::Inputs { red, green, blue, tolerance }, check_color::Live {})
            },
            // A colour between both, which is more often seen than another one.
            change: |robot, draws, [first, second]| {
                let part = draws.within(0.0, 1.0);
                let share = |channel: usize| first[channel] * part + second[channel] * (1.0 - part);
                robot.floor = Color { red: share(0), green: share(1), blue: share(2) };
            },
        },
    );
}
