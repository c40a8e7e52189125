//! Makes a whole log out of one that was cut short.

use std::collections::BTreeMap;
use std::fs::File;
use std::path::{Path, PathBuf};

use afp_output::Output;
use mcap::Attachment;
use mcap::records::Record;

use crate::error::LogError;
use crate::scan::{load, scan};
use crate::write::{LogWriter, begin, end};

/// What could be saved.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Recovered {
    /// The new log.
    pub path: PathBuf,
    /// Messages in it.
    pub messages: u64,
    /// Why the old one ended; `None` when nothing was wrong with it.
    pub damage: Option<String>,
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

/// Copies everything that is intact at the front of a log into a new, whole one.
///
/// # Errors
/// The old log cannot be opened, the new one cannot be written. There is no new one then.
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
    let mut copy = Copy::new(Output::create_beside_part(to).map_err(failed)?)?;
    let mut broken = None;
    let scanned = scan(&bytes, |record| {
        // A failed write must not pass for damage of the old log.
        copy.take(record).map_err(|error| {
            broken = Some(error);
            LogError::Writer
        })
    });
    if let Some(error) = broken {
        return Err(error);
    }
    let messages = copy.messages;
    let (output, _) = end(copy.writer)?;
    output.finish().map_err(failed)?;
    let damage = scanned.err().map(|error| error.to_string());
    Ok(Recovered { path: to.to_owned(), messages, damage })
}

struct Copy {
    writer: LogWriter,
    schemas: BTreeMap<u16, u16>,
    channels: BTreeMap<u16, u16>,
    messages: u64,
    over: bool,
}

impl Copy {
    fn new(output: Output) -> Result<Self, LogError> {
        let writer = begin(output, None)?;
        let (schemas, channels) = (BTreeMap::new(), BTreeMap::new());
        Ok(Copy { writer, schemas, channels, messages: 0, over: false })
    }

    fn take(&mut self, record: Record<'_>) -> Result<(), LogError> {
        match record {
            // What follows is the summary, which is made anew.
            Record::DataEnd(_) => self.over = true,
            _ if self.over => {}
            Record::Schema { header, data } => {
                let id = self.writer.add_schema(&header.name, &header.encoding, &data)?;
                self.schemas.insert(header.id, id);
            }
            Record::Channel(channel) => {
                let schema = self.schemas.get(&channel.schema_id).copied().unwrap_or(0);
                let (topic, encoding) = (&channel.topic, &channel.message_encoding);
                let id = self.writer.add_channel(schema, topic, encoding, &channel.metadata)?;
                self.channels.insert(channel.id, id);
            }
            Record::Message { mut header, data } => {
                // A message without a channel cannot be read by anybody.
                let Some(&id) = self.channels.get(&header.channel_id) else { return Ok(()) };
                header.channel_id = id;
                self.messages += 1;
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
}
