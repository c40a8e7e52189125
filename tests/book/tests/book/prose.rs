//! Plain English: pages and code keep the rules that a pattern can find.
//!
//! A hit of a blocking rule is allowed only if [`ALLOWED`] lists its words. For the other rules,
//! `prose.txt` has the number of hits of each folder. `AFP_BLESS=1` updates the numbers, but never
//! with a higher sum.

mod rules;
mod sentences;

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use rules::Rules;

use crate::docs;

/// Words of a file that look like a hit and are right, at most 40.
const ALLOWED: &[(&str, &str)] = &[
    ("ARCHITECTURE.md", "what"),
    // Hashes of traces contain the text of a fault.
    ("crates/afp-carbot/src/helpers/guard.rs", "was to be"),
];

/// The file with the numbers.
const COUNTS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/prose.txt");

/// The folders with handwritten code in Rust, Python or TypeScript.
const CODE: [&str; 9] =
    ["bench", "crates", "editors", "examples", "firmware", "python", "studio", "tests", "xtask"];

/// Folders inside of these without handwritten code.
const GENERATED: [&str; 5] = ["target", "node_modules", "built", "dist", ".venv"];

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
fn pages_and_code_keep_the_blocking_rules() {
    assert!(ALLOWED.len() <= 40);
    let rules = Rules::blocking();
    let mut found = Vec::new();
    for (path, sentences) in read() {
        for (line, sentence) in sentences {
            for (rule, words) in rules.hits(&sentence) {
                if !ALLOWED.contains(&(path.as_str(), words.as_str())) {
                    found.push(format!("{path}:{line}: {rule}: '{words}' in: {sentence}"));
                }
            }
        }
    }
    assert!(found.is_empty(), "{}", found.join("\n"));
}

#[test]
fn the_counts_only_fall() {
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
        "more hits; AFP_PROSE=FOLDER and --nocapture show them:\n{}",
        more.join("\n")
    );
}

/// The sentences of all pages and all code, by path from the root of the workspace.
fn read() -> Vec<(String, Vec<(usize, String)>)> {
    let mut read = Vec::new();
    for page in pages() {
        let text = fs::read_to_string(root().join(&page)).unwrap();
        read.push((page, sentences::of_page(&text)));
    }
    for file in CODE.iter().flat_map(|folder| code_files(&root().join(folder))) {
        let path = file.strip_prefix(root()).unwrap().to_string_lossy().replace('\\', "/");
        let found = sentences::of_code(&path, &fs::read_to_string(&file).unwrap());
        read.push((path, found));
    }
    read
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

/// The hits of the counted rules in each folder.
fn counted() -> BTreeMap<String, usize> {
    let rules = Rules::counted();
    let show = std::env::var("AFP_PROSE").unwrap_or_default();
    let mut counts = BTreeMap::new();
    for (path, sentences) in read() {
        let name = package(&path);
        let count = counts.entry(name.clone()).or_default();
        for (line, sentence) in sentences {
            for (rule, words) in rules.hits(&sentence) {
                *count += 1;
                if show == name {
                    println!("{path}:{line}: {rule}: '{words}' in: {sentence}");
                }
            }
        }
    }
    counts
}

/// The folder of a crate, `crates/afp-dsl` or `xtask`; `.` for pages of the root.
fn package(path: &str) -> String {
    let parts: Vec<&str> = path.split('/').collect();
    match parts[..] {
        [_] => ".".to_owned(),
        [folder @ ("crates" | "examples" | "editors"), name, ..] => format!("{folder}/{name}"),
        _ => parts[0].to_owned(),
    }
}

fn code_files(folder: &Path) -> Vec<PathBuf> {
    let mut files = Vec::new();
    let Ok(entries) = fs::read_dir(folder) else { return files };
    for path in entries.map(|entry| entry.unwrap().path()) {
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        if path.is_dir() && !GENERATED.contains(&name.as_str()) {
            files.extend(code_files(&path));
        } else if [".rs", ".py", ".pyi", ".ts", ".tsx"].iter().any(|end| name.ends_with(end)) {
            files.push(path);
        }
    }
    files
}
