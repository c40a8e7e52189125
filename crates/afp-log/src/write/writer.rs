//! An MCAP file, written from front to back in compressed chunks.
//!
//! `mcap` defines the records. Its own writer hands every field of a message to the compression,
//! which takes four times as long as compressing a collected chunk.

use std::collections::BTreeMap;
use std::io::{Cursor, Write};

use afp_output::Output;
use binrw::{BinWrite, BinWriterExt};
use crc32fast::Hasher;
use mcap::records::{
    AttachmentHeader, AttachmentIndex, Channel, ChunkHeader, ChunkIndex, DataEnd, Header,
    MessageHeader, Metadata, MetadataIndex, SchemaHeader, Statistics, SummaryOffset, op,
};
use mcap::{Attachment, MAGIC, McapError, McapResult};

/// The uncompressed size after which a chunk is closed.
const CHUNK: usize = 256 * 1024;
/// Half of an LZ4 block.
const HALF_BLOCK: usize = 32 * 1024;
const LIBRARY: &str = concat!("afp ", env!("CARGO_PKG_VERSION"));
/// The code and the length before a record's body.
const HEAD: usize = 9;
/// The head, the channel, the number and the two times of a message.
const MESSAGE_HEAD: usize = HEAD + 2 + 4 + 8 + 8;

/// A file of records. It need not be seekable: a pipe takes a log, too.
pub(crate) struct LogWriter {
    to: Output,
    /// The number of written bytes and their checksum.
    position: u64,
    data_crc: Hasher,
    /// The records of the open chunk; empty if no chunk is open.
    chunk: Vec<u8>,
    /// The first and the last time in the open chunk.
    bounds: Option<(u64, u64)>,
    /// The time and the offset of each message of the open chunk, by channel.
    messages: Vec<Vec<[u64; 2]>>,
    schemas: Numbered,
    channels: Numbered,
    /// The number of messages in closed chunks, by channel.
    counts: BTreeMap<u16, u64>,
    chunks: Vec<ChunkIndex>,
    attachments: Vec<AttachmentIndex>,
    metadata: Vec<MetadataIndex>,
}

/// Different schemas or channels, numbered from 1, without the numbers.
#[derive(Default)]
struct Numbered(BTreeMap<Vec<u8>, u16>);

impl LogWriter {
    /// Begins a file.
    ///
    /// # Errors
    /// The header cannot be written.
    pub fn begin(to: Output) -> McapResult<LogWriter> {
        let mut writer = LogWriter {
            to,
            position: 0,
            data_crc: Hasher::new(),
            chunk: Vec::new(),
            bounds: None,
            messages: Vec::new(),
            schemas: Numbered::default(),
            channels: Numbered::default(),
            counts: BTreeMap::new(),
            chunks: Vec::new(),
            attachments: Vec::new(),
            metadata: Vec::new(),
        };
        let mut head = MAGIC.to_vec();
        let header = Header { profile: String::new(), library: LIBRARY.to_owned() };
        put(&mut head, op::HEADER, &header, &[])?;
        writer.write(&head)?;
        Ok(writer)
    }

    /// Adds a schema and returns its number, or the number of an equal schema.
    pub fn add_schema(&mut self, name: &str, encoding: &str, data: &[u8]) -> McapResult<u16> {
        let (name, encoding) = (name.to_owned(), encoding.to_owned());
        let mut row = without_number(&SchemaHeader { id: 0, name, encoding })?;
        row.extend((data.len() as u32).to_le_bytes());
        row.extend(data);
        let number = self.schemas.add(row, op::SCHEMA, &mut self.chunk)?;
        number.ok_or(McapError::TooManySchemas)
    }

    /// Adds a channel and returns its number, or the number of an equal channel.
    pub fn add_channel(&mut self, channel: &Channel) -> McapResult<u16> {
        let row = without_number(channel)?;
        let number = self.channels.add(row, op::CHANNEL, &mut self.chunk)?;
        self.messages.resize_with(self.channels.0.len(), Vec::new);
        number.ok_or(McapError::TooManyChannels)
    }

