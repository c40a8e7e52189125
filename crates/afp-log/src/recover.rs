//! Makes a whole log out of one that was cut short or is damaged.

use std::collections::BTreeMap;
use std::fmt;
use std::fs::File;
use std::path::{Path, PathBuf};

use afp_core::Instant;
use afp_output::Output;
use mcap::records::{self, Metadata, Record};
use mcap::{Attachment, Summary};

use crate::error::LogError;
use crate::scan::{Damage, load, salvage, scan};
use crate::write::{LogWriter, begin, end};

/// What could be saved.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Recovered {
    /// The new log.
    pub path: PathBuf,
    /// Messages in it.
    pub messages: u64,
    /// What is wrong with the old one; `None` when nothing was.
    pub damage: Option<String>,
    /// The stretches of time of which messages are lost.
    pub missing: Vec<Missing>,
}

/// A stretch of time of which messages are lost.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Missing {
    /// The last message before it; none from the beginning on.
    pub after: Option<Instant>,
    /// The first message behind it; none up to the end.
    pub before: Option<Instant>,
}

/// The name of the log that [`recover`] makes by default: `a.mcap.part` and `a.mcap` become
/// `a.recovered.mcap`.
pub fn recovered_name(path: &Path) -> PathBuf {
    let bare = if path.extension().is_some_and(|ext| ext == "part") {
        path.with_extension("")
    } else {
        path.to_owned()
    };
    bare.with_extension("recovered.mcap")
}

/// The metadata record that says what a log has lost before it was recovered.
pub(crate) const RECOVERED: &str = "afp.recovered";
/// Its key that says what was wrong, and what the ones begin with of the stretches that are missing.
const DAMAGE: &str = "damage";
const MISSING: &str = "missing.";
/// What stands there in place of a time where nothing is left before the stretch, or behind it.
const START: &str = "start";
const END: &str = "end";

/// Copies everything that is intact in a log into a new, whole one, which says what is missing from it.
///
/// # Errors
/// The old log cannot be opened or is compressed in a way that cannot be read, the new one cannot be written. There is no new one then.
pub fn recover(from: &Path, to: &Path) -> Result<Recovered, LogError> {
    copy(from, to).map_err(|error| error.writing(to))
}

fn copy(from: &Path, to: &Path) -> Result<Recovered, LogError> {
    let bytes = load(from)?;
    // The old log may be the part of the new one. A lock keeps it from being written over; where
    // there are no locks, the one who makes it is done with it.
    let old = File::open(from).map_err(|error| LogError::Open { path: from.to_owned(), error })?;
    let _ = old.try_lock_shared();
    let failed = |error| LogError::Create { path: to.to_owned(), error };
    // Where a summary is intact it knows what a damaged chunk has said of later ones.
    let summary = Summary::read(&bytes).ok().flatten();
    let output = Output::create_beside_part(to).map_err(failed)?;
    let mut copy = Copy::new(output, summary.as_ref())?;
    salvage(&bytes, summary.as_ref(), |record| match record {
        Ok(record) => copy.take(record),
        Err(damage) => copy.pass(damage),
    })?;
    let Copy { mut writer, messages, missing, mut damage, .. } = copy;
    // What is wrong outside of what was copied.
    damage = damage.or_else(|| scan(&bytes, |_| Ok(())).err().map(|why| why.to_string()));
    if let Some(damage) = &damage {
        writer.write_metadata(&told(damage, &missing))?;
    }
    let (output, _) = end(writer)?;
    output.finish().map_err(failed)?;
    Ok(Recovered { path: to.to_owned(), messages, damage, missing })
}

/// What a recovered log says of what it has lost.
fn told(damage: &str, missing: &[Missing]) -> Metadata {
    let stretch = |(n, missing): (usize, &Missing)| (format!("{MISSING}{n}"), missing.written());
    let stretches = missing.iter().enumerate().map(stretch);
    let damage = (DAMAGE.to_owned(), damage.to_owned());
    Metadata { name: RECOVERED.to_owned(), metadata: stretches.chain([damage]).collect() }
}

/// The stretches of time that are missing, as the metadata record of a recovered log says.
pub(crate) fn missing(told: &BTreeMap<String, String>) -> impl Iterator<Item = Missing> {
    let stretches = told.iter().filter(|(key, _)| key.starts_with(MISSING));
    stretches.filter_map(|(_, stretch)| Missing::read(stretch))
}

struct Copy<'a> {
    writer: LogWriter,
    summary: Option<&'a Summary>,
    schemas: BTreeMap<u16, u16>,
    channels: BTreeMap<u16, u16>,
    messages: u64,
    /// When the last message was.
    last: Option<Instant>,
    /// The first thing that is wrong.
    damage: Option<String>,
    missing: Vec<Missing>,
}

