//! The files of a folder: permissions and formats.

mod line_ends;

use std::collections::BTreeMap;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};
use std::{fs, io};

use afp_project::Listing;

use line_ends::LineEnds;
pub(crate) use line_ends::with_newlines;

/// Editable files: plans, toolboxes and scenarios, positions, projects.
const ENDINGS: [&str; 3] = ["afp", "layout", "toml"];

/// The longest text that is opened or written, in bytes.
pub(crate) const LONGEST: usize = 4 << 20;

/// The most entries of the folder that are listed.
const MOST_ENTRIES: usize = 50_000;

/// Modification time and length of a file; a different stamp means a different content.
pub(crate) type Stamp = (Option<SystemTime>, u64);

/// The coarsest file times: FAT stores even seconds.
const COARSE: Duration = Duration::from_secs(2);

/// A folder without links to the outside.
#[derive(Clone, Debug)]
pub struct Folder {
    root: PathBuf,
}

#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Listed {
    /// Editable files and logs by path, with their stamps.
    pub files: BTreeMap<String, Stamp>,
    pub entries: usize,
    /// Whether there are more entries.
    pub is_cut: bool,
}

/// A text in its file's format.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Kept {
    /// With `\n` line ends, independent of the file's.
    pub text: String,
    /// A hash of the bytes; `None` without a file.
    pub etag: Option<String>,
    style: Style,
}

/// The parts of the format that are not text, and stay.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
struct Style {
    marked: bool,
    ends: LineEnds,
}

impl Folder {
    /// An existing folder.
    ///
    /// # Errors
    /// It does not exist.
    pub fn new(path: &Path) -> io::Result<Folder> {
        let root = fs::canonicalize(path)?;
        match root.is_dir() {
            true => Ok(Folder { root }),
            false => Err(io::Error::from(io::ErrorKind::NotADirectory)),
        }
    }

    /// Its path without links.
    pub fn root(&self) -> &Path {
        &self.root
    }

    /// Resolves a path, following links.
    ///
    /// # Errors
    /// A sentence: it is outside, or not editable.
    pub(crate) fn inside(&self, path: &str) -> Result<PathBuf, String> {
        let path = Path::new(path);
        let ending = path.extension().and_then(|ending| ending.to_str()).unwrap_or_default();
        if !ENDINGS.contains(&ending) {
            return Err(format!(
                "the studio cannot open '{}': it opens only plans, toolboxes and scenarios (.afp), their drawings (.layout) and afp.toml",
                path.display()
            ));
        }
        // Windows opens a device by such a name, whatever the ending.
        let stem = path.file_name().and_then(|name| name.to_str()?.split('.').next());
        if stem.is_some_and(is_device) {
            return Err(format!("'{}' is the name of a device on Windows", path.display()));
        }
        let outside = || format!("'{}' is outside of '{}'", path.display(), self.root.display());
        let real = match fs::canonicalize(path) {
            Ok(real) => real,
            // For a new file its folder decides. A dangling link is not followed.
            Err(_) if fs::symlink_metadata(path).is_ok() => return Err(outside()),
            Err(_) => {
                let folder = path.parent().and_then(|folder| fs::canonicalize(folder).ok());
                let name = path.file_name().ok_or_else(outside)?;
                folder
                    .ok_or_else(|| format!("there is no folder for '{}'", path.display()))?
                    .join(name)
            }
        };
        if real.starts_with(&self.root) { Ok(real) } else { Err(outside()) }
    }

    pub(crate) fn list(&self) -> Listed {
        let Listing { files, logs, entries, is_cut } = afp_project::list(&self.root, MOST_ENTRIES);
        // Links to the outside are not opened.
        let is_link = |path: &Path| fs::symlink_metadata(path).is_ok_and(|it| it.is_symlink());
        let is_inside = |path: &PathBuf| {
            !is_link(path) || path.to_str().is_some_and(|it| self.inside(it).is_ok())
        };
        let files = files.into_iter().filter(is_inside);
        let files = files.filter_map(|path| Some((path.to_str()?.to_owned(), stamp(&path)?)));
        // The growth of a log is not a change.
        let logs = logs.into_iter();
        let logs = logs.filter_map(|path| Some((path.to_str()?.to_owned(), (None, 0))));
        Listed { files: files.chain(logs).collect(), entries, is_cut }
    }

