//! Exclusive access to devices: two programs that drive one robot contradict each other.

use std::fs::{self, File, OpenOptions, TryLockError};
use std::io;
use std::path::Path;

/// Opens a device, or a lock file, exclusively until all copies of the file are closed. The system
/// also releases it when the process ends.
///
/// The lock is advisory (`flock`). Other programs cannot open a serial line either, unless they run
/// as root (`TIOCEXCL`).
///
/// ```
/// # let folder = tempfile::tempdir()?;
/// # let path = folder.path().join("robot.lock");
/// let mut options = std::fs::File::options();
/// let file = afp_platform::open_device(options.write(true).create(true), &path)?;
/// let again = afp_platform::open_device(&options, &path).unwrap_err();
/// assert_eq!(again.kind(), std::io::ErrorKind::ResourceBusy);
/// # Ok::<_, std::io::Error>(())
/// ```
///
/// # Errors
/// It cannot be opened. [`ResourceBusy`](io::ErrorKind::ResourceBusy) if another program has it;
/// the message names the process, if known.
pub fn open_device(options: &OpenOptions, path: impl AsRef<Path>) -> io::Result<File> {
    let path = path.as_ref();
    let file = options.open(path).map_err(|error| match error.kind() {
        io::ErrorKind::ResourceBusy => busy(path),
        _ => error,
    })?;
    match file.try_lock() {
        Ok(()) => {}
        Err(TryLockError::WouldBlock) => return Err(busy(path)),
        Err(TryLockError::Error(error)) => return Err(error),
    }
    #[cfg(unix)]
    if rustix::termios::isatty(&file) {
        rustix::termios::ioctl_tiocexcl(&file)?;
    }
    Ok(file)
}

/// Lets other programs open a serial line again, even if a copy of the file stays open.
pub fn release_device(file: &File) {
    // A removed device needs no release.
    let _ = file.unlock();
    #[cfg(unix)]
    if rustix::termios::isatty(file) {
        let _ = rustix::termios::ioctl_tiocnxcl(file);
    }
}

fn busy(path: &Path) -> io::Error {
    let owner = owner(path).map_or("another program".to_owned(), |process| {
        let name = fs::read_to_string(format!("/proc/{process}/comm")).unwrap_or_default();
        format!("process {process} ({})", name.trim())
    });
    io::Error::new(
        io::ErrorKind::ResourceBusy,
        format!("{owner} has it open; one program drives a robot"),
    )
}

/// The process that has locked a file, if known.
#[cfg(target_os = "linux")]
fn owner(path: &Path) -> Option<u32> {
    use std::os::unix::fs::MetadataExt;

    let file = fs::metadata(path).ok()?;
    let (major, minor) = (rustix::fs::major(file.dev()), rustix::fs::minor(file.dev()));
    let id = format!("{major:02x}:{minor:02x}:{}", file.ino());
    let locks = fs::read_to_string("/proc/locks").ok()?;
    locks.lines().find_map(|line| {
        let words: Vec<_> = line.split_whitespace().collect();
        let [_, "FLOCK", _, _, process, place, ..] = words[..] else { return None };
        (place == id).then(|| process.parse().ok()).flatten()
    })
}

#[cfg(not(target_os = "linux"))]
fn owner(_: &Path) -> Option<u32> {
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_device_has_one_program_until_it_is_closed() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("lock");
        let open = || open_device(File::options().write(true).create(true), &path);
        let first = open().unwrap();
        let copy = first.try_clone().unwrap();
        drop(first);
        let why = open().unwrap_err();
        assert_eq!(why.kind(), io::ErrorKind::ResourceBusy);
        #[cfg(target_os = "linux")]
        assert!(why.to_string().contains(&std::process::id().to_string()), "{why}");
        drop(copy);
        release_device(&open().unwrap());
        assert!(open().is_ok());
        let none = open_device(File::options().read(true), folder.path().join("none"));
        assert_eq!(none.unwrap_err().kind(), io::ErrorKind::NotFound);
    }
}
