//! The part file of an output until it is complete: next to the output, or elsewhere if the folder
//! accepts no files.

use std::ffi::OsString;
use std::fs::{self, File, OpenOptions, TryLockError};
use std::io;
use std::path::{Path, PathBuf};
use std::thread;
use std::time::{Duration, Instant};

/// Our own part file, locked while it is open.
pub(crate) struct Part {
    pub(crate) file: File,
    pub(crate) path: PathBuf,
    /// The new path of a dead process's file with this name.
    pub(crate) kept: Option<PathBuf>,
}

/// The behaviour if the part file is open in another process.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Taken {
    /// Refuse; the file of a dead process is kept.
    Refuse,
    /// Wait for a moment, because the other write is short. The file of a dead process is
    /// overwritten.
    Wait,
    /// Use the next name.
    Next,
}

/// The time to wait for a concurrent short write.
const PATIENCE: Duration = Duration::from_secs(2);
const LOOK_AGAIN: Duration = Duration::from_millis(1);

impl Part {
    /// Creates an empty part for a file.
    ///
    /// # Errors
    /// The folder is missing or not writable, or another process writes the file, or uses it as the
    /// part of another file.
    pub(crate) fn create(target: &Path, taken: Taken) -> io::Result<Part> {
        refuse_taken(target)?;
        let begin = Instant::now();
        let (mut number, mut kept) = (1, None);
        loop {
            let path = name(target, number);
            if fs::symlink_metadata(&path).is_ok_and(|there| !there.is_file()) {
                number += 1;
                continue;
            }
            let file =
                File::options().read(true).write(true).create(true).truncate(false).open(&path)?;
            if let Err(TryLockError::WouldBlock) = file.try_lock() {
                match taken {
                    Taken::Next => number += 1,
                    Taken::Wait if begin.elapsed() < PATIENCE => thread::sleep(LOOK_AGAIN),
                    Taken::Wait | Taken::Refuse => return Err(busy()),
                }
                continue;
            }
            // Without locks, two concurrent writers are not protected. The owner of the lock may
            // have renamed the part just now.
            if !is_at(&file, &path)? {
                continue;
            }
            if file.metadata()?.len() > 0 {
                match taken {
                    Taken::Next => {
                        number += 1;
                        continue;
                    }
                    Taken::Refuse => {
                        kept = Some(keep(target, &path)?);
                        continue;
                    }
                    Taken::Wait => file.set_len(0)?,
                }
            }
            permit_as(target, &file)?;
            return Ok(Part { file, path, kept });
        }
    }

    /// Creates an empty part among the temporary files, for a file in a folder that accepts none.
    ///
    /// # Errors
    /// There is no space for it, or another process uses the file as the part of another file.
    pub(crate) fn elsewhere(target: &Path) -> io::Result<Part> {
        refuse_taken(target)?;
        let beside = std::env::temp_dir().join(target.file_name().unwrap_or_default());
        let mut number = 1;
        loop {
            let path = name(&beside, number);
            match private().open(&path) {
                Ok(file) => return Ok(Part { file, path, kept: None }),
                Err(error) if error.kind() == io::ErrorKind::AlreadyExists => number += 1,
                Err(error) => {
                    let message = format!(
                        "its folder and '{}' take no new files: {error}",
                        std::env::temp_dir().display()
                    );
                    return Err(io::Error::new(error.kind(), message));
                }
            }
        }
    }
}

/// The options for a new private file in a shared folder.
fn private() -> OpenOptions {
    let mut options = File::options();
    options.read(true).write(true).create_new(true);
    #[cfg(unix)]
    std::os::unix::fs::OpenOptionsExt::mode(&mut options, 0o600);
    options
}

/// Renames the part of a dead process to the next free name.
fn keep(target: &Path, part: &Path) -> io::Result<PathBuf> {
    let mut others = (2..).map(|number| name(target, number));
    let free = others.find(|other| fs::symlink_metadata(other).is_err());
    let free = free.ok_or(io::ErrorKind::AlreadyExists)?;
    fs::rename(part, &free)?;
    Ok(free)
}

/// Refuses a file that a process has locked: the part of another file, or a journal. Replacing it
/// would leave that process with a nameless file. A file that has just got its final name is free
/// soon.
///
/// # Errors
/// Another process has locked the file.
pub(crate) fn refuse_taken(target: &Path) -> io::Result<()> {
    let begin = Instant::now();
    let is_taken = || match File::open(target).map(|file| file.try_lock_shared()) {
        Ok(locked) => matches!(locked, Err(TryLockError::WouldBlock)),
        Err(_) => false,
    };
    while is_taken() {
        if begin.elapsed() > PATIENCE {
            return Err(busy());
        }
        thread::sleep(LOOK_AGAIN);
    }
    Ok(())
}

fn busy() -> io::Error {
    let why = "another program is writing it: wait for its end, or give another name";
    io::Error::new(io::ErrorKind::ResourceBusy, why)
}

/// Gives a part the permissions of the old file, so that a private file is private from the
/// beginning.
fn permit_as(target: &Path, file: &File) -> io::Result<()> {
    match fs::metadata(target) {
        Ok(old) if old.permissions() != file.metadata()?.permissions() => {
            file.set_permissions(old.permissions())
        }
        _ => Ok(()),
    }
}

/// The name of a file's part: `run.mcap.part`, then `run.2.mcap.part`, with the other extensions
/// kept.
pub(crate) fn name(target: &Path, number: u32) -> PathBuf {
    let mut name = OsString::new();
    match (number, target.extension()) {
        (1, _) => name.push(target.file_name().unwrap_or_default()),
        (_, None) => {
            name.push(target.file_name().unwrap_or_default());
            name.push(format!(".{number}"));
        }
        (_, Some(extension)) => {
            name.push(target.file_stem().unwrap_or_default());
            name.push(format!(".{number}."));
            name.push(extension);
        }
    }
    name.push(".part");
    target.with_file_name(name)
}

/// Whether an open file still has this name.
#[cfg(unix)]
fn is_at(file: &File, path: &Path) -> io::Result<bool> {
    use std::os::unix::fs::MetadataExt;
    let open = file.metadata()?;
    Ok(fs::symlink_metadata(path)
        .is_ok_and(|there| (there.dev(), there.ino()) == (open.dev(), open.ino())))
}

#[cfg(not(unix))]
fn is_at(_: &File, path: &Path) -> io::Result<bool> {
    Ok(path.exists())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_are_numbered_before_the_ending() {
        let cases = [
            ("runs/run.mcap", 1, "runs/run.mcap.part"),
            ("runs/run.mcap", 2, "runs/run.2.mcap.part"),
            ("plan", 1, "plan.part"),
            ("plan", 3, "plan.3.part"),
        ];
        for (target, number, wanted) in cases {
            assert_eq!(name(Path::new(target), number), Path::new(wanted));
        }
    }
}