impl<'a> Copy<'a> {
    fn new(output: Output, summary: Option<&'a Summary>) -> Result<Self, LogError> {
        let writer = begin(output, None)?;
        let (schemas, channels, missing) = (BTreeMap::new(), BTreeMap::new(), Vec::new());
        let (messages, last, damage) = (0, None, None);
        Ok(Copy { writer, summary, schemas, channels, messages, last, damage, missing })
    }

    /// Passes over what is damaged.
    fn pass(&mut self, Damage { why, messages }: Damage) -> Result<(), LogError> {
        if let LogError::Compressed(_) = why {
            return Err(why);
        }
        let goes_on = self.missing.last().is_some_and(|last| last.before.is_none());
        if messages && !goes_on {
            self.missing.push(Missing { after: self.last, before: None });
        }
        self.damage.get_or_insert_with(|| why.to_string());
        Ok(())
    }

    fn take(&mut self, record: Record<'_>) -> Result<(), LogError> {
        match record {
            Record::Schema { header, data } => {
                let id = self.writer.add_schema(&header.name, &header.encoding, &data)?;
                self.schemas.insert(header.id, id);
            }
            Record::Channel(channel) => self.add_channel(&channel)?,
            Record::Message { mut header, data } => {
                // A message without a channel cannot be read by anybody.
                let Some(id) = self.channel(header.channel_id)? else { return Ok(()) };
                header.channel_id = id;
                self.messages += 1;
                let at = Instant::from_nanos(header.log_time);
                let open = self.missing.last_mut().filter(|last| last.before.is_none());
                open.into_iter().for_each(|last| last.before = Some(at));
                self.last = Some(at);
                self.writer.write_to_known_channel(&header, &data)?;
            }
            Record::Metadata(metadata) => self.writer.write_metadata(&metadata)?,
            Record::Attachment { header, data, .. } => self.writer.attach(&Attachment {
                log_time: header.log_time,
                create_time: header.create_time,
                name: header.name,
                media_type: header.media_type,
                data,
            })?,
            _ => {}
        }
        Ok(())
    }

    fn add_channel(&mut self, channel: &records::Channel) -> Result<(), LogError> {
        let schema = self.schema(channel.schema_id)?;
        let (topic, encoding) = (&channel.topic, &channel.message_encoding);
        let id = self.writer.add_channel(schema, topic, encoding, &channel.metadata)?;
        self.channels.insert(channel.id, id);
        Ok(())
    }

    /// The new number of a channel, which only the summary may know.
    fn channel(&mut self, id: u16) -> Result<Option<u16>, LogError> {
        let known = self.summary.and_then(|summary| summary.channels.get(&id));
        if let Some(channel) = known.filter(|_| !self.channels.contains_key(&id)) {
            self.add_channel(&records::Channel {
                id,
                schema_id: channel.schema.as_ref().map_or(0, |schema| schema.id),
                topic: channel.topic.clone(),
                message_encoding: channel.message_encoding.clone(),
                metadata: channel.metadata.clone(),
            })?;
        }
        Ok(self.channels.get(&id).copied())
    }

    /// The new number of a schema, which only the summary may know.
    fn schema(&mut self, id: u16) -> Result<u16, LogError> {
        let known = self.summary.and_then(|summary| summary.schemas.get(&id));
        if let Some(schema) = known.filter(|_| !self.schemas.contains_key(&id)) {
            let new = self.writer.add_schema(&schema.name, &schema.encoding, &schema.data)?;
            self.schemas.insert(id, new);
        }
        Ok(self.schemas.get(&id).copied().unwrap_or(0))
    }
}

impl Missing {
    /// As a log has it: both ends in nanoseconds.
    fn written(self) -> String {
        let time = |at: Option<Instant>, none: &str| {
            at.map_or_else(|| none.to_owned(), |at| at.as_nanos().to_string())
        };
        format!("{} {}", time(self.after, START), time(self.before, END))
    }

    fn read(text: &str) -> Option<Missing> {
        let time = |text: &str, none: &str| match text == none {
            true => Some(None),
            false => Some(Some(Instant::from_nanos(text.parse().ok()?))),
        };
        let (after, before) = text.split_once(' ')?;
        Some(Missing { after: time(after, START)?, before: time(before, END)? })
    }
}

impl fmt::Display for Missing {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.after {
            Some(after) => write!(f, "from {:.3} s", after.as_secs_f64())?,
            None => f.write_str("from the start")?,
        }
        match self.before {
            Some(before) => write!(f, " to {:.3} s", before.as_secs_f64()),
            None => f.write_str(" to the end"),
        }
    }
}
