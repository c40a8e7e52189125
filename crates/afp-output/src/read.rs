//! Files that others wrote: never read without a bound, since a name may stand for something without an end.

use std::fs::File;
use std::io::{Error, ErrorKind, Read};
use std::path::Path;

/// The greatest length of a file that is read, in bytes: what is longer is none of ours, or has no end.
const MOST: u64 = 64 << 20;

/// The bytes of a file.
///
/// # Errors
/// It cannot be read, or is longer than 64 MiB.
pub fn read_bytes(path: &Path) -> Result<Vec<u8>, Error> {
    let mut bytes = Vec::new();
    File::open(path)?.take(MOST + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > MOST {
        return Err(Error::new(ErrorKind::FileTooLarge, "it is longer than 64 MiB"));
    }
    Ok(bytes)
}

/// The text of a file.
///
/// # Errors
/// As [`read_bytes`]; it is no text in UTF-8.
pub fn read_text(path: &Path) -> Result<String, Error> {
    String::from_utf8(read_bytes(path)?)
        .map_err(|_| Error::new(ErrorKind::InvalidData, "it is no text in UTF-8"))
}
