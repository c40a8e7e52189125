//! The public names of `afp` and `afp-core`: each is in the book, or in its list with a reason.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use crate::docs;

const PAGE: &str = "public-names.md";

/// The files with public items of the crates.
const ROOTS: [&str; 6] = [
    "afp/src/lib.rs",
    "afp/src/load.rs",
    "afp-core/src/lib.rs",
    "afp-core/src/devices.rs",
    "afp-core/src/trace.rs",
    "afp-core/src/quantity.rs",
];

/// The words between `pub` and a name.
const ITEMS: [&str; 9] =
    ["const fn", "fn", "struct", "enum", "trait", "const", "type", "mod", "macro"];

#[test]
fn every_public_name_is_in_the_book_or_has_a_reason() {
    let (public, listed, told) = (public(), listed(), told());
    assert!(public.len() > 100 && listed.len() > 30, "{} {}", public.len(), listed.len());
    let without: Vec<_> =
        public.iter().filter(|name| !told.contains(*name) && !listed.contains(*name)).collect();
    assert!(without.is_empty(), "neither in the book nor in {PAGE}: {without:?}");
    let stale: Vec<_> = listed.iter().filter(|name| !public.contains(*name)).collect();
    assert!(stale.is_empty(), "in {PAGE} and not public: {stale:?}");
    let twice: Vec<_> = listed.iter().filter(|name| told.contains(*name)).collect();
    assert!(twice.is_empty(), "in {PAGE} and on another page: {twice:?}");
}

/// The public names, without those that documentation hides.
fn public() -> BTreeSet<String> {
    let crates = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../crates");
    ROOTS.iter().flat_map(|root| names(&fs::read_to_string(crates.join(root)).unwrap())).collect()
}

/// The public names of a file's outermost level.
fn names(text: &str) -> Vec<String> {
    let text = text.split("#[cfg(test)]\nmod tests").next().unwrap_or(text);
    let mut names = Vec::new();
    for (at, _) in text.match_indices("\npub ") {
        let (before, item) = (&text[..at], &text[at + "\npub ".len()..]);
        if before.ends_with("#[doc(hidden)]") {
            continue;
        }
        if let Some(used) = item.strip_prefix("use ") {
            names.extend(reexported(used.split(';').next().unwrap_or_default()));
            continue;
        }
        let rest = ITEMS.iter().find_map(|word| item.strip_prefix(word)?.strip_prefix(' '));
        names.extend(rest.and_then(|rest| words(rest).next()));
    }
    names
}

/// The names that `a::{b, c as d}` exports.
fn reexported(path: &str) -> Vec<String> {
    let list = path.split_once('{').map_or(path, |(_, list)| list.trim_end_matches('}'));
    let last = |item: &str| words(item).last();
    list.split(',').filter_map(last).collect()
}

fn listed() -> BTreeSet<String> {
    let text = fs::read_to_string(docs().join(PAGE)).unwrap();
    let rows = text.lines().filter_map(|line| line.strip_prefix("| `")?.split(" | ").next());
    rows.flat_map(|row| words(row).collect::<Vec<_>>()).collect()
}

/// The words in the code of all other pages.
fn told() -> BTreeSet<String> {
    let pages = fs::read_dir(docs()).unwrap().map(|page| page.unwrap().path());
    let pages = pages.filter(|page| page.extension().is_some_and(|ending| ending == "md"));
    let pages = pages.filter(|page| !page.ends_with(PAGE));
    pages.flat_map(|page| code(&fs::read_to_string(page).unwrap())).collect()
}

/// The words between backticks, including blocks: every second piece of the page.
fn code(page: &str) -> Vec<String> {
    page.split('`').skip(1).step_by(2).flat_map(words).collect()
}

fn words(text: &str) -> impl Iterator<Item = String> {
    let parts = text.split(|letter: char| !letter.is_alphanumeric() && letter != '_');
    parts.filter(|word| !word.is_empty()).map(str::to_owned)
}
