//! The file side of a log: schemas, channels, attachments, and one method per kind of message.

use std::collections::BTreeMap;
use std::io::{BufWriter, Seek};
use std::path::{Path, PathBuf};

use afp_core::Instant;
use afp_core::trace::{Author, Names, Record, TraceEntryId};
use afp_output::Output;
use afp_session::{EventKind, RunEvent, author as author_of};
use mcap::records::{MessageHeader, Metadata};
use mcap::write::NoSeek;
use mcap::{Attachment, Compression, WriteOptions, Writer};
use prost::Message;

use crate::error::LogError;
use crate::names::OwnedNames;
use crate::proto::afp::{Configuration, Entry, Sample};
use crate::proto::{AFP_SET, FOXGLOVE_SET};
use crate::recorder::{About, Item, Signal};
use crate::{event, foxglove};

/// Uncompressed bytes after which a chunk is closed.
const CHUNK: u64 = 256 * 1024;

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

/// A file of records. It need not be one that can go back: a pipe takes a log too.
pub(crate) type LogWriter = Writer<NoSeek<BufWriter<Output>>>;

/// Begins a file of records.
///
/// # Errors
/// The header cannot be written.
pub(crate) fn begin(output: Output, chunk: Option<u64>) -> Result<LogWriter, LogError> {
    let options = WriteOptions::new()
        .compression(Some(Compression::Lz4))
        .disable_seeking(true)
        .library(concat!("afp ", env!("CARGO_PKG_VERSION")));
    let options = match chunk {
        Some(bytes) => options.chunk_size(Some(bytes)),
        None => options,
    };
    Ok(options.create(NoSeek::new(BufWriter::new(output)))?)
}

/// Writes the index and what is left in memory; gives the file and its size in bytes.
///
/// # Errors
/// The disk is full or fails.
pub(crate) fn end(mut writer: LogWriter) -> Result<(Output, u64), LogError> {
    writer.finish()?;
    let mut file = writer.into_inner();
    let bytes = file.stream_position().map_err(mcap::McapError::from)?;
    let output = file.into_inner().into_inner();
    Ok((output.map_err(|failed| mcap::McapError::from(failed.into_error()))?, bytes))
}

/// A log that is being written, under its name with `.part` appended.
pub(crate) struct LogFile {
    writer: LogWriter,
    /// Those that every log has, then those of devices that have said something.
    channels: Vec<Channel>,
    /// Where the channel of a signal is among them; of a whole device where it has no name.
    signals: BTreeMap<(&'static str, &'static str), usize>,
    path: PathBuf,
    names: OwnedNames,
    entries: Vec<Entry>,
    /// The commit whose entries are being collected.
    commit: Option<(Instant, Author)>,
    buffer: Vec<u8>,
}

impl LogFile {
    pub(crate) fn create(path: &Path, about: &About, names: OwnedNames) -> Result<Self, LogError> {
        let failed = |error| LogError::Create { path: path.to_owned(), error };
        let writer = begin(Output::create(path).map_err(failed)?, Some(CHUNK))?;
        let unset = |id| event::entry(&names, TraceEntryId(id), afp_core::ValueRef::Unset);
        let entries = (0..names.entries()).map(unset).collect();
        let mut log = LogFile {
            writer,
            channels: Vec::new(),
            signals: BTreeMap::new(),
            path: path.to_owned(),
            names,
            entries,
            commit: None,
            buffer: Vec::new(),
        };
        log.describe(about)?;
        Ok(log)
    }

    /// Schemas, channels, what ran and from what text; all before the first message, so that a
    /// log cut short still has them.
    fn describe(&mut self, about: &About) -> Result<(), LogError> {
        for (topic, schema, set) in CHANNELS {
            self.open(topic, schema, set)?;
        }
        let metadata = about.facts.iter().cloned().collect();
        self.writer.write_metadata(&Metadata { name: "afp.run".into(), metadata })?;
        for (name, media_type, text) in &about.attachments {
            self.writer.attach(&Attachment {
                log_time: 0,
                create_time: 0,
                name: name.clone(),
                media_type: (*media_type).to_owned(),
                data: text.as_bytes().into(),
            })?;
        }
        self.send(Topic::Table, Instant::ZERO, &event::table(&self.names))?;
        self.flush()
    }

    /// Opens a channel; gives its position.
    fn open(&mut self, topic: &str, schema: &str, set: &[u8]) -> Result<usize, LogError> {
        let schema = self.writer.add_schema(schema, "protobuf", set)?;
        let id = self.writer.add_channel(schema, topic, "protobuf", &BTreeMap::new())?;
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
            Item::Lost { at, count } => self.lost(at, count),
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
            Item::End { facts, .. } => {
                let metadata = facts.into_iter().collect();
                Ok(self.writer.write_metadata(&Metadata { name: "afp.end".into(), metadata })?)
            }
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
        let time = at.as_nanos();
        let header = MessageHeader {
            channel_id: channel.id,
            sequence: channel.count,
            log_time: time,
            publish_time: time,
        };
        channel.count = channel.count.wrapping_add(1);
        Ok(self.writer.write_to_known_channel(&header, &self.buffer)?)
    }

    /// Closes the open chunk and hands it to the operating system.
    pub(crate) fn flush(&mut self) -> Result<(), LogError> {
        Ok(self.writer.flush()?)
    }

    /// Writes the index and, when the run ended in order, gives the log its name.
    ///
    /// `untold` records got lost after those that the log already mentions. Returns the file's
    /// path and its size in bytes.
    pub(crate) fn finish(
        mut self,
        in_order: bool,
        last: Instant,
        untold: u64,
    ) -> Result<(PathBuf, u64), LogError> {
        self.close_commit()?;
        if untold > 0 {
            self.lost(last, untold)?;
        }
        let (output, bytes) = end(self.writer)?;
        let part = output.path().to_owned();
        if !in_order {
            return Ok((part, bytes));
        }
        let failed = |error| LogError::Create { path: self.path.clone(), error };
        output.finish().map_err(failed)?;
        Ok((self.path, bytes))
    }
}
