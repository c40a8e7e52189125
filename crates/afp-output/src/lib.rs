//! Output files that replace their target only when they are complete, and bounded reading of other
//! files.
//!
//! An output is written next to its file, under the same name with `.part` appended, and replaces
//! the file at the end. A reader sees the old file or the new one, even after a power failure.
//! Links are followed and permissions kept.
//!
//! Some files cannot be replaced. Devices and pipes are written directly. A file with several
//! names, or of another owner, would lose them, so it gets the bytes of the whole new file instead.
//! The same applies to a file in a folder that accepts no new files; its new bytes are first
//! written among the temporary files.

pub mod frames;
mod part;
mod read;
mod target;

use std::fs::{self, File, Metadata};
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use part::{Part, Taken};
pub use read::{read_bytes, read_file, read_text, read_text_file};
use target::Target;

/// The help for a missing file or folder.
pub const ELSEWHERE: &str = "check the path; relative paths start in the current folder";

/// A file during writing.
///
/// If it is dropped without [`Output::finish`] or [`Output::discard`], for example by a crash, the
/// written bytes remain at [`Output::path`].
#[derive(Debug)]
pub struct Output {
    file: File,
    /// The path of the written bytes.
    path: PathBuf,
    /// The final path; `None` if it is already `path`.
    becomes: Option<PathBuf>,
    /// The new path of a dead process's unfinished file.
    kept: Option<PathBuf>,
}

impl Output {
    /// Starts writing the file `path`. The unfinished file of a dead process is kept, see
    /// [`Output::kept`].
    ///
    /// Opening a named pipe waits for its reader.
    ///
    /// # Errors
    /// The folder is missing or not writable; the file is not writable, is a folder, or is being
    /// written by another process ([`io::ErrorKind::ResourceBusy`]).
    pub fn create(path: &Path) -> io::Result<Output> {
        Output::begin(path, Taken::Refuse)
    }

    /// Like [`Output::create`], if `path` with `.part` appended may be an input of the same
    /// process. Then it is written under the next name, `run.2.mcap.part` for `run.mcap`.
    ///
    /// # Errors
    /// Those of [`Output::create`].
    pub fn create_beside_part(path: &Path) -> io::Result<Output> {
        Output::begin(path, Taken::Next)
    }

    fn begin(path: &Path, taken: Taken) -> io::Result<Output> {
        let target = match Target::of(path)? {
            Target::File(target) => target,
            Target::Stream => {
                let file = File::options().write(true).open(path)?;
                return Ok(Output { file, path: path.to_owned(), becomes: None, kept: None });
            }
        };
        let part = match Part::create(&target, taken) {
            Err(error) if takes_no_files(&error) && target.exists() => Part::elsewhere(&target),
            part => part,
        };
        let Part { file, path, kept } = part?;
        Ok(Output { file, path, becomes: Some(target), kept })
    }

    /// The path of the bytes until [`Output::finish`].
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The new path of a dead process's unfinished file: `run.2.mcap.part`.
    pub fn kept(&self) -> Option<&Path> {
        self.kept.as_deref()
    }

    /// Replaces the target.
    ///
    /// # Errors
    /// The disk is full or fails, or another process has started to write a file of that name. The
    /// written bytes remain at [`Output::path`].
    pub fn finish(mut self) -> io::Result<()> {
        self.sync()?;
        self.put().map(drop)
    }

    /// Syncs the bytes to the disk.
    fn sync(&mut self) -> io::Result<()> {
        self.file.flush()?;
        // Devices and pipes cannot be synchronised.
        match self.becomes.is_some() || self.file.metadata()?.is_file() {
            true => self.file.sync_all(),
            false => Ok(()),
        }
    }

    /// Replaces the target; returns the length and time from before the file was visible to others.
    fn put(mut self) -> io::Result<Metadata> {
        let Some(target) = &self.becomes else { return self.file.metadata() };
        part::refuse_taken(target)?;
        let is_beside = self.path.parent() == target.parent();
        if !is_beside || !target::is_replaceable(target, &self.file)? {
            let written = fill(target, &mut self.file)?;
            fs::remove_file(&self.path)?;
            return Ok(written);
        }
        let written = self.file.metadata()?;
        fs::rename(&self.path, target)?;
        sync_folder(target::folder(target))?;
        Ok(written)
    }

