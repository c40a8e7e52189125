//! Plain English: the pages keep the rules that a pattern can find, and the Rust has fewer hits each time.
//!
//! A page may break a rule only if [`ALLOWED`] lists the words. For the Rust of each crate (comments,
//! strings, names of tests), `prose.txt` has the number of hits. `AFP_BLESS=1` updates the numbers, but
//! never with a higher sum.

mod rules;
mod sentences;

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use rules::Rules;

use crate::docs;

/// Words on a page that look like a hit and are right, at most 40.
const ALLOWED: &[(&str, &str)] = &[("ARCHITECTURE.md", "what")];

/// The file with the numbers.
const COUNTS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/prose.txt");

/// The folders with handwritten Rust.
const RUST: [&str; 6] = ["bench", "crates", "examples", "firmware", "tests", "xtask"];

fn root() -> PathBuf {
    docs().join("..")
}

/// The pages, by their path from the root of the workspace.
fn pages() -> Vec<String> {
    let top = ["README.md", "ARCHITECTURE.md", "CHANGELOG.md", "CONTRIBUTING.md"];
    let parts = ["editors/tree-sitter-afp", "editors/vscode", "examples/vacuum", "python"];
    let mut pages: Vec<String> = top.map(String::from).into();
    pages.extend(parts.map(|part| format!("{part}/README.md")));
    for folder in ["docs", "docs/errors"] {
        for file in fs::read_dir(root().join(folder)).unwrap() {
            let name = file.unwrap().file_name().to_string_lossy().into_owned();
            if name.ends_with(".md") && name != "SUMMARY.md" {
                pages.push(format!("{folder}/{name}"));
            }
        }
    }
    pages.sort();
    pages
}

#[test]
fn pages_are_in_plain_english() {
    assert!(ALLOWED.len() <= 40);
    let rules = Rules::new();
    let mut found = Vec::new();
    for page in pages() {
        let text = fs::read_to_string(root().join(&page)).unwrap();
        for (line, sentence) in sentences::of_page(&text) {
            for (rule, words) in rules.hits(&sentence) {
                if !ALLOWED.contains(&(page.as_str(), words.as_str())) {
                    found.push(format!("{page}:{line}: {rule}: '{words}' in: {sentence}"));
                }
            }
        }
    }
    assert!(found.is_empty(), "{}", found.join("\n"));
}

#[test]
fn rust_gets_plainer() {
    let (old, new) = (recorded(), counted());
    if std::env::var_os("AFP_BLESS").is_some() {
        let sum = |counts: &BTreeMap<String, usize>| counts.values().sum::<usize>();
        assert!(old.is_empty() || sum(&new) <= sum(&old), "more hits than in prose.txt");
        let row = |(name, count): (&String, &usize)| format!("{count:5} {name}\n");
        fs::write(COUNTS, new.iter().map(row).collect::<String>()).unwrap();
        return;
    }
    let more: Vec<_> = new
        .iter()
        .filter(|(name, count)| old.get(*name).is_none_or(|old| *count > old))
        .map(|(name, count)| format!("{name}: {count}, was {:?}", old.get(name)))
        .collect();
    assert!(
        more.is_empty(),
        "hits in comments, strings or names of tests; AFP_PROSE=FOLDER and --nocapture show them:\n{}",
        more.join("\n")
    );
}

/// The numbers of `prose.txt`, by folder.
fn recorded() -> BTreeMap<String, usize> {
    let text = fs::read_to_string(COUNTS).unwrap_or_default();
    let row = |line: &str| {
        let (count, name) = line.trim().split_once(' ')?;
        Some((name.to_owned(), count.parse().ok()?))
    };
    text.lines().filter_map(row).collect()
}

/// The hits in the Rust of each crate.
fn counted() -> BTreeMap<String, usize> {
    let rules = Rules::new();
    let show = std::env::var("AFP_PROSE").unwrap_or_default();
    let mut counts = BTreeMap::new();
    for folder in RUST {
        for file in rust_files(&root().join(folder)) {
            let path = file.strip_prefix(root()).unwrap().to_string_lossy().replace('\\', "/");
            let name = package(&path);
            let text = fs::read_to_string(&file).unwrap();
            let strings = match path.contains("/tests/") {
                true => Vec::new(),
                false => sentences::of_strings(&text),
            };
            for (line, sentence) in sentences::of_rust(&text).into_iter().chain(strings) {
                for (rule, words) in rules.hits(&sentence) {
                    *counts.entry(name.clone()).or_default() += 1;
                    if show == name {
                        println!("{path}:{line}: {rule}: '{words}' in: {sentence}");
                    }
                }
            }
            counts.entry(name).or_default();
        }
    }
    counts
}

/// The folder of a crate, `crates/afp-dsl` or `xtask`.
fn package(path: &str) -> String {
    let parts: Vec<&str> = path.split('/').collect();
    let depth = if ["crates", "examples"].contains(&parts[0]) { 2 } else { 1 };
    parts[..depth].join("/")
}

fn rust_files(folder: &Path) -> Vec<PathBuf> {
    let mut files = Vec::new();
    let Ok(entries) = fs::read_dir(folder) else { return files };
    for path in entries.map(|entry| entry.unwrap().path()) {
        if path.is_dir() && path.file_name().is_none_or(|name| name != "target") {
            files.extend(rust_files(&path));
        } else if path.extension().is_some_and(|end| end == "rs") {
            files.push(path);
        }
    }
    files
}