    /// The display form of a path, relative to the root.
    pub(crate) fn name(&self, path: &str) -> String {
        let short = Path::new(path).strip_prefix(&self.root).unwrap_or(Path::new(path));
        short.to_string_lossy().replace('\\', "/")
    }
}

/// Whether Windows reserves a name.
fn is_device(name: &str) -> bool {
    let name = name.to_ascii_lowercase();
    let port = |kind| {
        name.strip_prefix(kind).is_some_and(|rest: &str| matches!(rest.as_bytes(), [b'1'..=b'9']))
    };
    matches!(&*name, "con" | "prn" | "aux" | "nul") || port("com") || port("lpt")
}

/// Modification time and length of a file.
pub(crate) fn stamp(path: &Path) -> Option<Stamp> {
    fs::metadata(path).ok().map(|data| stamp_of(&data))
}

fn stamp_of(data: &fs::Metadata) -> Stamp {
    (data.modified().ok(), data.len())
}

/// Whether a file is so new that a later write could have the same stamp.
pub(crate) fn is_fresh((written, _): Stamp) -> bool {
    let Some(written) = written else { return true };
    let now = SystemTime::now();
    let apart = now.duration_since(written).or_else(|_| written.duration_since(now));
    apart.is_ok_and(|apart| apart < COARSE)
}

/// Reads a file; a missing one is empty.
///
/// # Errors
/// A sentence: it is unreadable, not a text or too long.
pub(crate) fn read(path: &Path) -> Result<Kept, String> {
    let wrong = |why: String| format!("cannot read '{}': {why}", path.display());
    let bytes = match afp_output::read_file(path, LONGEST as u64) {
        Ok(bytes) => bytes,
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(Kept::default()),
        Err(error) => return Err(wrong(error.to_string())),
    };
    let etag = Some(etag(&bytes));
    let text = String::from_utf8(bytes).map_err(|_| wrong("it is not UTF-8".to_owned()))?;
    let marked = text.starts_with('\u{feff}');
    let text = if marked { &text['\u{feff}'.len_utf8()..] } else { &text };
    let (text, ends) = (with_newlines(text).into_owned(), LineEnds::of(text));
    Ok(Kept { text, etag, style: Style { marked, ends } })
}

impl Kept {
    /// Writes a new text in this one's format, atomically; returns it and its stamp. Returns `None`
    /// if the file has changed.
    ///
    /// # Errors
    /// It cannot be written, or could not be read back.
    pub(crate) fn write(&self, path: &Path, text: &str) -> Result<Option<(Kept, Stamp)>, String> {
        let mark = if self.style.marked { "\u{feff}" } else { "" };
        let ends = self.style.ends.follow(&self.text, text);
        let bytes = format!("{mark}{}", ends.applied(text)).into_bytes();
        check_length(bytes.len())?;
        let is_as_known = || read(path).is_ok_and(|now| now.etag == self.etag);
        let data =
            afp_output::write_if(path, &bytes, is_as_known).map_err(|why| why.to_string())?;
        let style = Style { marked: self.style.marked, ends };
        let kept = Kept { text: text.to_owned(), etag: Some(etag(&bytes)), style };
        Ok(data.map(|data| (kept, stamp_of(&data))))
    }
}

/// Rejects a length above the limit.
pub(crate) fn check_length(bytes: usize) -> Result<(), String> {
    let most = LONGEST >> 20;
    match bytes > LONGEST {
        true => {
            Err(format!("it is longer than {most} MiB: shorten it, or split it into two files"))
        }
        false => Ok(()),
    }
}

