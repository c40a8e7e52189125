//! The handwritten Rust, file by file.

use std::fs;
use std::path::{Path, PathBuf};

/// Generated Rust: by the code generator, and from the log's messages.
const GENERATED: [&str; 2] = ["tests/codegen", "src/proto"];

/// The handwritten Rust files below a folder.
pub fn rust_files(folder: &Path) -> Vec<PathBuf> {
    let below = |path: PathBuf| {
        let is_ours = |path: &Path| {
            !path.ends_with("target") && !GENERATED.iter().any(|folder| path.ends_with(folder))
        };
        let is_rust = path.extension().is_some_and(|extension| extension == "rs");
        match path.is_dir() {
            true if is_ours(&path) => rust_files(&path),
            false if is_rust => vec![path],
            _ => Vec::new(),
        }
    };
    let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    entries.flat_map(below).collect()
}
