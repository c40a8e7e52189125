//! A run as messages: one method per kind of message, whoever takes them.

use std::collections::BTreeMap;
use std::path::PathBuf;

use afp_core::trace::{Author, Names, Record, TraceEntryId};
use afp_core::{Instant, Value};
use afp_session::{EventKind, RunEvent, author as author_of};
use prost::Message;

use crate::error::LogError;
use crate::names::OwnedNames;
use crate::proto::afp::{Configuration, Entry, Sample};
use crate::proto::{AFP_SET, FOXGLOVE_SET};
use crate::recorder::{Item, Signal};
use crate::{event, foxglove};

/// Who takes the messages of a run: a file, clients that watch.
pub trait Messages: Send {
    /// Opens a channel of protobuf messages: its topic, the name of its schema, the descriptors that explain it (a
    /// `FileDescriptorSet`). Gives its number.
    ///
    /// # Errors
    /// It cannot be opened.
    fn open(&mut self, topic: &str, schema: &str, set: &[u8]) -> Result<u16, LogError>;

    /// Takes a message; `sequence` counts those of its channel.
    ///
    /// # Errors
    /// The disk is full or fails.
    fn send(
        &mut self,
        channel: u16,
        sequence: u32,
        at: Instant,
        message: &[u8],
    ) -> Result<(), LogError>;

    /// What the run came to, by name.
    ///
    /// # Errors
    /// The disk is full or fails.
    fn came(&mut self, facts: Vec<(String, String)>) -> Result<(), LogError>;

    /// What has been taken is to be seen by others.
    ///
    /// # Errors
    /// The disk is full or fails.
    fn flush(&mut self) -> Result<(), LogError>;

    /// Nothing comes any more; `in_order` where the run is over. Gives the file and its size in bytes, where there is
    /// one.
    ///
    /// # Errors
    /// The disk is full or fails.
    fn finish(self: Box<Self>, in_order: bool) -> Result<(PathBuf, u64), LogError>;

    /// Nothing comes any more, and nothing came of the run: of a file nothing stays.
    fn discard(self: Box<Self>) {
        // There is nobody to tell.
        let _ = self.finish(false);
    }
}

/// A channel that every log has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Topic {
    Events,
    Configuration,
    Table,
    Transforms,
    Pose,
    Scene,
    Log,
}

/// Topic, schema and the descriptors that explain it, in the order of [`Topic`].
const CHANNELS: [(&str, &str, &[u8]); 7] = [
    ("/plan/events", "afp.PlanEvent", AFP_SET),
    ("/plan/configuration", "afp.Configuration", AFP_SET),
    ("/plan/table", "afp.PlanTable", AFP_SET),
    ("/tf", "foxglove.FrameTransforms", FOXGLOVE_SET),
    ("/robot/pose", "foxglove.PoseInFrame", FOXGLOVE_SET),
    ("/scene", "foxglove.SceneUpdate", FOXGLOVE_SET),
    ("/log", "foxglove.Log", FOXGLOVE_SET),
];

/// Schema and descriptors of what range sensors, cameras and other devices say.
const RANGING: (&str, &[u8]) = ("foxglove.LaserScan", FOXGLOVE_SET);
const IMAGE: (&str, &[u8]) = ("foxglove.CompressedImage", FOXGLOVE_SET);
const SAMPLE: (&str, &[u8]) = ("afp.Sample", AFP_SET);

/// A channel, and how many messages it has.
#[derive(Clone, Copy, Debug, Default)]
struct Channel {
    id: u16,
    count: u32,
}

/// Makes messages of what happens in a run.
pub(crate) struct Encoder {
    to: Box<dyn Messages>,
    /// Those that every log has, then those of devices that have said something.
    channels: Vec<Channel>,
    /// Where the channel of a signal is among them; of a whole device where it has no name.
    signals: BTreeMap<(&'static str, &'static str), usize>,
    names: OwnedNames,
    entries: Vec<Entry>,
    /// The commit whose entries are being collected.
    commit: Option<(Instant, Author)>,
    buffer: Vec<u8>,
}

impl Encoder {
    /// Opens the channels that every log has, and says what the plan consists of.
    ///
    /// # Errors
    /// The disk is full or fails.
    pub(crate) fn new(to: Box<dyn Messages>, names: OwnedNames) -> Result<Self, LogError> {
        let unset = |id| event::entry(&names, TraceEntryId(id), afp_core::ValueRef::Unset);
        let entries = (0..names.entries()).map(unset).collect();
        let (channels, signals) = (Vec::new(), BTreeMap::new());
        let (commit, buffer) = (None, Vec::new());
        let mut log = Encoder { to, channels, signals, names, entries, commit, buffer };
        for (topic, schema, set) in CHANNELS {
            log.open(topic, schema, set)?;
        }
        log.send(Topic::Table, Instant::ZERO, &event::table(&log.names))?;
        log.flush()?;
        Ok(log)
    }

    /// Opens a channel; gives its position.
    fn open(&mut self, topic: &str, schema: &str, set: &[u8]) -> Result<usize, LogError> {
        let id = self.to.open(topic, schema, set)?;
        self.channels.push(Channel { id, count: 0 });
        Ok(self.channels.len() - 1)
    }

