//! Files that others wrote: never read without a bound, since a name may stand for something without an end.

use std::fs::File;
use std::io::{Error, ErrorKind, Read};
use std::path::Path;

/// The greatest length of a file that is read, in bytes: what is longer is none of ours, or has no end.
const MOST: u64 = 64 << 20;

/// The bytes of what a person names, which may be a pipe and wait for its writer.
///
/// # Errors
/// It cannot be read, or is longer than 64 MiB.
pub fn read_bytes(path: &Path) -> Result<Vec<u8>, Error> {
    bounded(File::open(path)?, MOST)
}

/// The bytes of what another file names, or what was found in a folder: a file and nothing that one waits for.
///
/// # Errors
/// It is a folder ([`ErrorKind::IsADirectory`]), a pipe or a device ([`ErrorKind::InvalidInput`]), cannot be read, or is
/// longer than `most` bytes ([`ErrorKind::FileTooLarge`]).
pub fn read_file(path: &Path, most: u64) -> Result<Vec<u8>, Error> {
    // Opening a pipe waits: it is looked at before.
    let about = std::fs::metadata(path)?;
    if about.is_dir() {
        return Err(ErrorKind::IsADirectory.into());
    }
    if !about.is_file() {
        return Err(Error::new(ErrorKind::InvalidInput, "it is a pipe or a device, and no file"));
    }
    bounded(File::open(path)?, most)
}

/// The text of what another file names, or what was found in a folder.
///
/// # Errors
/// As [`read_file`], with a bound of 64 MiB; it is no text in UTF-8.
pub fn read_text_file(path: &Path) -> Result<String, Error> {
    text(read_file(path, MOST)?)
}

/// The text of what a person names, which may be a pipe and wait for its writer.
///
/// # Errors
/// As [`read_bytes`]; it is no text in UTF-8.
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
    String::from_utf8(bytes)
        .map_err(|_| Error::new(ErrorKind::InvalidData, "it is no text in UTF-8"))
}
