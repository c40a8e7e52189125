//! Bounded reading of input files: a name may refer to an endless stream.

use std::fs::File;
use std::io::{Error, ErrorKind, Read};
use std::path::Path;

/// The maximum length of an input file, in bytes.
const MOST: u64 = 64 << 20;

/// The bytes of a file that the user named; a pipe waits for its writer.
///
/// # Errors
/// The file cannot be read, or is longer than 64 MiB.
pub fn read_bytes(path: &Path) -> Result<Vec<u8>, Error> {
    bounded(File::open(path)?, MOST)
}

/// The bytes of a file that another file refers to, or that was found in a folder: a regular file.
///
/// # Errors
/// It is a folder ([`ErrorKind::IsADirectory`]), a pipe or a device ([`ErrorKind::InvalidInput`]),
/// cannot be read, or is longer than `most` bytes ([`ErrorKind::FileTooLarge`]).
pub fn read_file(path: &Path, most: u64) -> Result<Vec<u8>, Error> {
    // Opening a pipe waits, so the type is checked first.
    let about = std::fs::metadata(path)?;
    if about.is_dir() {
        return Err(ErrorKind::IsADirectory.into());
    }
    if !about.is_file() {
        return Err(Error::new(ErrorKind::InvalidInput, "it is a pipe or a device, not a file"));
    }
    bounded(File::open(path)?, most)
}

/// The text of a file that another file refers to, or that was found in a folder.
///
/// # Errors
/// Those of [`read_file`], with a bound of 64 MiB; it is not valid UTF-8.
pub fn read_text_file(path: &Path) -> Result<String, Error> {
    text(read_file(path, MOST)?)
}

/// The text of a file that the user named; a pipe waits for its writer.
///
/// # Errors
/// Those of [`read_bytes`]; it is not valid UTF-8.
pub fn read_text(path: &Path) -> Result<String, Error> {
    text(read_bytes(path)?)
}

fn bounded(file: File, most: u64) -> Result<Vec<u8>, Error> {
    let mut bytes = Vec::new();
    file.take(most + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > most {
        let why = format!("it is longer than {} MiB", most >> 20);
        return Err(Error::new(ErrorKind::FileTooLarge, why));
    }
    Ok(bytes)
}

fn text(bytes: Vec<u8>) -> Result<String, Error> {
    String::from_utf8(bytes).map_err(|_| Error::new(ErrorKind::InvalidData, "it is not UTF-8 text"))
}