    /// Discards the output; an old file is not changed.
    pub fn discard(self) {
        if self.becomes.is_some() {
            // An earlier failure matters more than this one.
            let _ = fs::remove_file(&self.path);
        }
    }
}

impl Write for Output {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.file.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

/// Writes a whole file. Concurrent writers take turns.
///
/// # Errors
/// The folder is missing or not writable, the disk is full, or another process has been writing the
/// file for seconds. The file is then unchanged or absent, and never incomplete.
pub fn write_whole(path: &Path, bytes: &[u8]) -> io::Result<()> {
    write_if(path, bytes, || true).map(drop)
}

/// Like [`write_whole`], but a final check can cancel the write; then returns `None` and keeps the
/// old file. Returns the length and the time that the file got with its bytes. Another program may
/// change the file immediately afterwards, so its present values may differ.
///
/// # Errors
/// Those of [`write_whole`].
pub fn write_if(
    path: &Path,
    bytes: &[u8],
    is_wanted: impl FnOnce() -> bool,
) -> io::Result<Option<Metadata>> {
    let mut output = Output::begin(path, Taken::Wait)?;
    match output.write_all(bytes).and_then(|()| output.sync()) {
        Ok(()) if !is_wanted() => {
            output.discard();
            Ok(None)
        }
        Ok(()) => output.put().map(Some),
        Err(error) => {
            output.discard();
            Err(error)
        }
    }
}

/// The name of a file during writing.
pub fn part_of(path: &Path) -> PathBuf {
    part::name(path, 1)
}

/// Checks early whether a file can be written later. Devices and pipes are not checked.
///
/// # Errors
/// Those of [`Output::create`].
pub fn check_writable(path: &Path) -> io::Result<()> {
    let Target::File(target) = Target::of(path)? else { return Ok(()) };
    match Part::create(&target, Taken::Wait) {
        Ok(part) => fs::remove_file(part.path),
        Err(error) if takes_no_files(&error) && target.exists() => {
            fs::remove_file(Part::elsewhere(&target)?.path)
        }
        Err(error) => Err(error),
    }
}

/// Whether an error means that a folder is not writable, although a file in it may be.
fn takes_no_files(error: &io::Error) -> bool {
    matches!(error.kind(), io::ErrorKind::PermissionDenied | io::ErrorKind::ReadOnlyFilesystem)
}

/// Copies a file's bytes into another file; writers take turns. It reserves the space first and
/// truncates last, so that a full disk leaves the file unchanged, except on a copy-on-write file
/// system.
fn fill(target: &Path, from: &mut File) -> io::Result<Metadata> {
    let length = from.metadata()?.len();
    from.rewind()?;
    let mut file = File::options().write(true).open(target)?;
    // On a file system without locks, nobody else waits, either.
    let _ = file.lock();
    reserve(&mut file, length)?;
    io::copy(from, &mut file)?;
    file.set_len(length)?;
    file.sync_all()?;
    file.metadata()
}

/// Reserves the space for a file's new length without changing its contents.
fn reserve(file: &mut File, length: u64) -> io::Result<()> {
    let old = file.seek(SeekFrom::End(0))?;
    let mut missing = io::repeat(0).take(length.saturating_sub(old));
    // Some systems only notice a full disk when the bytes are written.
    if let Err(full) = io::copy(&mut missing, file).and_then(|_| file.sync_all()) {
        file.set_len(old)?;
        return Err(full);
    }
    file.rewind()
}

/// Makes a new name survive a power failure.
fn sync_folder(folder: &Path) -> io::Result<()> {
    use io::ErrorKind::{InvalidInput, PermissionDenied, Unsupported};
    match File::open(folder).and_then(|folder| folder.sync_all()) {
        // Some systems cannot do this, and some folders cannot be opened.
        Err(error) if matches!(error.kind(), InvalidInput | PermissionDenied | Unsupported) => {
            Ok(())
        }
        done => done,
    }
}
