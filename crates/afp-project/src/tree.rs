use std::collections::{HashSet, VecDeque};
use std::path::{Path, PathBuf};
use std::{fs, io};

use crate::path::NAME;

/// Maximum depth of the search.
const DEPTH: usize = 12;

/// A project's folders for scenarios, in addition to its root.
const SCENARIOS: [&str; 3] = ["plans", "tests", "scenarios"];

/// The files below a folder.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Listing {
    /// Plans, toolboxes, scenarios and project files, by path.
    pub files: Vec<PathBuf>,
    /// Logs of runs, including logs in build folders, by path.
    pub logs: Vec<PathBuf>,
    /// Number of visited folder entries.
    pub entries: usize,
    /// Whether the list is incomplete: the deepest folders were skipped.
    pub is_cut: bool,
}

/// An unreadable folder, and the reason.
pub type Unread = (PathBuf, io::Error);

/// Lists the files below a folder, the nearest first, visiting at most `most` entries. Skips hidden
/// folders, build folders, unreadable folders, and links to folders.
pub fn list(folder: &Path, most: usize) -> Listing {
    let built = Inner { path: folder.join("target/afp"), depth: DEPTH, built: true };
    let own = Inner { path: folder.to_owned(), depth: DEPTH, built: false };
    Walk::default().through([own, built], most).found
}

/// Plans, toolboxes, scenarios and project files below a folder, by path, as in [`list`] without a
/// limit.
pub fn files(folder: &Path) -> Vec<PathBuf> {
    let own = Inner { path: folder.to_owned(), depth: DEPTH, built: false };
    Walk::default().through([own], usize::MAX).found.files
}

/// Like [`files`], but complete: follows links to folders.
///
/// # Errors
/// An unreadable folder.
pub fn all_files(folder: &Path) -> Result<Vec<PathBuf>, Unread> {
    let own = Inner { path: folder.to_owned(), depth: DEPTH, built: false };
    Walk::missing_none().through([own], usize::MAX).whole()
}

/// The files of [`all_files`] in a project's folders for scenarios.
///
/// # Errors
/// An unreadable folder.
pub fn scenario_files(folder: &Path) -> Result<Vec<PathBuf>, Unread> {
    let inner = |name| Inner { path: folder.join(name), depth: DEPTH - 1, built: false };
    let own = Inner { path: folder.to_owned(), depth: 0, built: false };
    let folders = [own].into_iter().chain(SCENARIOS.map(inner));
    Walk::missing_none().through(folders, usize::MAX).whole()
}

/// A folder to visit.
struct Inner {
    path: PathBuf,
    /// Depth of the folder.
    depth: usize,
    /// Whether it is a build folder: only its logs matter.
    built: bool,
}

#[derive(Default)]
struct Walk {
    found: Listing,
    waiting: VecDeque<Inner>,
    /// Whether to follow links to folders.
    follows: bool,
    /// Folders reached by links, so that none is visited twice.
    linked: HashSet<PathBuf>,
    unread: Option<Unread>,
}

impl Walk {
    fn missing_none() -> Walk {
        Walk { follows: true, ..Walk::default() }
    }