fn etag(bytes: &[u8]) -> String {
    let mut hasher = DefaultHasher::new();
    bytes.hash(&mut hasher);
    format!("{:016x}", hasher.finish())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn links_and_paths_cannot_leave_the_folder() {
        let place = tempfile::tempdir().unwrap();
        let root = place.path().join("in");
        fs::create_dir_all(root.join("sub")).unwrap();
        fs::write(place.path().join("out.afp"), "").unwrap();
        fs::write(root.join("a.afp"), "").unwrap();
        let folder = Folder::new(&root).unwrap();
        let inside = |name: &str| folder.inside(root.join(name).to_str().unwrap());
        for fine in ["a.afp", "new.afp", "sub/new.afp.layout", "afp.toml", "sub/../a.afp"] {
            assert!(inside(fine).is_ok(), "{fine}: {:?}", inside(fine));
        }
        for wrong in [
            "../out.afp",
            "../new.afp",
            "sub/../../out.afp",
            "none/new.afp",
            "a.sh",
            "target",
            "CON.afp",
            "sub/lpt1.afp.layout",
        ] {
            assert!(inside(wrong).is_err(), "{wrong}");
        }
        #[cfg(unix)]
        {
            std::os::unix::fs::symlink(place.path().join("out.afp"), root.join("link.afp"))
                .unwrap();
            std::os::unix::fs::symlink(place.path().join("none.afp"), root.join("dead.afp"))
                .unwrap();
            std::os::unix::fs::symlink(place.path(), root.join("up")).unwrap();
            for wrong in ["link.afp", "dead.afp", "up/out.afp", "up/new.afp"] {
                assert!(inside(wrong).is_err(), "{wrong}");
            }
            std::os::unix::fs::symlink(root.join("a.afp"), root.join("same.afp")).unwrap();
            let listed: Vec<_> = folder.list().files.into_keys().collect();
            let names: Vec<_> = listed.iter().map(|path| folder.name(path)).collect();
            assert_eq!(names, ["a.afp", "same.afp"], "links to the outside are not listed");
        }
    }

    #[test]
    fn line_ends_and_byte_order_marks_stay() {
        let place = tempfile::tempdir().unwrap();
        let path = place.path().join("a.afp");
        for (bytes, text, after) in [
            ("a\nb\n", "a\nb\n", "a\nc\n"),
            ("a\r\nb\r\n", "a\nb\n", "a\r\nc\r\n"),
            ("\u{feff}a\r\nb\r\n", "a\nb\n", "\u{feff}a\r\nc\r\n"),
            ("a\r\nb\n", "a\nb\n", "a\r\nc\n"),
            ("a\nb\r\nx\ry", "a\nb\nx\ny", "a\nc\r\nx\ry"),
        ] {
            fs::write(&path, bytes).unwrap();
            let kept = read(&path).unwrap();
            assert_eq!(kept.text, text);
            let (next, written) = kept.write(&path, &text.replace('b', "c")).unwrap().unwrap();
            assert_eq!(fs::read_to_string(&path).unwrap(), after);
            assert_eq!(stamp(&path), Some(written));
            assert_eq!(read(&path).unwrap(), next);
        }
        fs::write(&path, [0xff, 0xfe]).unwrap();
        assert!(read(&path).unwrap_err().contains("not UTF-8"));
        assert_eq!(read(&place.path().join("none.afp")).unwrap(), Kept::default());
    }

    #[test]
    fn a_save_keeps_the_latest_change_of_another_program() {
        let place = tempfile::tempdir().unwrap();
        let path = place.path().join("a.afp");
        fs::write(&path, "a\n").unwrap();
        let kept = read(&path).unwrap();
        fs::write(&path, "theirs\n").unwrap();
        assert_eq!(kept.write(&path, "mine\n"), Ok(None));
        assert_eq!(fs::read_to_string(&path).unwrap(), "theirs\n");
        assert_eq!(fs::read_dir(place.path()).unwrap().count(), 1);
    }

    #[test]
    fn a_text_that_cannot_be_read_back_is_not_written() {
        let place = tempfile::tempdir().unwrap();
        let path = place.path().join("a.afp");
        fs::write(&path, "a\r\nb\r\n").unwrap();
        let kept = read(&path).unwrap();
        // Each line gets its `\r`.
        let lines = "\n".repeat(LONGEST / 2);
        let written = |text: &str| kept.write(&path, text).map(drop);
        assert!(written(&format!("{lines}a")).is_err_and(|why| why.contains("4 MiB")));
        assert_eq!(read(&path).unwrap(), kept);
        written(&lines).unwrap();
        assert!(read(&path).is_ok_and(|kept| kept.text == lines));
    }
}
