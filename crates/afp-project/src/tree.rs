//! The files of a project's folder.

use std::fs;
use std::path::{Path, PathBuf};

use crate::file::NAME;

/// Folders deeper than this are not looked into.
const DEPTH: usize = 12;

/// The plans, toolboxes and scenarios below a folder, and project files, by path. Hidden folders and those that builds
/// fill are left out, and so are links to folders, so that no circle is walked.
pub fn files(folder: &Path) -> Vec<PathBuf> {
    walk(folder, &|name| name.ends_with(".afp") || name == NAME)
}

/// The logs of runs below a folder, and those that tools have put where builds go.
pub fn logs(folder: &Path) -> Vec<PathBuf> {
    let is_log = |name: &str| name.ends_with(".mcap");
    let mut found = walk(folder, &is_log);
    found.extend(walk(&folder.join("target/afp"), &is_log));
    found
}

fn walk(folder: &Path, wanted: &dyn Fn(&str) -> bool) -> Vec<PathBuf> {
    let mut found = Vec::new();
    collect(folder, DEPTH, wanted, &mut found);
    found.sort();
    found
}

fn collect(folder: &Path, depth: usize, wanted: &dyn Fn(&str) -> bool, found: &mut Vec<PathBuf>) {
    // What cannot be read has no files.
    let Ok(entries) = fs::read_dir(folder) else { return };
    for entry in entries.flatten() {
        let name = entry.file_name();
        let name = name.to_string_lossy();
        let (Ok(kind), path) = (entry.file_type(), entry.path()) else { continue };
        if kind.is_dir() {
            let built = matches!(&*name, "target" | "node_modules") || name.starts_with('.');
            if depth > 0 && !built {
                collect(&path, depth - 1, wanted, found);
            }
        } else if wanted(&name) && path.is_file() {
            // No pipe, which would keep its reader waiting.
            found.push(path);
        }
    }
}
