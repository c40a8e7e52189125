//! The files of a project's folder.

use std::collections::VecDeque;
use std::fs;
use std::path::{Path, PathBuf};

use crate::file::NAME;

/// Folders deeper than this are not looked into.
const DEPTH: usize = 12;

/// Where a project keeps scenarios, besides its folder itself.
const SCENARIOS: [&str; 3] = ["plans", "tests", "scenarios"];

/// What lies below a folder.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Listing {
    /// The plans, toolboxes and scenarios, and project files, by path.
    pub files: Vec<PathBuf>,
    /// The logs of runs, and those that tools have put where builds go, by path.
    pub logs: Vec<PathBuf>,
    /// How many entries of folders were looked at.
    pub entries: usize,
    /// Whether there are more: the folders farthest in were not looked into.
    pub is_cut: bool,
}

/// What lies below a folder, the nearest first, as far as `most` entries go. Hidden folders and those that builds fill are
/// left out, and so are links to folders, so that no circle is walked.
pub fn list(folder: &Path, most: usize) -> Listing {
    let built = Inner { path: folder.join("target/afp"), depth: DEPTH, built: true };
    walk([Inner { path: folder.to_owned(), depth: DEPTH, built: false }, built], most)
}

/// The plans, toolboxes and scenarios below a folder, and project files, by path: all that [`list`] would find.
pub fn files(folder: &Path) -> Vec<PathBuf> {
    walk([Inner { path: folder.to_owned(), depth: DEPTH, built: false }], usize::MAX).files
}

/// Those of [`files`] that lie where a project keeps scenarios.
pub fn scenario_files(folder: &Path) -> Vec<PathBuf> {
    let inner = |name| Inner { path: folder.join(name), depth: DEPTH - 1, built: false };
    let own = Inner { path: folder.to_owned(), depth: 0, built: false };
    walk([own].into_iter().chain(SCENARIOS.map(inner)), usize::MAX).files
}

/// A folder that is to be looked into.
struct Inner {
    path: PathBuf,
    /// How many folders deep.
    depth: usize,
    /// Whether builds fill it: of its files only logs matter.
    built: bool,
}

fn walk(folders: impl IntoIterator<Item = Inner>, most: usize) -> Listing {
    let mut found = Listing::default();
    let mut waiting: VecDeque<_> = folders.into_iter().collect();
    'all: while let Some(folder) = waiting.pop_front() {
        // What cannot be read has no files.
        let Ok(entries) = fs::read_dir(&folder.path) else { continue };
        for entry in entries.flatten() {
            if found.entries == most {
                found.is_cut = true;
                break 'all;
            }
            found.entries += 1;
            let name = entry.file_name();
            found.add(&folder, &entry, &name.to_string_lossy(), &mut waiting);
        }
    }
    found.files.sort();
    found.logs.sort();
    found
}

impl Listing {
    fn add(
        &mut self,
        folder: &Inner,
        entry: &fs::DirEntry,
        name: &str,
        waiting: &mut VecDeque<Inner>,
    ) {
        let Ok(kind) = entry.file_type() else { return };
        if kind.is_dir() {
            let built = matches!(name, "target" | "node_modules") || name.starts_with('.');
            if folder.depth > 0 && !built {
                waiting.push_back(Inner { path: entry.path(), depth: folder.depth - 1, ..*folder });
            }
            return;
        }
        let is_text = (name.ends_with(".afp") || name == NAME) && !folder.built;
        if (is_text || name.ends_with(".mcap")) && entry.path().is_file() {
            // No pipe, which would keep its reader waiting.
            let kind = if is_text { &mut self.files } else { &mut self.logs };
            kind.push(entry.path());
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
        assert_eq!(names(&scenario_files(place.path())), "a.afp plans/tests/l.afp");
    }
}
