//! Files that appear under their name only when they are whole, and those of others, read with a bound.
//!
//! An output is written beside its file, under the same name with `.part` appended, and takes the
//! file's place at the end. Whoever reads sees the old file or the new one, also after a power
//! failure. Links are followed and permissions kept.
//!
//! Not everything can be replaced. Devices and pipes are written straight into. A file with several
//! names, or of another owner, would be cut off from them: it gets the bytes of the whole new file
//! instead. So does a file in a folder that takes no new ones, whose new bytes are kept among the
//! temporary files until then.

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

/// What helps where a file or its folder is not there.
pub const ELSEWHERE: &str = "check the path; relative paths start in the current folder";

/// A file that is being written.
///
/// Dropped without [`Output::finish`] or [`Output::discard`], as by a crash, it leaves what was
/// written at [`Output::path`].
#[derive(Debug)]
pub struct Output {
    file: File,
    /// Where the bytes go.
    path: PathBuf,
    /// What `path` becomes in the end; `None` where it is the end.
    becomes: Option<PathBuf>,
    /// Where that is now which a process that died left of it.
    kept: Option<PathBuf>,
}

impl Output {
    /// Begins to write the file `path`. What a process that died left of it is kept, see [`Output::kept`].
    ///
    /// Opening a named pipe waits for its reader.
    ///
    /// # Errors
    /// The folder is not there or not writable, the file is not writable, is a folder, or is being
    /// written by somebody else ([`io::ErrorKind::ResourceBusy`]).
    pub fn create(path: &Path) -> io::Result<Output> {
        Output::begin(path, Taken::Refuse)
    }

    /// The same where `path` with `.part` appended may be what is read meanwhile: then it is written
    /// under the next name, `run.2.mcap.part` for `run.mcap`.
    ///
    /// # Errors
    /// As of [`Output::create`].
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

    /// Where the bytes are until [`Output::finish`].
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Where that is now which a process that died left of the same file: `run.2.mcap.part`.
    pub fn kept(&self) -> Option<&Path> {
        self.kept.as_deref()
    }

    /// Puts the file in its place.
    ///
    /// # Errors
    /// The disk is full or fails, somebody else has begun to write a file of that name; what was written stays at
    /// [`Output::path`].
    pub fn finish(mut self) -> io::Result<()> {
        self.sync()?;
        self.put().map(drop)
    }

    /// Brings the bytes to the disk.
    fn sync(&mut self) -> io::Result<()> {
        self.file.flush()?;
        // Devices and pipes have nothing that could be synchronised.
        match self.becomes.is_some() || self.file.metadata()?.is_file() {
            true => self.file.sync_all(),
            false => Ok(()),
        }
    }

    /// Puts the file in its place; gives its length and time as they were when nobody else could know it.
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

    /// Gives up; nothing of what was written stays, and an old file is as it was.
    pub fn discard(self) {
        if self.becomes.is_some() {
            // There is a failure to tell of already, which matters more.
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

/// Writes a file at once. Of several at once each writes all of it, one after the other.
///
/// # Errors
/// The folder is not there or not writable, the disk is full, or somebody else has been writing the
/// file for seconds. No file of that name is left half
/// written then, and an old one stays as it was.
pub fn write_whole(path: &Path, bytes: &[u8]) -> io::Result<()> {
    write_if(path, bytes, || true).map(drop)
}

/// The same, unless in the last moment it is not wanted any more: none then, and the old file stays. Gives the length and the
/// time that the file was given with its bytes. What another program writes right afterwards has others: whoever looks at the
/// file itself may see those.
///
/// # Errors
/// As of [`write_whole`].
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

/// What a file is called while it is written.
pub fn part_of(path: &Path) -> PathBuf {
    part::name(path, 1)
}

/// Finds out early whether a file can be written later. Devices and pipes are taken at their word.
///
/// # Errors
/// As of [`Output::create`].
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

/// Whether a folder, but not necessarily a file in it, refuses to be written.
fn takes_no_files(error: &io::Error) -> bool {
    matches!(error.kind(), io::ErrorKind::PermissionDenied | io::ErrorKind::ReadOnlyFilesystem)
}

/// Gives a file the bytes of another, one writer after the other. It takes the space for them first and is cut to its length
/// last: a full disk leaves it as it was, unless its file system writes what changes to a new place.
fn fill(target: &Path, from: &mut File) -> io::Result<Metadata> {
    let length = from.metadata()?.len();
    from.rewind()?;
    let mut file = File::options().write(true).open(target)?;
    // Where a file system knows no locks nobody else waits, either.
    let _ = file.lock();
    reserve(&mut file, length)?;
    io::copy(from, &mut file)?;
    file.set_len(length)?;
    file.sync_all()?;
    file.metadata()
}

/// Takes the space that a file needs to become so long, without touching what it holds.
fn reserve(file: &mut File, length: u64) -> io::Result<()> {
    let old = file.seek(SeekFrom::End(0))?;
    let mut missing = io::repeat(0).take(length.saturating_sub(old));
    // Some systems find out that a disk is full when the bytes go there.
    if let Err(full) = io::copy(&mut missing, file).and_then(|_| file.sync_all()) {
        file.set_len(old)?;
        return Err(full);
    }
    file.rewind()
}

/// Makes a new name last through a power failure.
fn sync_folder(folder: &Path) -> io::Result<()> {
    use io::ErrorKind::{InvalidInput, PermissionDenied, Unsupported};
    match File::open(folder).and_then(|folder| folder.sync_all()) {
        // Not every system can do this, nor every folder be opened.
        Err(error) if matches!(error.kind(), InvalidInput | PermissionDenied | Unsupported) => {
            Ok(())
        }
        done => done,
    }
}
