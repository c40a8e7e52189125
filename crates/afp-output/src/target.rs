//! The target of an output's name.

use std::fs::{self, File};
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};

/// The maximum number of links in a row, as on Linux.
const MOST_LINKS: usize = 40;

/// The target of an output's name.
pub(crate) enum Target {
    /// A device, a pipe or a socket: a stream of bytes.
    Stream,
    /// An existing or new file, after following links.
    File(PathBuf),
}

impl Target {
    /// Follows links.
    ///
    /// # Errors
    /// The path is empty, a folder, or a read-only file.
    pub(crate) fn of(path: &Path) -> io::Result<Target> {
        match fs::metadata(path) {
            Ok(about) if about.is_dir() => Err(ErrorKind::IsADirectory.into()),
            Ok(about) if !about.is_file() => Ok(Target::Stream),
            Ok(_) => {
                // A folder may allow replacing a read-only file.
                File::options().write(true).open(path)?;
                Ok(match path.canonicalize() {
                    Ok(path) => Target::File(path),
                    // An open file without a name: `/dev/stdout` after a removal.
                    Err(_) => Target::Stream,
                })
            }
            // With '.part' appended, an empty name would become valid.
            Err(error) if path.as_os_str().is_empty() => Err(error),
            Err(error) if error.kind() == ErrorKind::NotFound => follow(path).map(Target::File),
            Err(error) => Err(error),
        }
    }
}

/// The target of a dangling link.
fn follow(path: &Path) -> io::Result<PathBuf> {
    let mut path = path.to_owned();
    for _ in 0..MOST_LINKS {
        match fs::read_link(&path) {
            Ok(to) => path = folder(&path).join(to),
            Err(_) => return Ok(path),
        }
    }
    Err(io::Error::other("too many links"))
}

/// The folder of a file.
pub(crate) fn folder(path: &Path) -> &Path {
    match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    }
}

/// Whether the new file can replace the old file, if there is one, without breaking links or
/// ownership.
#[cfg(unix)]
pub(crate) fn is_replaceable(target: &Path, new: &File) -> io::Result<bool> {
    use std::os::unix::fs::MetadataExt;
    let Ok(old) = fs::metadata(target) else { return Ok(true) };
    let new = new.metadata()?;
    Ok(old.nlink() == 1 && (old.uid(), old.gid()) == (new.uid(), new.gid()))
}

#[cfg(not(unix))]
pub(crate) fn is_replaceable(_: &Path, _: &File) -> io::Result<bool> {
    Ok(true)
}
