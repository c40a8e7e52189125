//! A log of outcomes, so that a killed sweep resumes.
//!
//! A journal is a text file: a header line, then a line of JSON for each outcome. Each line is
//! written in one piece. A process that dies leaves at most the last line incomplete. That line is
//! cut off, and its run is repeated. A lock keeps a second process out.

use std::fmt;
use std::fs::{File, OpenOptions, TryLockError};
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use afp_run::{RunError, hash};
use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::header::Header;
use crate::outcome::Outcome;

/// The interval of syncs, against a crash of the machine. The first line after it syncs all lines
/// before, and [`Journal::close`] syncs the rest.
const SYNC: Duration = Duration::from_secs(1);

#[derive(Debug)]
#[non_exhaustive]
pub enum JournalError {
    /// An I/O error.
    File(RunError),
    /// Another process has the lock.
    InUse(PathBuf),
    /// It belongs to a different sweep; the text has the difference.
    Other(PathBuf, String),
    /// A line of it is invalid.
    Broken(PathBuf, usize),
}

impl fmt::Display for JournalError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            JournalError::File(why) => write!(f, "{why}"),
            JournalError::InUse(path) => write!(f, "another sweep is writing '{}'", path.display()),
            JournalError::Other(path, how) => {
                write!(f, "'{}' belongs to another sweep: {how}", path.display())
            }
            JournalError::Broken(path, line) => {
                write!(f, "line {line} of '{}' is not a line of a journal", path.display())
            }
        }
    }
}

impl From<JournalError> for RunError {
    /// Adds the command line's help.
    fn from(why: JournalError) -> RunError {
        let message = why.to_string();
        match why {
            JournalError::File(why) => why,
            JournalError::InUse(_) => {
                RunError::usage(message, "wait for it, or give another file with '-o'")
            }
            JournalError::Other(..) | JournalError::Broken(..) => {
                RunError::usage(message, "'--restart' starts again and deletes the old outcomes")
            }
        }
    }
}

/// A journal open for writing.
#[derive(Debug)]
pub struct Journal {
    path: PathBuf,
    file: File,
    synced: Instant,
}

impl Journal {
    /// Opens or creates a journal and returns its outcomes in order of completion. `restart`
    /// discards the old ones.
    ///
    /// # Errors
    /// The file cannot be read or written, belongs to a different sweep, is broken, or is in use.
    pub fn open(
        path: &Path,
        header: &Header,
        restart: bool,
    ) -> Result<(Journal, Vec<Outcome>), JournalError> {
        let wrong = || {
            let wrong = RunError::file("cannot use the journal", path);
            move |error| JournalError::File(wrong(error))
        };
        let open =
            OpenOptions::new().read(true).write(true).create(true).truncate(false).open(path);
        let mut file = open.map_err(wrong())?;
        match file.try_lock() {
            Ok(()) => {}
            Err(TryLockError::WouldBlock) => return Err(JournalError::InUse(path.to_owned())),
            Err(TryLockError::Error(error)) => return Err(wrong()(error)),
        }
        let mut bytes = Vec::new();
        if !restart {
            file.read_to_end(&mut bytes).map_err(wrong())?;
        }
        let (outcomes, whole) = read(path, &bytes, header)?;
        let mut journal = Journal { path: path.to_owned(), file, synced: Instant::now() };
        journal.cut(whole).map_err(wrong())?;
        if whole == 0 {
            journal.line(header).map_err(wrong())?;
        }
        Ok((journal, outcomes))
    }

    /// Appends an outcome. When it returns, the outcome survives the process.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn keep(&mut self, outcome: &Outcome) -> Result<(), RunError> {
        let path = self.path.clone();
        self.line(outcome).map_err(RunError::file("cannot write the journal", &path))
    }

    /// Syncs and closes the file.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn close(self) -> Result<(), RunError> {
        self.file.sync_data().map_err(RunError::file("cannot write the journal", &self.path))
    }

    /// Cuts off everything after the last complete line.
    fn cut(&mut self, whole: usize) -> io::Result<()> {
        self.file.set_len(whole as u64)?;
        self.file.seek(SeekFrom::End(0))?;
        Ok(())
    }

    fn line(&mut self, what: &impl Serialize) -> io::Result<()> {
        let json = serde_json::to_string(what)?;
        // A disk error inside a number may give another number, so each line has a hash.
        let line = format!("{json}\t{}\n", hash(&json));
        self.file.write_all(line.as_bytes())?;
        if self.synced.elapsed() >= SYNC {
            self.file.sync_data()?;
            self.synced = Instant::now();
        }
        Ok(())
    }
}

/// Parses a journal and returns its outcomes and the length of its complete lines.
fn read(path: &Path, bytes: &[u8], header: &Header) -> Result<(Vec<Outcome>, usize), JournalError> {
    let end = bytes.iter().rposition(|byte| *byte == b'\n').map_or(0, |at| at + 1);
    let mut lines = bytes.get(..end).unwrap_or_default().split_inclusive(|byte| *byte == b'\n');
    let Some(first) = lines.next() else { return Ok((Vec::new(), 0)) };
    let broken = |line: usize| JournalError::Broken(path.to_owned(), line);
    let theirs: Header = parse(first).ok_or_else(|| broken(1))?;
    if let Some(difference) = header.differs(&theirs) {
        return Err(JournalError::Other(path.to_owned(), difference));
    }
    let (mut outcomes, mut whole) = (Vec::new(), first.len());
    let mut lines = (2..).zip(lines).peekable();
    while let Some((number, line)) = lines.next() {
        match parse::<Outcome>(line) {
            Some(outcome) => outcomes.push(outcome),
            // The disk may have stored the length of the last line without its bytes.
            None if lines.peek().is_none() => break,
            None => return Err(broken(number)),
        }
        whole += line.len();
    }
    Ok((outcomes, whole))
}

