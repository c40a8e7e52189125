//! Reads the records of an MCAP file, unpacks chunks and verifies all checksums.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::Read;
use std::path::Path;

use mcap::records::{ChunkIndex, Record, op};
use mcap::sans_io::linear_reader::{LinearReadEvent, LinearReader, LinearReaderOptions};
use mcap::{McapError, Summary, parse_record};

use crate::error::LogError;

/// The maximum length of a record or chunk: a damaged length must not exhaust the memory.
const LONGEST: usize = 256 * 1024 * 1024;

/// The bytes of an MCAP file.
///
/// # Errors
/// The file cannot be read, or does not begin like one.
pub(crate) fn load(path: &Path) -> Result<Vec<u8>, LogError> {
    let failed = |error| LogError::Open { path: path.to_owned(), error };
    let mut file = File::open(path).map_err(failed)?;
    let mut bytes = Vec::new();
    // A log may be long, but an endless file is rejected by its first bytes.
    (&mut file).take(mcap::MAGIC.len() as u64).read_to_end(&mut bytes).map_err(failed)?;
    if bytes != mcap::MAGIC {
        return Err(LogError::NotALog { path: path.to_owned() });
    }
    file.read_to_end(&mut bytes).map_err(failed)?;
    Ok(bytes)
}

/// Passes every record to `take`, in order, until the file ends, is damaged, or `take` fails.
///
/// # Errors
/// The damage, or the error of `take`.
pub(crate) fn scan(
    bytes: &[u8],
    take: impl FnMut(Record<'_>) -> Result<(), LogError>,
) -> Result<(), LogError> {
    let options = LinearReaderOptions::default()
        .with_validate_data_section_crc(true)
        .with_validate_summary_section_crc(true);
    walk(options, bytes, take)
}

fn walk(
    options: LinearReaderOptions,
    bytes: &[u8],
    mut take: impl FnMut(Record<'_>) -> Result<(), LogError>,
) -> Result<(), LogError> {
    let options = options.with_prevalidate_chunk_crcs(true).with_record_length_limit(LONGEST);
    let mut reader = LinearReader::new_with_options(options);
    let mut rest = bytes;
    while let Some(event) = reader.next_event() {
        match event? {
            LinearReadEvent::ReadRequest(wanted) => {
                let (now, later) = rest.split_at(wanted.min(rest.len()));
                reader.insert(now.len())[..now.len()].copy_from_slice(now);
                reader.notify_read(now.len());
                rest = later;
            }
            LinearReadEvent::Record { data, opcode } => {
                if opcode == op::ATTACHMENT && !has_head(data) {
                    return Err(McapError::UnexpectedEof.into());
                }
                take(parse_record(opcode, data)?)?;
            }
        }
    }
    Ok(())
}

fn of_part() -> LinearReaderOptions {
    LinearReaderOptions::default().with_skip_start_magic(true).with_skip_end_magic(true)
}

/// Whether an index entry points to a readable chunk.
pub(crate) fn leads_to_chunk(bytes: &[u8], index: &ChunkIndex) -> bool {
    let place = |at: u64| usize::try_from(at).ok();
    let end = index.chunk_start_offset.checked_add(index.chunk_length).and_then(place);
    let record =
        place(index.chunk_start_offset).zip(end).and_then(|(from, to)| bytes.get(from..to));
    let chunk = record.filter(|record| record.first() == Some(&op::CHUNK));
    chunk.is_some_and(|chunk| walk(of_part(), chunk, |_| Ok(())).is_ok())
}

/// The bytes after the end of a log; empty if it has no end.
pub(crate) fn behind(bytes: &[u8]) -> &[u8] {
    let mut at = mcap::MAGIC.len();
    while let Some((code, record)) = bytes.get(at..).and_then(record) {
        at += record.len();
        if code == op::FOOTER {
            return bytes.get(at + mcap::MAGIC.len()..).unwrap_or_default();
        }
    }
    &[]
}

/// Whether the head of an attachment is complete: two times, two names, its length. The parser
/// relies on it.
fn has_head(attachment: &[u8]) -> bool {
    let name = |at: usize| {
        let (length, _) = attachment.get(at..)?.split_first_chunk()?;
        (at + 4).checked_add(usize::try_from(u32::from_le_bytes(*length)).ok()?)
    };
    let (lengths, checksum) = (8, 4);
    let head = name(16).and_then(name).and_then(|at| at.checked_add(lengths + checksum));
    head.is_some_and(|head| head <= attachment.len())
}

/// Passes every intact record of the data section to `take`, in order, until it fails. For damaged
/// data, `take` gets the reason and whether messages may be lost.
///
/// # Errors
/// The error of `take`.
pub(crate) fn salvage(
    bytes: &[u8],
    summary: Option<&Summary>,
    mut take: impl FnMut(Result<Record<'_>, Damage>) -> Result<(), LogError>,
) -> Result<(), LogError> {
    let mut chunks = summary.map(chunks).unwrap_or_default();
    // A summary may belong to a longer file.
    chunks.retain(|begin, length| begin.saturating_add(*length) <= bytes.len());
    let mut at = mcap::MAGIC.len();
    loop {
        let next = chunks.range(at + 1..).next().map(|(next, _)| *next);
        let Some((code, record)) = framed(&bytes[at..next.unwrap_or(bytes.len())], chunks.get(&at))
        else {
            let why = McapError::UnexpectedEof.into();
            take(Err(Damage { why, messages: chunks.contains_key(&at) || next.is_none() }))?;
            // Only the summary has the start of the next chunk.
            let Some(next) = next else { return Ok(()) };
            at = next;
            continue;
        };
        if code == op::DATA_END {
            return Ok(());
        }
        let mut refused = None;
        let walked = walk(of_part(), record, |record| {
            take(Ok(record)).map_err(|why| {
                refused = Some(why);
                LogError::Writer
            })
        });
        match (refused, walked) {
            (Some(why), _) => return Err(why),
            (None, Err(why)) => take(Err(Damage { why, messages: code == op::CHUNK }))?,
            (None, Ok(())) => {}
        }
        at += record.len();
    }
}

/// Damage in a log.
#[derive(Debug)]
pub(crate) struct Damage {
    pub why: LogError,
    pub messages: bool,
}

fn chunks(summary: &Summary) -> BTreeMap<usize, usize> {
    let place = |chunk: &ChunkIndex| {
        let begin = usize::try_from(chunk.chunk_start_offset).ok()?;
        Some((begin, usize::try_from(chunk.chunk_length).ok()?))
    };
    summary.chunk_indexes.iter().filter_map(place).collect()
}

/// The first record of some bytes with its code, or a chunk of the given length. `None` if its head
/// is damaged or its end is missing.
fn framed<'a>(bytes: &'a [u8], chunk: Option<&usize>) -> Option<(u8, &'a [u8])> {
    let (code, whole) = record(bytes)?;
    let is_known = (op::HEADER..=op::DATA_END).contains(&code) || code >= 0x80;
    let fits = chunk.is_none_or(|length| code == op::CHUNK && *length == whole.len());
    (is_known && fits).then_some((code, whole))
}

/// The first record of some bytes with its code; `None` if its end is missing.
fn record(bytes: &[u8]) -> Option<(u8, &[u8])> {
    let (head, _) = bytes.split_first_chunk::<9>()?;
    let (code, length) = (head[0], u64::from_le_bytes(head[1..].try_into().ok()?));
    Some((code, bytes.get(..usize::try_from(length).ok()?.checked_add(head.len())?)?))
}