    fn through(mut self, folders: impl IntoIterator<Item = Inner>, most: usize) -> Walk {
        self.waiting.extend(folders);
        'all: while let Some(folder) = self.waiting.pop_front() {
            let entries = match fs::read_dir(&folder.path) {
                Ok(entries) => entries,
                Err(error) => {
                    // A missing folder has no files.
                    if error.kind() != io::ErrorKind::NotFound {
                        self.unread.get_or_insert((folder.path, error));
                    }
                    continue;
                }
            };
            for entry in entries.flatten() {
                if self.found.entries == most {
                    self.found.is_cut = true;
                    break 'all;
                }
                self.found.entries += 1;
                self.add(&folder, &entry);
            }
        }
        self.found.files.sort();
        self.found.logs.sort();
        self
    }

    /// All files, if all folders were readable.
    fn whole(self) -> Result<Vec<PathBuf>, Unread> {
        self.unread.map_or(Ok(self.found.files), Err)
    }

    fn add(&mut self, folder: &Inner, entry: &fs::DirEntry) {
        let (name, path) = (entry.file_name(), entry.path());
        let name = name.to_string_lossy();
        let Ok(kind) = entry.file_type() else { return };
        let is_link = kind.is_symlink();
        if kind.is_dir() || self.follows && is_link && path.is_dir() {
            let built = matches!(&*name, "target" | "node_modules") || name.starts_with('.');
            if folder.depth == 0 || built {
                return;
            }
            if !is_link || path.canonicalize().is_ok_and(|it| self.linked.insert(it)) {
                self.waiting.push_back(Inner { path, depth: folder.depth - 1, ..*folder });
            }
            return;
        }
        let is_text = (name.ends_with(".afp") || name == NAME) && !folder.built;
        // Excludes pipes, which would block their reader; a broken link is reported when it is
        // read.
        let is_file = path.is_file() || self.follows && is_link && !path.exists();
        if (is_text || name.ends_with(".mcap")) && is_file {
            let kind = if is_text { &mut self.found.files } else { &mut self.found.logs };
            kind.push(path);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_files_are_found_first() {
        let place = tempfile::tempdir().unwrap();
        let path = |name: &str| place.path().join(name);
        for name in ["a.afp", "b/c/d.afp", "b/e.mcap", "target/afp/f.mcap", "target/afp/g.afp"] {
            fs::create_dir_all(path(name).parent().unwrap()).unwrap();
            fs::write(path(name), "").unwrap();
        }
        for name in
            ["target/h.afp", "node_modules/i.afp", ".j/k.afp", "plans/tests/l.afp", "x/plans/m.afp"]
        {
            fs::create_dir_all(path(name).parent().unwrap()).unwrap();
            fs::write(path(name), "").unwrap();
        }
        let all = list(place.path(), 100);
        let names = |paths: &[PathBuf]| {
            let short = paths.iter().map(|it| it.strip_prefix(place.path()).unwrap().to_str());
            short.map(|name| name.unwrap().replace('\\', "/")).collect::<Vec<_>>().join(" ")
        };
        assert_eq!(names(&all.files), "a.afp b/c/d.afp plans/tests/l.afp x/plans/m.afp");
        assert_eq!(names(&all.logs), "b/e.mcap target/afp/f.mcap");
        assert!(!all.is_cut && list(place.path(), all.entries) == all);
        let cut = list(place.path(), 8);
        assert!(cut.is_cut && names(&cut.files) == "a.afp", "{cut:?}");
        assert_eq!(files(place.path()), all.files);
        assert_eq!(names(&scenario_files(place.path()).unwrap()), "a.afp plans/tests/l.afp");
    }

    #[cfg(unix)]
    #[test]
    fn a_complete_walk_follows_links_and_reports_unreadable_files() {
        use std::os::unix::fs::symlink;

        let place = tempfile::tempdir().unwrap();
        let path = |name: &str| place.path().join(name);
        for folder in ["plans/own", "common"] {
            fs::create_dir_all(path(folder)).unwrap();
        }
        fs::write(path("common/a.afp"), "").unwrap();
        symlink("../common", path("plans/linked")).unwrap();
        symlink("..", path("plans/own/circle")).unwrap();
        // Skipped folders do not hide others.
        symlink("common", path("lib")).unwrap();
        symlink("../common", path("plans/.hidden")).unwrap();
        symlink("nowhere.afp", path("plans/lost.afp")).unwrap();
        let found = scenario_files(place.path()).unwrap();
        let has = |name: &str| found.contains(&path(name));
        assert!(has("plans/linked/a.afp") && has("plans/lost.afp"), "{found:?}");
        assert!(found.len() < 10, "{found:?}");
        assert_eq!(files(place.path()), [path("common/a.afp")]);
        // A file instead of a folder is always unreadable as one.
        fs::write(path("tests"), "").unwrap();
        assert_eq!(scenario_files(place.path()).unwrap_err().0, path("tests"));
    }
}
