//! One studio per folder: a second one shows the page of the first.
//!
//! Two studios would write the same files and merge each other's changes. The serving studio holds
//! a lock on a file that only its user can read, and writes its port next to it. A later studio
//! leaves a one-time code there. Like the code of the printed address, it admits a browser within a
//! minute.

use std::fs::{self, DirBuilder, File, TryLockError};
use std::hash::{DefaultHasher, Hash, Hasher};
use std::io;
use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};

use afp_token::Token;

/// The validity of an address's code.
pub(crate) const CODE_LASTS: Duration = Duration::from_secs(60);
/// The time within which the first studio must write its port.
const SAYS_WITHIN: Duration = Duration::from_secs(3);

/// The lock of a served folder, held as long as the value exists.
#[derive(Debug)]
pub(crate) struct Lock {
    _held: File,
    place: PathBuf,
}

/// Another program that serves a folder.
#[derive(Debug)]
pub(crate) struct Other {
    place: PathBuf,
    port: u16,
}

impl Lock {
    /// Takes the lock of a folder in the folder `among`, or finds its holder.
    ///
    /// # Errors
    /// Locking is not possible there.
    pub fn take(root: &Path, among: &Path) -> io::Result<Result<Lock, Other>> {
        let place = among.join(name(root));
        private(&place)?;
        let end = SystemTime::now() + SAYS_WITHIN;
        loop {
            let file = File::options()
                .create(true)
                .truncate(false)
                .write(true)
                .open(place.join("lock"))?;
            match file.try_lock() {
                Ok(()) => {
                    let lock = Lock { _held: file, place };
                    lock.forget()?;
                    return Ok(Ok(lock));
                }
                Err(TryLockError::Error(why)) => return Err(why),
                Err(TryLockError::WouldBlock) => {}
            }
            let said = fs::read_to_string(place.join("port")).unwrap_or_default();
            match said.trim().parse() {
                Ok(port) => return Ok(Err(Other { place, port })),
                Err(_) if SystemTime::now() > end => {
                    return Err(io::Error::new(io::ErrorKind::TimedOut, "its port is not known"));
                }
                // It has just started.
                Err(_) => std::thread::sleep(Duration::from_millis(20)),
            }
        }
    }

    /// Writes the port for later studios.
    ///
    /// # Errors
    /// It cannot be written.
    pub fn say(&self, port: u16) -> io::Result<()> {
        afp_output::write_whole(&self.place.join("port"), port.to_string().as_bytes())
    }

    /// Whether a code was left here within the last minute; it then expires.
    pub fn redeem(&self, code: &str) -> bool {
        let path = self.place.join("code");
        let Ok(word) = fs::read_to_string(&path) else { return false };
        let made = fs::metadata(&path).and_then(|data| data.modified());
        let age = made.ok().and_then(|made| SystemTime::now().duration_since(made).ok());
        let good = !word.is_empty() && Token::from_word(&word).is(code);
        // A code that cannot be removed would stay valid.
        good && fs::remove_file(&path).is_ok() && age.is_some_and(|age| age <= CODE_LASTS)
    }

    /// Codes of an earlier studio are useless.
    fn forget(&self) -> io::Result<()> {
        for name in ["port", "code"] {
            match fs::remove_file(self.place.join(name)) {
                Err(why) if why.kind() != io::ErrorKind::NotFound => return Err(why),
                _ => {}
            }
        }
        Ok(())
    }
}

impl Other {
    /// Returns a one-time address that shows a file.
    ///
    /// # Errors
    /// No randomness, or the code cannot be written.
    pub fn address(&self, file: Option<&str>) -> io::Result<String> {
        let code = Token::new()?;
        afp_output::write_whole(&self.place.join("code"), code.word().as_bytes())?;
        let file = file.map(|path| afp_lsp::uri_of(path).replacen("file://", "&file=", 1));
        Ok(format!(
            "http://127.0.0.1:{}/?code={}{}",
            self.port,
            code.word(),
            file.unwrap_or_default()
        ))
    }
}

/// A stable file name for a folder.
fn name(root: &Path) -> String {
    let mut hasher = DefaultHasher::new();
    root.hash(&mut hasher);
    format!("{:016x}", hasher.finish())
}

/// Creates a folder that only the user can read.
fn private(path: &Path) -> io::Result<()> {
    let mut builder = DirBuilder::new();
    builder.recursive(true);
    #[cfg(unix)]
    std::os::unix::fs::DirBuilderExt::mode(&mut builder, 0o700);
    builder.create(path)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A second studio while the lock is held.
    fn other(root: &Path, among: &Path) -> Other {
        Lock::take(root, among).unwrap().unwrap_err()
    }

    #[test]
    fn a_studio_holds_the_lock_and_others_learn_its_port() {
        let place = tempfile::tempdir().unwrap();
        let (root, among) = (Path::new("/plans"), place.path().join("open"));
        let lock = Lock::take(root, &among).unwrap().unwrap();
        lock.say(4000).unwrap();
        let address = other(root, &among).address(None).unwrap();
        assert!(address.starts_with("http://127.0.0.1:4000/?code="), "{address}");
        assert!(Lock::take(Path::new("/others"), &among).unwrap().is_ok());
        drop(lock);
        assert!(Lock::take(root, &among).unwrap().is_ok());
    }

    #[test]
    fn only_the_newest_code_of_another_studio_works_and_only_once() {
        let place = tempfile::tempdir().unwrap();
        let root = Path::new("/plans");
        let lock = Lock::take(root, place.path()).unwrap().unwrap();
        lock.say(4000).unwrap();
        let code = |file| {
            let address = other(root, place.path()).address(file).unwrap();
            address.split_once("code=").unwrap().1.to_owned()
        };
        assert!(!lock.redeem("") && !lock.redeem("0123"));
        let (old, new) = (code(None), code(None));
        assert!(!lock.redeem(&old) && lock.redeem(&new) && !lock.redeem(&new));
        let named = code(Some("/plans/two words&more.afp"));
        assert_eq!(named.split_once('&').unwrap().1, "file=/plans/two%20words%26more.afp");
    }

    #[cfg(unix)]
    #[test]
    fn the_folder_is_private() {
        use std::os::unix::fs::PermissionsExt;
        let place = tempfile::tempdir().unwrap();
        let _lock = Lock::take(Path::new("/plans"), &place.path().join("open")).unwrap();
        let mode = fs::metadata(place.path().join("open")).unwrap().permissions().mode();
        assert_eq!(mode & 0o777, 0o700);
    }
}