    /// Adds a message to the open chunk.
    pub fn add_message(&mut self, header: &MessageHeader, data: &[u8]) -> McapResult<()> {
        let MessageHeader { channel_id, sequence, log_time, publish_time } = *header;
        if self.chunk.len() > CHUNK {
            self.close_chunk()?;
        }
        let index = usize::from(channel_id).checked_sub(1);
        let index = index.and_then(|index| self.messages.get_mut(index));
        let index = index.ok_or(McapError::UnknownChannel(sequence, channel_id))?;
        index.push([log_time, self.chunk.len() as u64]);
        let (first, last) = self.bounds.unwrap_or((log_time, log_time));
        self.bounds = Some((first.min(log_time), last.max(log_time)));
        let length = (MESSAGE_HEAD - HEAD + data.len()) as u64;
        let mut head = [op::MESSAGE; MESSAGE_HEAD];
        head[1..9].copy_from_slice(&length.to_le_bytes());
        head[9..11].copy_from_slice(&channel_id.to_le_bytes());
        head[11..15].copy_from_slice(&sequence.to_le_bytes());
        head[15..23].copy_from_slice(&log_time.to_le_bytes());
        head[23..31].copy_from_slice(&publish_time.to_le_bytes());
        self.chunk.extend_from_slice(&head);
        self.chunk.extend_from_slice(data);
        Ok(())
    }

    /// Writes a metadata record.
    pub fn add_metadata(&mut self, metadata: &Metadata) -> McapResult<()> {
        self.close_chunk()?;
        let mut record = Vec::new();
        put(&mut record, op::METADATA, metadata, &[])?;
        let (offset, length) = (self.position, record.len() as u64);
        self.metadata.push(MetadataIndex { offset, length, name: metadata.name.clone() });
        self.write(&record)
    }

    /// Writes an attachment.
    pub fn attach(&mut self, attachment: &Attachment<'_>) -> McapResult<()> {
        self.close_chunk()?;
        let Attachment { log_time, create_time, name, media_type, data } = attachment;
        let (log_time, create_time) = (*log_time, *create_time);
        let (name, media_type) = (name.clone(), media_type.clone());
        let data_size = data.len() as u64;
        let header = AttachmentHeader { log_time, create_time, name, media_type };
        let mut body = bytes(&header)?;
        body.extend(data_size.to_le_bytes());
        body.extend(&data[..]);
        body.extend(crc32fast::hash(&body).to_le_bytes());
        let mut record = Vec::new();
        put(&mut record, op::ATTACHMENT, &(), &body)?;
        let AttachmentHeader { name, media_type, .. } = header;
        let (offset, length) = (self.position, record.len() as u64);
        let index =
            AttachmentIndex { offset, length, log_time, create_time, data_size, name, media_type };
        self.attachments.push(index);
        self.write(&record)
    }

    /// Compresses and writes the open chunk, so that readers see all messages.
    pub fn close_chunk(&mut self) -> McapResult<()> {
        if self.chunk.is_empty() {
            return Ok(());
        }
        let data = compressed(&self.chunk)?;
        let (message_start_time, message_end_time) = self.bounds.take().unwrap_or((0, 0));
        let header = ChunkHeader {
            message_start_time,
            message_end_time,
            uncompressed_size: self.chunk.len() as u64,
            uncompressed_crc: crc32fast::hash(&self.chunk),
            compression: "lz4".to_owned(),
            compressed_size: data.len() as u64,
        };
        let mut records = Vec::with_capacity(2 * data.len());
        put(&mut records, op::CHUNK, &header, &data)?;
        let chunk_length = records.len() as u64;
        let mut message_index_offsets = BTreeMap::new();
        for (channel_id, entries) in (1..=u16::MAX).zip(&mut self.messages) {
            if entries.is_empty() {
                continue;
            }
            message_index_offsets.insert(channel_id, self.position + records.len() as u64);
            let count = entries.len();
            let mut index = Vec::with_capacity(4 + count * size_of::<[u64; 2]>());
            index.extend(((count * size_of::<[u64; 2]>()) as u32).to_le_bytes());
            index.extend(entries.drain(..).flatten().flat_map(u64::to_le_bytes));
            put(&mut records, op::MESSAGE_INDEX, &channel_id, &index)?;
            *self.counts.entry(channel_id).or_default() += count as u64;
        }
        self.chunks.push(ChunkIndex {
            message_start_time,
            message_end_time,
            chunk_start_offset: self.position,
            chunk_length,
            message_index_offsets,
            message_index_length: records.len() as u64 - chunk_length,
            compression: header.compression,
            compressed_size: header.compressed_size,
            uncompressed_size: header.uncompressed_size,
        });
        self.chunk.clear();
        self.write(&records)
    }

    /// Writes the summary; returns the file and its size in bytes.
    pub fn end(mut self) -> McapResult<(Output, u64)> {
        self.close_chunk()?;
        let mut end = Vec::new();
        let data_section_crc = self.data_crc.clone().finalize();
        put(&mut end, op::DATA_END, &DataEnd { data_section_crc }, &[])?;
        self.write(&end)?;
        let summary = self.summary()?;
        self.write(&summary)?;
        self.to.flush()?;
        Ok((self.to, self.position))
    }

