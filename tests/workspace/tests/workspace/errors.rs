//! Errors that may get new variants are `non_exhaustive`.

use std::fs;

use afp_workspace::root;

use crate::sources::rust_files;

/// Errors that both ends of the workspace must know, so that a forgotten variant does not compile.
const OURS: [&str; 1] = ["afp-types/src/lib.rs: Error"];

/// The public error enums of a text without `non_exhaustive`.
fn exhaustive(text: &str) -> Vec<&str> {
    let mut found = Vec::new();
    let mut open = true;
    for line in text.lines() {
        if let Some(rest) = line.strip_prefix("pub enum ") {
            let name = rest.split([' ', '<']).next().unwrap_or(rest);
            if open && name.ends_with("Error") {
                found.push(name);
            }
        }
        open = line != "#[non_exhaustive]";
    }
    found
}

#[test]
fn errors_may_get_more_kinds() {
    let crates = root().join("crates");
    let mut wrong = Vec::new();
    for file in rust_files(&crates) {
        let shown = file.strip_prefix(&crates).unwrap().display().to_string();
        let text = fs::read_to_string(&file).unwrap();
        wrong.extend(exhaustive(&text).iter().map(|name| format!("{shown}: {name}")));
    }
    wrong.retain(|each| !OURS.contains(&each.as_str()));
    assert!(wrong.is_empty(), "write '#[non_exhaustive]' above: {wrong:#?}");
}

#[test]
fn an_exhaustive_error_is_found() {
    let text =
        "#[non_exhaustive]\npub enum AError {\n}\npub enum BError<E> {\n}\npub enum Go {\n}\n";
    assert_eq!(exhaustive(text), ["BError"]);
}
