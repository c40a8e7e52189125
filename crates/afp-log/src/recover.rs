//! Makes a whole log from a truncated or damaged log.

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
use crate::write::LogWriter;

/// Result of a recovery.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Recovered {
    /// The new log.
    pub path: PathBuf,
    /// Messages in it.
    pub messages: u64,
    /// The damage of the old log; `None` if it was intact.
    pub damage: Option<String>,
    /// The periods with lost messages.
    pub missing: Vec<Missing>,
}

/// A period with lost messages.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Missing {
    /// The last message before it; `None` at the beginning.
    pub after: Option<Instant>,
    /// The first message after it; `None` at the end.
    pub before: Option<Instant>,
}

/// The default name of a recovered log: `a.mcap.part` and `a.mcap` become `a.recovered.mcap`.
pub fn recovered_name(path: &Path) -> PathBuf {
    let bare = if path.extension().is_some_and(|ext| ext == "part") {
        path.with_extension("")
    } else {
        path.to_owned()
    };
    bare.with_extension("recovered.mcap")
}

/// The metadata record with the losses before the recovery.
pub(crate) const RECOVERED: &str = "afp.recovered";
/// Its key for the damage, and the prefix of the keys for the missing periods.
const DAMAGE: &str = "damage";
const MISSING: &str = "missing.";
/// The words for a period without a start or an end.
const START: &str = "start";
const END: &str = "end";

/// Copies all intact data of a log into a new, whole log, which also describes the missing data.
///
/// # Errors
/// The old log cannot be opened or has an unsupported compression, or the new log cannot be
/// written. Then there is no new log.
pub fn recover(from: &Path, to: &Path) -> Result<Recovered, LogError> {
    copy(from, to).map_err(|error| error.writing(to))
}

fn copy(from: &Path, to: &Path) -> Result<Recovered, LogError> {
    let bytes = load(from)?;
    // The old log may be the part file of the new one. A lock protects it from being overwritten;
    // without locks, its writer has ended.
    let old = File::open(from).map_err(|error| LogError::Open { path: from.to_owned(), error })?;
    let _ = old.try_lock_shared();
    let failed = |error| LogError::Create { path: to.to_owned(), error };
    // An intact summary has the channels and schemas of a damaged chunk.
    let summary = Summary::read(&bytes).ok().flatten();
    let output = Output::create_beside_part(to).map_err(failed)?;
    let mut copy = Copy::new(output, summary.as_ref())?;
    salvage(&bytes, summary.as_ref(), |record| match record {
        Ok(record) => copy.take(record),
        Err(damage) => copy.pass(damage),
    })?;
    let Copy { mut writer, messages, missing, mut damage, .. } = copy;
    // Damage outside of the copied records.
    damage = damage.or_else(|| scan(&bytes, |_| Ok(())).err().map(|why| why.to_string()));
    if let Some(damage) = &damage {
        writer.add_metadata(&told(damage, &missing))?;
    }
    let (output, _) = writer.end()?;
    output.finish().map_err(failed)?;
    Ok(Recovered { path: to.to_owned(), messages, damage, missing })
}

/// The description of the losses in a recovered log.
fn told(damage: &str, missing: &[Missing]) -> Metadata {
    let stretch = |(n, missing): (usize, &Missing)| (format!("{MISSING}{n}"), missing.written());
    let stretches = missing.iter().enumerate().map(stretch);
    let damage = (DAMAGE.to_owned(), damage.to_owned());
    Metadata { name: RECOVERED.to_owned(), metadata: stretches.chain([damage]).collect() }
}

/// The missing periods in the metadata record of a recovered log.
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
    last: Option<Instant>,
    damage: Option<String>,
    missing: Vec<Missing>,
}

impl<'a> Copy<'a> {
    fn new(output: Output, summary: Option<&'a Summary>) -> Result<Self, LogError> {
        let writer = LogWriter::begin(output)?;
        let (schemas, channels, missing) = (BTreeMap::new(), BTreeMap::new(), Vec::new());
        let (messages, last, damage) = (0, None, None);
        Ok(Copy { writer, summary, schemas, channels, messages, last, damage, missing })
    }

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
                // A message without a channel is unreadable.
                let Some(id) = self.channel(header.channel_id)? else { return Ok(()) };
                header.channel_id = id;
                self.messages += 1;
                let at = Instant::from_nanos(header.log_time);
                let open = self.missing.last_mut().filter(|last| last.before.is_none());
                open.into_iter().for_each(|last| last.before = Some(at));
                self.last = Some(at);
                self.writer.add_message(&header, &data)?;
            }
            Record::Metadata(metadata) => self.writer.add_metadata(&metadata)?,
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
        let new = records::Channel { schema_id: schema, ..channel.clone() };
        self.channels.insert(channel.id, self.writer.add_channel(&new)?);
        Ok(())
    }

    /// The new number of a channel, which may only be in the summary.
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

    /// The new number of a schema, which may only be in the summary.
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