    /// The summary, with the footer and the magic bytes.
    fn summary(&self) -> McapResult<Vec<u8>> {
        let (mut bytes, mut groups) = (Vec::new(), Vec::new());
        let mut group = |group_opcode: u8, records: Vec<u8>| {
            if !records.is_empty() {
                let group_start = self.position + bytes.len() as u64;
                let group_length = records.len() as u64;
                groups.push(SummaryOffset { group_opcode, group_start, group_length });
                bytes.extend(records);
            }
        };
        group(op::SCHEMA, self.schemas.records(op::SCHEMA)?);
        group(op::CHANNEL, self.channels.records(op::CHANNEL)?);
        group(op::STATISTICS, records(op::STATISTICS, &[self.statistics()])?);
        group(op::CHUNK_INDEX, records(op::CHUNK_INDEX, &self.chunks)?);
        group(op::ATTACHMENT_INDEX, records(op::ATTACHMENT_INDEX, &self.attachments)?);
        group(op::METADATA_INDEX, records(op::METADATA_INDEX, &self.metadata)?);
        let offsets = self.position + bytes.len() as u64;
        bytes.extend(records(op::SUMMARY_OFFSET, &groups)?);
        // The checksum in the footer includes the footer up to it.
        let footer = [self.position, offsets].map(u64::to_le_bytes);
        bytes.push(op::FOOTER);
        bytes.extend((footer.as_flattened().len() as u64 + 4).to_le_bytes());
        bytes.extend(footer.as_flattened());
        bytes.extend(crc32fast::hash(&bytes).to_le_bytes());
        bytes.extend(MAGIC);
        Ok(bytes)
    }

    fn statistics(&self) -> Statistics {
        let timed = || self.chunks.iter().filter(|chunk| !chunk.message_index_offsets.is_empty());
        Statistics {
            message_count: self.counts.values().sum(),
            schema_count: self.schemas.0.len() as u16,
            channel_count: self.channels.0.len() as u32,
            attachment_count: self.attachments.len() as u32,
            metadata_count: self.metadata.len() as u32,
            chunk_count: self.chunks.len() as u32,
            message_start_time: timed().map(|it| it.message_start_time).min().unwrap_or(0),
            message_end_time: timed().map(|it| it.message_end_time).max().unwrap_or(0),
            channel_message_counts: self.counts.clone(),
        }
    }

    fn write(&mut self, bytes: &[u8]) -> McapResult<()> {
        self.data_crc.update(bytes);
        self.position += bytes.len() as u64;
        Ok(self.to.write_all(bytes)?)
    }
}

impl Numbered {
    /// The number of a row; a new row is also added to a chunk. `None` if no number is free.
    fn add(&mut self, row: Vec<u8>, code: u8, chunk: &mut Vec<u8>) -> McapResult<Option<u16>> {
        if let Some(number) = self.0.get(&row) {
            return Ok(Some(*number));
        }
        let Ok(number) = u16::try_from(self.0.len() + 1) else { return Ok(None) };
        put(chunk, code, &number, &row)?;
        self.0.insert(row, number);
        Ok(Some(number))
    }

    /// All rows as records, by number.
    fn records(&self, code: u8) -> McapResult<Vec<u8>> {
        let mut rows: Vec<_> = self.0.iter().map(|(row, number)| (*number, row)).collect();
        rows.sort_unstable();
        let mut records = Vec::new();
        for (number, row) in rows {
            put(&mut records, code, &number, row)?;
        }
        Ok(records)
    }
}

/// One LZ4 frame, with the bytes of a frame to which every message was written separately: only
/// parts smaller than a block are collected. MCAP has a checksum of its own, so blocks have none.
fn compressed(bytes: &[u8]) -> McapResult<Vec<u8>> {
    let mut frame = lz4::EncoderBuilder::new()
        .block_checksum(lz4::liblz4::BlockChecksum::NoBlockChecksum)
        .build(Vec::with_capacity(bytes.len() / 2))?;
    bytes.chunks(HALF_BLOCK).try_for_each(|part| frame.write_all(part))?;
    let (frame, done) = frame.finish();
    Ok(done.map(|()| frame)?)
}

/// Appends a record: its code, its length, its body and its data.
fn put<T>(to: &mut Vec<u8>, code: u8, body: &T, data: &[u8]) -> McapResult<()>
where
    T: for<'a> BinWrite<Args<'a> = ()>,
{
    let body = bytes(body)?;
    to.push(code);
    to.extend(((body.len() + data.len()) as u64).to_le_bytes());
    to.extend(body);
    to.extend_from_slice(data);
    Ok(())
}

