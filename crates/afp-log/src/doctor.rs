//! Finds errors in logs.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use mcap::Summary;
use mcap::records::{MessageHeader, Record, Statistics};

use crate::error::LogError;
use crate::read::read_all;
use crate::scan::{behind, leads_to_chunk, load, scan};

/// All errors in a log.
///
/// # Errors
/// The file cannot be opened, or is not an MCAP file.
pub fn doctor(path: &Path) -> Result<Vec<String>, LogError> {
    let bytes = load(path)?;
    let mut doctor = Doctor::default();
    let scanned = scan(&bytes, |record| {
        doctor.look(record);
        Ok(())
    });
    // Reading decodes AFP's own messages and finds why a log was cut short. Data that was lost
    // before a recovery is not an error of the file.
    let (log, _) = read_all(path)?;
    let lost = log.lost();
    match (log.cut_short, scanned) {
        (Some(cut), _) => doctor.found.push(cut),
        (None, Err(error)) => doctor.found.push(error.to_string()),
        (None, Ok(())) => doctor.compare(),
    }
    doctor.find_index(&bytes);
    match behind(&bytes) {
        [] => {}
        rest if rest.starts_with(mcap::MAGIC) => {
            doctor
                .found
                .push("another log follows its end; readers see only one of them".to_owned());
        }
        rest => {
            let count = rest.len();
            doctor.found.push(format!("{count} extra bytes follow its end"));
        }
    }
    if lost > 0 {
        doctor.found.push(format!("{lost} records were lost while it was written"));
    }
    if !doctor.has_facts {
        doctor.found.push("it has no metadata record 'afp.run'".to_owned());
    }
    Ok(doctor.found)
}

#[derive(Default)]
struct Doctor {
    found: Vec<String>,
    schemas: BTreeSet<u16>,
    channels: BTreeMap<u16, Channel>,
    messages: u64,
    chunks: u64,
    statistics: Option<Statistics>,
    /// Whether the run's metadata record was seen, even if empty.
    has_facts: bool,
}

#[derive(Default)]
struct Channel {
    topic: String,
    last: u64,
    messages: u64,
    went_back: bool,
}

impl Doctor {
    fn look(&mut self, record: Record<'_>) {
        match record {
            Record::Header(header) if header.library.is_empty() => {
                self.found.push("its header does not name a library".to_owned());
            }
            Record::Schema { header, .. } => {
                if header.id == 0 {
                    self.found.push(format!("schema '{}' has the id 0", header.name));
                }
                self.schemas.insert(header.id);
            }
            Record::Channel(channel) => {
                let (id, topic, schema) = (channel.id, channel.topic, channel.schema_id);
                if schema != 0 && !self.schemas.contains(&schema) {
                    self.found.push(format!("channel {topic} names schema {schema}, unknown"));
                }
                self.channels.entry(id).or_insert(Channel { topic, ..Channel::default() });
            }
            Record::Message { header, .. } => self.message(&header),
            Record::Metadata(metadata) => self.has_facts |= metadata.name == "afp.run",
            Record::ChunkIndex(_) => self.chunks += 1,
            Record::Statistics(statistics) => self.statistics = Some(statistics),
            _ => {}
        }
    }

    fn message(&mut self, header: &MessageHeader) {
        self.messages += 1;
        let Some(channel) = self.channels.get_mut(&header.channel_id) else {
            let id = header.channel_id;
            self.found.push(format!("a message comes before its channel {id}"));
            return;
        };
        channel.messages += 1;
        if header.log_time < channel.last && !channel.went_back {
            channel.went_back = true;
            self.found.push(format!("time goes back on {}", channel.topic));
        }
        channel.last = header.log_time;
    }

    /// Reports the data that indexed readers would miss.
    fn find_index(&mut self, bytes: &[u8]) {
        // A missing or unreadable summary was already reported.
        let Ok(Some(summary)) = Summary::read(bytes) else { return };
        let indexes = summary.chunk_indexes.iter();
        let count = indexes.filter(|index| !leads_to_chunk(bytes, index)).count();
        if count > 0 {
            self.found.push(format!("its index leads to {count} chunks that cannot be read"));
        }
    }

    /// Compares the summary with the file's contents.
    fn compare(&mut self) {
        let Some(statistics) = &self.statistics else {
            self.found.push("it has no statistics".to_owned());
            return;
        };
        let (told, messages) = (statistics.message_count, self.messages);
        if told != messages {
            self.found.push(format!("its summary counts {told} messages, it holds {messages}"));
        }
        let (told, chunks) = (u64::from(statistics.chunk_count), self.chunks);
        if told != chunks {
            self.found.push(format!("its summary counts {told} chunks, its index {chunks}"));
        }
        for (id, channel) in &self.channels {
            let told = statistics.channel_message_counts.get(id).copied().unwrap_or(0);
            if told != channel.messages {
                let Channel { topic, messages, .. } = channel;
                self.found.push(format!(
                    "its summary counts {told} messages on {topic}, it holds {messages}"
                ));
            }
        }
    }
}
