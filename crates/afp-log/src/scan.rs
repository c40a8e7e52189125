//! Walks over the records of an MCAP file, chunks unpacked and all checksums verified.

use std::fs::File;
use std::io::Read;
use std::path::Path;

use mcap::parse_record;
use mcap::records::Record;
use mcap::sans_io::linear_reader::{LinearReadEvent, LinearReader, LinearReaderOptions};

use crate::error::LogError;

/// The longest record or chunk that a file may claim: a damaged length must not eat the memory.
const LONGEST: usize = 256 * 1024 * 1024;

/// The bytes of an MCAP file.
///
/// # Errors
/// It cannot be read, or does not begin like one.
pub(crate) fn load(path: &Path) -> Result<Vec<u8>, LogError> {
    let failed = |error| LogError::Open { path: path.to_owned(), error };
    let mut file = File::open(path).map_err(failed)?;
    let mut bytes = Vec::new();
    // A log may be long; what has no end does not begin like one.
    (&mut file).take(mcap::MAGIC.len() as u64).read_to_end(&mut bytes).map_err(failed)?;
    if bytes != mcap::MAGIC {
        return Err(LogError::NotALog { path: path.to_owned() });
    }
    file.read_to_end(&mut bytes).map_err(failed)?;
    Ok(bytes)
}

/// Hands every record to `take`, in order, until the file ends, is damaged, or `take` fails.
///
/// # Errors
/// The damage, or what `take` says.
pub(crate) fn scan(
    bytes: &[u8],
    mut take: impl FnMut(Record<'_>) -> Result<(), LogError>,
) -> Result<(), LogError> {
    let options = LinearReaderOptions::default()
        .with_prevalidate_chunk_crcs(true)
        .with_validate_data_section_crc(true)
        .with_validate_summary_section_crc(true)
        .with_record_length_limit(LONGEST);
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
            LinearReadEvent::Record { data, opcode } => take(parse_record(opcode, data)?)?,
        }
    }
    Ok(())
}