/// Several records of one kind.
fn records<T>(code: u8, bodies: &[T]) -> McapResult<Vec<u8>>
where
    T: for<'a> BinWrite<Args<'a> = ()>,
{
    let mut records = Vec::new();
    bodies.iter().try_for_each(|body| put(&mut records, code, body, &[]))?;
    Ok(records)
}

fn bytes<T>(body: &T) -> McapResult<Vec<u8>>
where
    T: for<'a> BinWrite<Args<'a> = ()>,
{
    let mut bytes = Cursor::new(Vec::new());
    bytes.write_le(body)?;
    Ok(bytes.into_inner())
}

/// The body of a schema or channel without its leading number.
fn without_number<T>(body: &T) -> McapResult<Vec<u8>>
where
    T: for<'a> BinWrite<Args<'a> = ()>,
{
    Ok(bytes(body)?.split_off(size_of::<u16>()))
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    fn header(channel_id: u16, n: u32) -> MessageHeader {
        let time = u64::from(n) * 1000;
        MessageHeader { channel_id, sequence: n, log_time: time, publish_time: time }
    }

    fn attachment() -> Attachment<'static> {
        let (name, media_type) = ("plan.afp".to_owned(), "text/plain".to_owned());
        Attachment { log_time: 0, create_time: 0, name, media_type, data: b"plan A {}".into() }
    }

    fn metadata(name: &str) -> Metadata {
        let metadata = [("seed".to_owned(), "7".to_owned())].into();
        Metadata { name: name.to_owned(), metadata }
    }

    fn channel(schema_id: u16, topic: &str) -> Channel {
        let (topic, message_encoding) = (topic.to_owned(), "protobuf".to_owned());
        Channel { id: 0, schema_id, topic, message_encoding, metadata: BTreeMap::new() }
    }

    /// Bytes that are neither equal nor random.
    fn data(n: u32) -> Vec<u8> {
        (0..n % 90).flat_map(|byte| (byte * n / 7).to_le_bytes()).collect()
    }

    #[test]
    fn the_file_has_the_bytes_that_mcap_writes() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("a.mcap");
        let mut ours = LogWriter::begin(Output::create(&path).unwrap()).unwrap();
        let options = mcap::WriteOptions::new()
            .compression(Some(mcap::Compression::Lz4))
            .disable_seeking(true)
            .chunk_size(Some(CHUNK as u64))
            .library(LIBRARY);
        let mut other = options.create(Cursor::new(Vec::new())).unwrap();
        ours.add_metadata(&metadata("afp.run")).unwrap();
        other.write_metadata(&metadata("afp.run")).unwrap();
        ours.attach(&attachment()).unwrap();
        other.attach(&attachment()).unwrap();
        for (schema, topic) in [("A", "/a"), ("B", "/b"), ("A", "/never"), ("B", "/b")] {
            let schema_id = ours.add_schema(schema, "protobuf", b"descriptors").unwrap();
            ours.add_channel(&channel(schema_id, topic)).unwrap();
            let schema_id = other.add_schema(schema, "protobuf", b"descriptors").unwrap();
            other.add_channel(schema_id, topic, "protobuf", &BTreeMap::new()).unwrap();
        }
        for n in 0..5000 {
            let header = header(1 + (n % 3 / 2) as u16, n);
            ours.add_message(&header, &data(n)).unwrap();
            other.write_to_known_channel(&header, &data(n)).unwrap();
            if n == 4000 {
                ours.close_chunk().unwrap();
                other.flush().unwrap();
            }
        }
        ours.add_metadata(&metadata("afp.end")).unwrap();
        other.write_metadata(&metadata("afp.end")).unwrap();
        let (output, size) = ours.end().unwrap();
        output.finish().unwrap();
        let chunks = other.finish().unwrap().chunk_indexes.len();
        let (ours, other) = (fs::read(&path).unwrap(), other.into_inner().into_inner());
        assert!(chunks > 3, "{chunks} chunks");
        assert_eq!((size, ours.len()), (other.len() as u64, other.len()));
        assert!(ours == other, "the same length, but other bytes");
    }

    #[test]
    fn a_message_needs_a_channel() {
        let dir = tempfile::tempdir().unwrap();
        let output = Output::create(&dir.path().join("a.mcap")).unwrap();
        let mut writer = LogWriter::begin(output).unwrap();
        for id in [0, 1] {
            let why = writer.add_message(&header(id, 7), b"").unwrap_err();
            assert!(matches!(why, McapError::UnknownChannel(7, _)), "{why}");
        }
    }
}
