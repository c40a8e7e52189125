//! The path of the robot and the events on it.

use afp_core::Instant;
use afp_core::devices::{DeviceRow, SignalId, SignalRow, SignalType, find_signal, signals};
use afp_core::trace::{ComponentId, ComponentKind, Names, Outcome, Record};

use crate::observer::{NamedRecord, Observer, Sampling};
use crate::sample::{Pose2, SampleRef, Shape};
use crate::session::SAMPLE;
use crate::world::Outlines;

/// A point of a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Waypoint {
    /// The time.
    pub at: Instant,
    /// The pose of the robot.
    pub pose: Pose2,
    /// The active actor.
    pub actor: Option<ComponentId>,
}

/// An event on a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mark {
    /// The time.
    pub at: Instant,
    /// The pose of the robot, interpolated between the samples before and after.
    pub pose: Pose2,
    /// Its supervisor.
    pub supervisor: ComponentId,
    /// The event.
    pub event: Outcome,
}

/// Follows the pose of a robot (signal `robot.pose`) every [`SAMPLE`], or that of a finished run.
#[derive(Clone, Debug)]
pub struct Track {
    /// The path of the robot.
    pub path: Vec<Waypoint>,
    /// The events that were taken.
    pub marks: Vec<Mark>,
    /// The last outlines of moving things, from signals of the true world.
    pub things: Outlines,
    /// The length of the path, metres.
    pub distance: f64,
    /// Whether path, marks and things are kept.
    keeps: bool,
    /// The last pose and its time.
    last: Option<(Instant, Pose2)>,
    signal: Option<SignalId>,
    outlines: Vec<SignalId>,
    actor: Option<ComponentId>,
    /// The index of the first mark since the last pose.
    unplaced: usize,
}

impl Track {
    /// Measures the distance only, in constant memory.
    pub fn distance_alone(devices: &[DeviceRow]) -> Self {
        Track { keeps: false, outlines: Vec::new(), ..Track::new(devices) }
    }

    /// Follows a robot with those devices.
    pub fn new(devices: &[DeviceRow]) -> Self {
        let is_outline = |row: &SignalRow| row.truth && row.ty == SignalType::Outline;
        Track {
            path: Vec::new(),
            marks: Vec::new(),
            things: Outlines::new(),
            distance: 0.0,
            keeps: true,
            last: None,
            signal: find_signal(devices, "robot", "pose"),
            outlines: signals(devices)
                .filter(|(_, _, row)| is_outline(row))
                .map(|(id, ..)| id)
                .collect(),
            actor: None,
            unplaced: 0,
        }
    }
}

impl Track {
    /// The length of the path, metres; `None` without a pose.
    pub fn way(&self) -> Option<f64> {
        self.last.map(|_| self.distance)
    }

    /// Notes a record, in order of time.
    pub fn note_record(&mut self, at: Instant, record: &Record<'_>, names: &dyn Names) {
        match *record {
            Record::Started { component }
                if names.component(component).kind == ComponentKind::Actor =>
            {
                self.note_actor(at, Some(component));
            }
            Record::Returned { component, .. }
                if names.component(component).kind == ComponentKind::Actor =>
            {
                self.note_actor(at, Some(component));
            }
            Record::Suspended { started: true, .. } => self.note_actor(at, None),
            Record::Interrupted { element: left }
            | Record::Finished { element: left, .. }
            | Record::Faulted { component: left, .. }
                if self.actor == Some(left) =>
            {
                self.note_actor(at, None);
            }
            Record::Event { supervisor, event, .. } if self.keeps => {
                let pose = self.last.map_or(Pose2::default(), |(_, pose)| pose);
                self.marks.push(Mark { at, pose, supervisor, event });
            }
            _ => {}
        }
    }

    /// Notes a pose, before the records of the same instant.
    pub fn note_pose(&mut self, at: Instant, pose: Pose2) {
        let seen = (at, pose);
        let before = self.last.replace(seen).unwrap_or(seen);
        self.distance += libm::hypot(pose.x - before.1.x, pose.y - before.1.y);
        for mark in self.marks.iter_mut().skip(self.unplaced) {
            mark.pose = Pose2::between(before, seen, mark.at);
        }
        self.unplaced = self.marks.len();
        if self.keeps {
            self.path.push(Waypoint { at, pose, actor: self.actor });
        }
    }

    fn note_actor(&mut self, at: Instant, actor: Option<ComponentId>) {
        self.actor = actor;
        // The first point belongs to the actor that starts first.
        if let [only] = &mut self.path[..]
            && only.at == at
        {
            only.actor = actor;
        }
    }

    fn note_thing(&mut self, shape: &Shape) {
        match self.things.get_mut(&shape.id) {
            Some(outline) => outline.clone_from(&shape.outline),
            None => {
                self.things.insert(shape.id.clone(), shape.outline.clone());
            }
        }
    }
}

impl Observer for Track {
    fn on_record(&mut self, named: &NamedRecord<'_>) {
        self.note_record(named.at, named.record, named.names);
    }

    fn sampling(&self) -> Sampling {
        match self.signal {
            Some(_) => Sampling::Every(SAMPLE),
            None => Sampling::Never,
        }
    }

    fn wants(&self, _: Instant, signal: SignalId) -> bool {
        self.signal == Some(signal) || self.outlines.contains(&signal)
    }

    fn on_sample(&mut self, at: Instant, _: SignalId, value: SampleRef<'_>) {
        match value {
            SampleRef::Pose(frame) => self.note_pose(at, frame.pose),
            SampleRef::Outline(shape) => self.note_thing(shape),
            _ => {}
        }
    }
}
