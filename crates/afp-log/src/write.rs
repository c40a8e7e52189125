//! The file side of a log: the run, its sources, and its messages in chunks.

mod writer;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use afp_core::Instant;
use afp_output::Output;
use mcap::Attachment;
use mcap::records::{Channel, MessageHeader, Metadata};

use crate::error::LogError;
use crate::messages::Messages;

pub(crate) use writer::LogWriter;

/// The description of the run before its first message.
#[derive(Clone, Debug, Default)]
pub struct About {
    /// The metadata record `afp.run`: `plan`, `plan_hash`, `seed`, `world` and so on.
    pub facts: Vec<(String, String)>,
    /// Name, media type and text of each attachment.
    pub attachments: Vec<(String, &'static str, String)>,
}

/// A log during writing; its name ends in `.part`.
pub(crate) struct LogFile {
    writer: LogWriter,
    path: PathBuf,
}

impl LogFile {
    /// Starts the file with the run's description and sources, so that a truncated log has them.
    /// Also returns the new path of an earlier, killed run's unfinished log.
    pub(crate) fn create(path: &Path, about: &About) -> Result<(Self, Option<PathBuf>), LogError> {
        let failed = |error| LogError::Create { path: path.to_owned(), error };
        let output = Output::create(path).map_err(failed)?;
        let kept = output.kept().map(Path::to_owned);
        let mut writer = LogWriter::begin(output)?;
        let metadata = about.facts.iter().cloned().collect();
        writer.add_metadata(&Metadata { name: "afp.run".into(), metadata })?;
        for (name, media_type, text) in &about.attachments {
            writer.attach(&Attachment {
                log_time: 0,
                create_time: 0,
                name: name.clone(),
                media_type: (*media_type).to_owned(),
                data: text.as_bytes().into(),
            })?;
        }
        Ok((LogFile { writer, path: path.to_owned() }, kept))
    }
}

impl Messages for LogFile {
    fn open(&mut self, topic: &str, schema: &str, set: &[u8]) -> Result<u16, LogError> {
        let schema = self.writer.add_schema(schema, "protobuf", set)?;
        Ok(self.writer.add_channel(&Channel {
            id: 0,
            schema_id: schema,
            topic: topic.to_owned(),
            message_encoding: "protobuf".to_owned(),
            metadata: BTreeMap::new(),
        })?)
    }

    fn send(
        &mut self,
        channel: u16,
        sequence: u32,
        at: Instant,
        message: &[u8],
    ) -> Result<(), LogError> {
        let time = at.as_nanos();
        let header =
            MessageHeader { channel_id: channel, sequence, log_time: time, publish_time: time };
        Ok(self.writer.add_message(&header, message)?)
    }

    fn came(&mut self, facts: Vec<(String, String)>) -> Result<(), LogError> {
        let metadata = facts.into_iter().collect();
        Ok(self.writer.add_metadata(&Metadata { name: "afp.end".into(), metadata })?)
    }

    /// Closes the open chunk and hands it to the operating system.
    fn flush(&mut self) -> Result<(), LogError> {
        Ok(self.writer.close_chunk()?)
    }

    /// Writes the index and, if the run ended in order, gives the log its name.
    fn finish(self: Box<Self>, in_order: bool) -> Result<(PathBuf, u64), LogError> {
        let (output, bytes) = self.writer.end()?;
        let part = output.path().to_owned();
        if !in_order {
            return Ok((part, bytes));
        }
        let failed = |error| LogError::Create { path: self.path.clone(), error };
        output.finish().map_err(failed)?;
        Ok((self.path, bytes))
    }

    fn discard(self: Box<Self>) {
        if let Ok((output, _)) = self.writer.end() {
            output.discard();
        }
    }
}