/// Parses a line if its hash matches.
fn parse<T: DeserializeOwned>(line: &[u8]) -> Option<T> {
    let (json, sum) = str::from_utf8(line).ok()?.trim_end().rsplit_once('\t')?;
    let valid = hash(json) == sum;
    serde_json::from_str(json).ok().filter(|_| valid)
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;
    use crate::header::Parts;
    use crate::outcome::Ending;

    fn header() -> Header {
        let [program, plan, worlds, grid] = ["1", "2", "3", "seeds 0..9"].map(str::to_owned);
        Header { sweep_journal: 2, program, plan, worlds, grid, parts: Parts::new() }
    }

    fn outcome(run: u64) -> Outcome {
        Outcome { time_s: 0.1 + 0.2, ..Outcome::failed(run, Ending::Ok, String::new()) }
    }

    /// Replaces a file. A program that another test starts may still hold the lock of the old one.
    fn replace(path: &Path, bytes: impl AsRef<[u8]>) {
        fs::remove_file(path).unwrap();
        fs::write(path, bytes).unwrap();
    }

    #[test]
    fn only_an_incomplete_line_is_cut_off() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.journal");
        let (mut journal, none) = Journal::open(&path, &header(), false).unwrap();
        assert!(none.is_empty());
        let kept = [outcome(4), outcome(1)];
        kept.iter().for_each(|outcome| journal.keep(outcome).unwrap());
        journal.close().unwrap();
        let whole = fs::read(&path).unwrap();
        let third = serde_json::to_vec(&outcome(2)).unwrap();
        for torn in [1, 10, third.len()] {
            replace(&path, [&whole[..], &third[..torn]].concat());
            let (_, read) = Journal::open(&path, &header(), false).unwrap();
            assert_eq!(read, kept);
            assert_eq!(fs::read(&path).unwrap(), whole);
        }
        replace(&path, [&whole[..], &[0, 0, b'\n']].concat());
        assert_eq!(Journal::open(&path, &header(), false).unwrap().1, kept);
        // An incomplete header is not a journal yet.
        replace(&path, &whole[..20]);
        assert!(Journal::open(&path, &header(), false).unwrap().1.is_empty());
    }

    #[test]
    fn a_flipped_bit_is_found_even_in_a_number() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.journal");
        let (mut journal, _) = Journal::open(&path, &header(), false).unwrap();
        [1, 2].iter().for_each(|run| journal.keep(&outcome(*run)).unwrap());
        drop(journal);
        let whole = fs::read(&path).unwrap();
        let lines: Vec<_> = whole.split_inclusive(|byte| *byte == b'\n').collect();
        for at in lines[0].len()..lines[0].len() + lines[1].len() - 1 {
            let mut flipped = whole.clone();
            flipped[at] ^= 1;
            let error = read(&path, &flipped, &header()).unwrap_err().to_string();
            assert!(error.contains("line 2 of"), "byte {at}: {error}");
        }
    }

    #[test]
    fn changes_outside_the_program_are_named() {
        let part = |name: &str, does: &str, k: &str| {
            (name.to_owned(), (does.to_owned(), [("k".to_owned(), k.to_owned())].into()))
        };
        let of = |parts: Vec<_>| header().with(parts.into_iter().collect());
        let cases = [
            (vec![part("a", "1", "5"), part("b", "1", "5")], None),
            (vec![part("a", "2", "6"), part("b", "1", "5")], Some("a has changed since")),
            (
                vec![part("a", "1", "6"), part("b", "1", "5")],
                Some("'k', which a reads, has changed since"),
            ),
            (vec![part("a", "2", "5"), part("b", "2", "5")], Some("a and b have changed since")),
            (vec![part("a", "1", "5")], Some("it was started without b")),
            (
                vec![part("a", "1", "5"), part("b", "1", "5"), part("c", "", "")],
                Some("it was started with c"),
            ),
        ];
        let ours = of(vec![part("a", "1", "5"), part("b", "1", "5")]);
        for (theirs, wanted) in cases {
            assert_eq!(ours.differs(&of(theirs)).as_deref(), wanted);
        }
        let json = serde_json::to_string(&header()).unwrap();
        assert!(!json.contains("parts"), "a journal without stimuli is unchanged: {json}");
    }

    #[test]
    fn other_sweeps_and_other_files_are_refused() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.journal");
        let open = Journal::open(&path, &header(), false).unwrap();
        let error = Journal::open(&path, &header(), false).unwrap_err().to_string();
        assert!(error.contains("another sweep is writing"), "{error}");
        replace(&path, fs::read(&path).unwrap());
        drop(open);
        let other = Header { plan: "x".to_owned(), ..header() };
        let error = Journal::open(&path, &other, false).unwrap_err();
        let error = RunError::from(error).to_string();
        assert!(
            error.contains("the plan has changed since") && error.contains("--restart"),
            "{error}"
        );
        replace(&path, fs::read(&path).unwrap());
        let other = Header { grid: "seeds 0..8".to_owned(), ..header() };
        let error = Journal::open(&path, &other, false).unwrap_err().to_string();
        assert!(error.contains("started with seeds 0..9; this is seeds 0..8"), "{error}");
        replace(&path, "run,world\n");
        assert!(Journal::open(&path, &header(), false).is_err());
        replace(&path, "run,world\n");
        assert!(Journal::open(&path, &header(), true).unwrap().1.is_empty());
    }
}
