//! What the name of an output stands for.

use std::fs::{self, File};
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};

/// As many links in a row as Linux follows.
const MOST_LINKS: usize = 40;

/// What the name of an output stands for.
pub(crate) enum Target {
    /// A device, a pipe or a socket: only the stream of bytes matters.
    Stream,
    /// A file, there already or not yet; links are followed.
    File(PathBuf),
}

impl Target {
    /// Follows links.
    ///
    /// # Errors
    /// It is empty, a folder, or a file that may not be written.
    pub(crate) fn of(path: &Path) -> io::Result<Target> {
        match fs::metadata(path) {
            Ok(about) if about.is_dir() => Err(ErrorKind::IsADirectory.into()),
            Ok(about) if !about.is_file() => Ok(Target::Stream),
            Ok(_) => {
                // A folder may let a file be replaced that is not to be written.
                File::options().write(true).open(path)?;
                Ok(match path.canonicalize() {
                    Ok(path) => Target::File(path),
                    // Open somewhere, but without a name: `/dev/stdout` after a removal.
                    Err(_) => Target::Stream,
                })
            }
            // With '.part' behind it, no name would be one.
            Err(error) if path.as_os_str().is_empty() => Err(error),
            Err(error) if error.kind() == ErrorKind::NotFound => follow(path).map(Target::File),
            Err(error) => Err(error),
        }
    }
}

/// The file that a link to nothing is to become.
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

/// Whether nobody misses the old file, if there is one, when the new one takes its name.
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
