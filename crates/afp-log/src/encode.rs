//! Converts a run to messages, one method per kind.

use std::path::PathBuf;

use afp_core::trace::{Author, ComponentId, Names, Record, TraceEntryId, Verdict};
use afp_core::{Instant, Value};
use afp_session::{EventKind, OwnedRecord, RunEvent, author as author_of};
use prost::Message;

use crate::channels::{ALWAYS, CONFIGURATION, Channel, EVENTS, Key, Said, TABLE, fill, topic};
use crate::error::LogError;
use crate::event;
use crate::messages::Messages;
use crate::proto::afp::{Configuration, PlanEvent};

/// A message from the recorder to its writer.
pub(crate) enum Item {
    Record(OwnedRecord),
    Started(Instant),
    /// Items were dropped. The values of all entries follow, because commits may be lost.
    Lost {
        at: Instant,
        count: u64,
        entries: Box<[Value]>,
    },
    Said {
        at: Instant,
        said: Said,
    },
    Event(Box<RunEvent>),
    End {
        at: Instant,
        facts: Vec<(String, String)>,
    },
}

impl Item {
    pub(crate) fn at(&self) -> Option<Instant> {
        match self {
            Item::Record(owned) => Some(owned.at),
            Item::Event(event) => Some(event.at),
            Item::Started(at)
            | Item::Lost { at, .. }
            | Item::Said { at, .. }
            | Item::End { at, .. } => Some(*at),
        }
    }
}

#[derive(Clone, Copy, Debug)]
struct Open {
    id: u16,
    count: u32,
}

/// Converts the events of a run to messages.
pub(crate) struct Encoder {
    to: Box<dyn Messages>,
    /// The standard channels, and those of devices with samples. The most frequent channels come
    /// first.
    channels: Vec<(Key, Open)>,
    names: Box<dyn Names + Send>,
    /// The values of all entries.
    configuration: Configuration,
    /// The messages of polls without an event, by supervisor, without their time; empty until used.
    polls: Vec<Vec<u8>>,
    /// The commit whose entries are being collected.
    commit: Option<(Instant, Author)>,
    buffer: Vec<u8>,
}

impl Encoder {
    /// Opens the standard channels and writes the plan's table.
    ///
    /// # Errors
    /// The disk is full or fails.
    pub(crate) fn new(
        to: Box<dyn Messages>,
        names: Box<dyn Names + Send>,
    ) -> Result<Self, LogError> {
        let unset = |id| event::entry(&*names, TraceEntryId(id), afp_core::ValueRef::Unset);
        let entries = (0..names.entries()).map(unset).collect();
        let configuration = Configuration { entries, ..Configuration::default() };
        let polls = vec![Vec::new(); names.components() as usize];
        let (channels, commit, buffer) = (Vec::new(), None, Vec::new());
        let mut log = Encoder { to, channels, names, configuration, polls, commit, buffer };
        for channel in ALWAYS {
            log.open(channel)?;
        }
        log.send(TABLE, Instant::ZERO, &event::table(&*log.names))?;
        log.flush()?;
        Ok(log)
    }

    /// Opens a channel if it is new.
    fn open(&mut self, (key, schema, set): Channel) -> Result<&mut Open, LogError> {
        let known = self.channels.iter().position(|(known, _)| *known == key);
        let place = match known {
            Some(place) => place,
            None => {
                let id = self.to.open(&topic(key), schema, set)?;
                self.channels.push((key, Open { id, count: 0 }));
                self.channels.len() - 1
            }
        };
        self.channels.get_mut(place).map(|(_, open)| open).ok_or(LogError::Writer)
    }

    pub(crate) fn write(&mut self, item: Item) -> Result<(), LogError> {
        match item {
            Item::Record(owned) => self.record(owned.at, &owned.get()),
            Item::Event(event) => {
                self.close_commit()?;
                self.send(EVENTS, event.at, &event::message(*event))
            }
            Item::Started(at) => self.configuration(at, String::new()),
            Item::Lost { at, count, entries } => {
                self.lost(at, count)?;
                self.set_all(at, &entries)
            }
            Item::Said { at, said } => {
                let channel = said.channel();
                said.encode(at, &mut self.buffer);
                self.send_buffer(channel, at)
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
            Record::Polled { supervisor, verdict: Verdict::Clear } => {
                self.close_commit()?;
                if (supervisor.0 as usize) < self.polls.len() {
                    return self.clear_poll(at, supervisor, record);
                }
            }
            _ => self.close_commit()?,
        }
        let event = RunEvent::new(at, record, &*self.names);
        self.send(EVENTS, at, &event::message(event))
    }

    /// Writes a poll without an event, which most records are: only its time is new.
    fn clear_poll(
        &mut self,
        at: Instant,
        supervisor: ComponentId,
        record: &Record<'_>,
    ) -> Result<(), LogError> {
        let Some(poll) = self.polls.get_mut(supervisor.0 as usize) else { return Ok(()) };
        if poll.is_empty() {
            let event = event::message(RunEvent::new(at, record, &*self.names));
            *poll = PlanEvent { time: None, ..event }.encode_to_vec();
        }
        // Joined messages have the fields of both, and the time is the first field.
        let time = PlanEvent { time: Some(event::timestamp(at)), ..PlanEvent::default() };
        fill(&mut self.buffer, &time);
        self.buffer.extend_from_slice(poll);
        self.send_buffer(EVENTS, at)
    }

    fn set(&mut self, entry: TraceEntryId, value: afp_core::ValueRef<'_>) {
        let new = event::entry(&*self.names, entry, value);
        if let Some(kept) = self.configuration.entries.get_mut(entry.0 as usize) {
            *kept = new;
        }
    }

    /// Replaces the values of all entries and writes them: commits are missing, perhaps parts of
    /// the open one.
    fn set_all(&mut self, at: Instant, values: &[Value]) -> Result<(), LogError> {
        self.commit = None;
        for (id, value) in (0..).zip(values) {
            self.set(TraceEntryId(id), value.as_deref());
        }
        self.configuration(at, String::new())
    }

    fn close_commit(&mut self) -> Result<(), LogError> {
        match self.commit.take() {
            None => Ok(()),
            Some((at, author)) => self.configuration(at, author_of(&*self.names, author)),
        }
    }

    fn configuration(&mut self, at: Instant, author: String) -> Result<(), LogError> {
        self.configuration.time = Some(event::timestamp(at));
        self.configuration.author = author;
        fill(&mut self.buffer, &self.configuration);
        self.send_buffer(CONFIGURATION, at)
    }

    fn lost(&mut self, at: Instant, count: u64) -> Result<(), LogError> {
        let lost = RunEvent { at, kind: EventKind::Lost(count), ..RunEvent::default() };
        self.send(EVENTS, at, &event::message(lost))
    }

    fn send(&mut self, to: Channel, at: Instant, message: &impl Message) -> Result<(), LogError> {
        fill(&mut self.buffer, message);
        self.send_buffer(to, at)
    }

    fn send_buffer(&mut self, to: Channel, at: Instant) -> Result<(), LogError> {
        let channel = self.open(to)?;
        let (id, sequence) = (channel.id, channel.count);
        channel.count = sequence.wrapping_add(1);
        self.to.send(id, sequence, at, &self.buffer)
    }

    pub(crate) fn flush(&mut self) -> Result<(), LogError> {
        self.to.flush()
    }

    /// Reports the last losses and ends.
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

    pub(crate) fn discard(self) {
        self.to.discard();
    }
}
