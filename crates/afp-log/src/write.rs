//! The file side of a log: the run, its sources, and its messages in chunks.

use std::collections::BTreeMap;
use std::io::{BufWriter, Seek};
use std::path::{Path, PathBuf};

use afp_core::Instant;
use afp_output::Output;
use mcap::records::{MessageHeader, Metadata};
use mcap::write::NoSeek;
use mcap::{Attachment, Compression, WriteOptions, Writer};

use crate::error::LogError;
use crate::messages::Messages;

/// The uncompressed size after which a chunk is closed.
const CHUNK: u64 = 256 * 1024;

/// The description of the run before its first message.
#[derive(Clone, Debug, Default)]
pub struct About {
    /// The metadata record `afp.run`: `plan`, `plan_hash`, `seed`, `world` and so on.
    pub facts: Vec<(String, String)>,
    /// Name, media type and text of each attachment.
    pub attachments: Vec<(String, &'static str, String)>,
}

/// A file of records. It need not be seekable: a pipe takes a log, too.
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

/// Writes the index and the rest; returns the file and its size in bytes.
pub(crate) fn end(mut writer: LogWriter) -> Result<(Output, u64), LogError> {
    writer.finish()?;
    let mut file = writer.into_inner();
    let bytes = file.stream_position().map_err(mcap::McapError::from)?;
    let output = file.into_inner().into_inner();
    Ok((output.map_err(|failed| mcap::McapError::from(failed.into_error()))?, bytes))
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
        let mut writer = begin(output, Some(CHUNK))?;
        let metadata = about.facts.iter().cloned().collect();
        writer.write_metadata(&Metadata { name: "afp.run".into(), metadata })?;
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
        Ok(self.writer.add_channel(schema, topic, "protobuf", &BTreeMap::new())?)
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
        Ok(self.writer.write_to_known_channel(&header, message)?)
    }

    fn came(&mut self, facts: Vec<(String, String)>) -> Result<(), LogError> {
        let metadata = facts.into_iter().collect();
        Ok(self.writer.write_metadata(&Metadata { name: "afp.end".into(), metadata })?)
    }

    /// Closes the open chunk and hands it to the operating system.
    fn flush(&mut self) -> Result<(), LogError> {
        Ok(self.writer.flush()?)
    }

    /// Writes the index and, if the run ended in order, gives the log its name.
    fn finish(self: Box<Self>, in_order: bool) -> Result<(PathBuf, u64), LogError> {
        let (output, bytes) = end(self.writer)?;
        let part = output.path().to_owned();
        if !in_order {
            return Ok((part, bytes));
        }
        let failed = |error| LogError::Create { path: self.path.clone(), error };
        output.finish().map_err(failed)?;
        Ok((self.path, bytes))
    }

    fn discard(self: Box<Self>) {
        if let Ok((output, _)) = end(self.writer) {
            output.discard();
        }
    }
}