    /// The position of the channel of a signal, opened where it is new.
    fn of_signal(
        &mut self,
        device: &'static str,
        name: &'static str,
        (schema, set): (&str, &[u8]),
    ) -> Result<usize, LogError> {
        if let Some(known) = self.signals.get(&(device, name)) {
            return Ok(*known);
        }
        let topic = match (device, name) {
            (device, "") => format!("/robot/{device}"),
            // What is about the whole robot.
            ("robot", name) => format!("/robot/{name}"),
            (device, name) => format!("/robot/{device}/{name}"),
        };
        let new = self.open(&topic, schema, set)?;
        self.signals.insert((device, name), new);
        Ok(new)
    }

    pub(crate) fn write(&mut self, item: Item) -> Result<(), LogError> {
        match item {
            Item::Record(owned) => self.record(owned.at, &owned.get()),
            Item::Event(event) => {
                self.close_commit()?;
                self.send(Topic::Events, event.at, &event::encode(*event))
            }
            Item::Started(at) => self.configuration(at, String::new()),
            Item::Lost { at, count, entries } => {
                self.lost(at, count)?;
                self.set_all(at, &entries)
            }
            Item::Transforms { at, transforms } => {
                self.send(Topic::Transforms, at, &foxglove::transforms(at, &transforms))
            }
            Item::Pose { at, frame, pose } => {
                self.send(Topic::Pose, at, &foxglove::pose(at, frame, pose))
            }
            Item::Ranging { at, device, ranging, height } => {
                let channel = self.of_signal(device, "", RANGING)?;
                self.send_to(channel, at, &foxglove::ranging(&ranging, height))
            }
            Item::Image { at, device, image } => {
                let channel = self.of_signal(device, "", IMAGE)?;
                self.send_to(channel, at, &foxglove::image(&image))
            }
            Item::Sample { at, signal: Signal { device, name, unit }, value } => {
                let channel = self.of_signal(device, name, SAMPLE)?;
                let (time, unit) = (Some(event::timestamp(at)), unit.to_owned());
                let value = Some(event::encode_value(value));
                self.send_to(channel, at, &Sample { time, value, unit })
            }
            Item::Scene { at, shapes } => {
                self.send(Topic::Scene, at, &foxglove::scene(at, &shapes))
            }
            Item::Text { at, level, name, text } => {
                self.send(Topic::Log, at, &foxglove::text(at, level, name, &text))
            }
            Item::End { facts, .. } => self.to.came(facts),
        }
    }

    fn record(&mut self, at: Instant, record: &Record<'_>) -> Result<(), LogError> {
        match *record {
            Record::Committed { author, entry, new, .. } => {
                if self.commit.is_some_and(|open| open != (at, author)) {
                    self.close_commit()?;
                }
                self.set(entry, new);
                self.commit = Some((at, author));
            }
            _ => self.close_commit()?,
        }
        let event = RunEvent::new(at, record, &self.names);
        self.send(Topic::Events, at, &event::encode(event))
    }

    fn set(&mut self, entry: TraceEntryId, value: afp_core::ValueRef<'_>) {
        let new = event::entry(&self.names, entry, value);
        if let Some(kept) = self.entries.get_mut(entry.0 as usize) {
            *kept = new;
        }
    }

    /// Takes over what all entries hold, and says so: commits are missing, perhaps parts of the open one.
    fn set_all(&mut self, at: Instant, values: &[Value]) -> Result<(), LogError> {
        self.commit = None;
        for (id, value) in (0..).zip(values) {
            self.set(TraceEntryId(id), value.borrow());
        }
        self.configuration(at, String::new())
    }

    fn close_commit(&mut self) -> Result<(), LogError> {
        match self.commit.take() {
            None => Ok(()),
            Some((at, author)) => self.configuration(at, author_of(&self.names, author)),
        }
    }

    fn configuration(&mut self, at: Instant, author: String) -> Result<(), LogError> {
        let entries = self.entries.clone();
        let time = Some(event::timestamp(at));
        self.send(Topic::Configuration, at, &Configuration { time, author, entries })
    }

    fn lost(&mut self, at: Instant, count: u64) -> Result<(), LogError> {
        let kind = EventKind::Lost;
        let lost = RunEvent { at, kind, lost: count, ..RunEvent::default() };
        self.send(Topic::Events, at, &event::encode(lost))
    }

    fn send(&mut self, topic: Topic, at: Instant, message: &impl Message) -> Result<(), LogError> {
        self.send_to(topic as usize, at, message)
    }

    fn send_to(
        &mut self,
        channel: usize,
        at: Instant,
        message: &impl Message,
    ) -> Result<(), LogError> {
        let Some(channel) = self.channels.get_mut(channel) else { return Ok(()) };
        self.buffer.clear();
        // A Vec grows as needed; only a fixed buffer could be too short.
        let _ = message.encode(&mut self.buffer);
        let sequence = channel.count;
        channel.count = channel.count.wrapping_add(1);
        self.to.send(channel.id, sequence, at, &self.buffer)
    }

    pub(crate) fn flush(&mut self) -> Result<(), LogError> {
        self.to.flush()
    }

    /// Tells of what got lost after what has been told, and ends.
    ///
    /// # Errors
    /// The disk is full or fails.
    pub(crate) fn finish(
        mut self,
        in_order: bool,
        last: Instant,
        unreported: u64,
    ) -> Result<(PathBuf, u64), LogError> {
        self.close_commit()?;
        if unreported > 0 {
            self.lost(last, unreported)?;
        }
        self.to.finish(in_order)
    }

    /// Ends without anything that stays.
    pub(crate) fn discard(self) {
        self.to.discard();
    }
}
