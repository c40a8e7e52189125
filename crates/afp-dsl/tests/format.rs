//! Every shipped plan and toolbox is in canonical form.
//!
//! `AFP_BLESS=1` rewrites them; read the diff like code.

use std::fs;
use std::path::{Path, PathBuf};

/// Folders of `.afp` files that people read as examples.
const FOLDERS: &[&str] =
    &["plans", "crates/afp-toolboxes/toolboxes", "bench/plans", "bench/toolbox"];

fn files(folder: &str) -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(folder);
    let mut files: Vec<_> =
        fs::read_dir(folder).unwrap().map(|each| each.unwrap().path()).collect();
    files.retain(|path| path.extension().is_some_and(|ending| ending == "afp"));
    files.sort();
    files
}

#[test]
fn shipped_files_are_formatted() {
    let mut wrong = Vec::new();
    for path in FOLDERS.iter().flat_map(|folder| files(folder)) {
        let text = fs::read_to_string(&path).unwrap();
        let formatted = afp_dsl::format(&text).unwrap_or_else(|_| panic!("{}", path.display()));
        if formatted == text {
            continue;
        }
        match std::env::var_os("AFP_BLESS") {
            Some(_) => fs::write(&path, formatted).unwrap(),
            None => wrong.push(path),
        }
    }
    assert!(wrong.is_empty(), "run 'afpc fmt' on {wrong:?}");
}
