//! Where the robot went, and what happened on the way.

use afp_core::Instant;
use afp_core::devices::{DeviceRow, SignalId, SignalRow, SignalType, find_signal, signals};
use afp_core::trace::{ComponentId, ComponentKind, Record};

use crate::observer::{NamedRecord, Observer, Sampling, View};
use crate::sample::{Pose2, SampleRef, Shape};
use crate::session::SAMPLE;
use crate::world::Outlines;

/// A point of a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Waypoint {
    /// When the robot was there.
    pub at: Instant,
    /// Where it was.
    pub pose: Pose2,
    /// The actor that was active.
    pub actor: Option<ComponentId>,
}

/// An event on a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mark {
    /// When it was taken.
    pub at: Instant,
    /// Where the robot was then.
    pub pose: Pose2,
    /// Its supervisor.
    pub supervisor: ComponentId,
    /// The event.
    pub event: u16,
}

/// Follows the pose of a robot that signals one (`robot.pose`), every [`SAMPLE`].
#[derive(Clone, Debug)]
pub struct Track {
    /// Where the robot was.
    pub path: Vec<Waypoint>,
    /// The events that were taken.
    pub marks: Vec<Mark>,
    /// Where what moves was last, as far as the robot's devices tell it truly.
    pub things: Outlines,
    /// How far the robot went, metres.
    pub distance: f64,
    /// Whether path, marks and things are kept.
    keeps: bool,
    /// Where the robot was last.
    last: Option<Pose2>,
    signal: Option<SignalId>,
    outlines: Vec<SignalId>,
    actor: Option<ComponentId>,
    /// Marks of this step, whose pose is not known yet, are from here on.
    unplaced: usize,
}

impl Track {
    /// The distance alone, in memory that does not grow with time.
    pub fn distance_alone(devices: &[DeviceRow]) -> Self {
        Track { keeps: false, outlines: Vec::new(), ..Track::new(devices) }
    }

    /// For a robot with those devices.
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
        match *named.record {
            Record::Started { component }
                if named.names.component(component).kind == ComponentKind::Actor =>
            {
                self.actor = Some(component);
            }
            Record::Interrupted { element: left }
            | Record::Finished { element: left, .. }
            | Record::Faulted { component: left, .. }
                if self.actor == Some(left) =>
            {
                self.actor = None;
            }
            Record::Event { supervisor, event, .. } if self.keeps => {
                let pose = Pose2::default();
                self.marks.push(Mark { at: named.at, pose, supervisor, event });
            }
            _ => {}
        }
    }

    fn after_step(&mut self, view: &View<'_>) {
        // The path begins with the actor that starts first.
        if let [only] = &mut self.path[..]
            && only.at == view.now()
        {
            only.actor = self.actor;
        }
        if let (Some(signal), true) = (self.signal, self.unplaced < self.marks.len()) {
            let marks = self.marks.get_mut(self.unplaced..).unwrap_or_default();
            view.read(signal, &mut |value| {
                if let SampleRef::Pose(frame) = value {
                    marks.iter_mut().for_each(|mark| mark.pose = frame.pose);
                }
            });
        }
        self.unplaced = self.marks.len();
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
        let frame = match value {
            SampleRef::Pose(frame) => frame,
            SampleRef::Outline(shape) => return self.note_thing(shape),
            _ => return,
        };
        let pose = frame.pose;
        if let Some(last) = self.last.replace(pose) {
            self.distance += libm::hypot(pose.x - last.x, pose.y - last.y);
        }
        if self.keeps {
            self.path.push(Waypoint { at, pose, actor: self.actor });
        }
    }
}
