//! Generated lists in the book: codes, templates, functions, units, the table of contents.

mod functions;
mod templates;
mod units;

use std::fmt::Write;
use std::fs;

use afp_syntax::diagnostics::Code;

use crate::{compare, docs};

/// The width of a code's page.
const WIDTH: usize = 100;

const GROUPS: &[(&str, &str)] = &[
    ("E01", "Syntax"),
    ("E02", "Names, types and units"),
    ("E03", "Flow"),
    ("E04", "Time"),
    ("E05", "Files, targets and toolboxes"),
    ("E06", "Scenarios"),
];

/// Replaces the text between the list's marks in a page.
fn with_list(page: &str, list: &str) -> String {
    let (begin, end) = ("<!-- list: made by a test -->\n", "<!-- end of list -->");
    let (before, rest) = page.split_once(begin).expect("the mark of the list's begin");
    let (_, after) = rest.split_once(end).expect("the mark of the list's end");
    format!("{before}{begin}{list}{end}{after}")
}

/// Replaces the paragraph of a page with that beginning.
fn with_paragraph(page: &str, begin: &str, text: &str) -> String {
    let text = wrapped(text);
    let mut parts: Vec<_> = page.split("\n\n").collect();
    let part = parts.iter_mut().find(|part| part.starts_with(begin));
    *part.expect("a paragraph that begins so") = &text;
    parts.join("\n\n")
}

/// Wraps a text at [`WIDTH`] letters.
fn wrapped(text: &str) -> String {
    let mut lines = vec![String::new()];
    for word in text.split(' ') {
        match lines.last_mut() {
            Some(line) if line.is_empty() => line.push_str(word),
            Some(line) if line.len() + 1 + word.len() <= WIDTH => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines.join("\n")
}

fn group(prefix: &str) -> impl Iterator<Item = Code> {
    Code::ALL.iter().copied().filter(move |code| code.as_str().starts_with(prefix))
}

#[test]
fn all_codes_are_listed() {
    let mut list = String::new();
    for (prefix, title) in GROUPS {
        let _ = write!(list, "\n## {title}\n\n| code | | what it is about |\n|---|---|---|\n");
        for code in group(prefix) {
            let (name, severity, title) = (code.as_str(), code.severity().as_str(), code.title());
            let _ = writeln!(list, "| [{name}](errors/{name}.md) | {severity} | {title} |");
        }
    }
    list.push('\n');
    let page = fs::read_to_string(docs().join("checks.md")).unwrap();
    compare("checks.md", &page, &with_list(&page, &list));
}

#[test]
fn the_table_of_contents_has_the_page_of_every_code() {
    let mut list = String::new();
    for (prefix, title) in GROUPS {
        // A group has no page.
        let _ = writeln!(list, "  - [{title}]()");
        for code in group(prefix) {
            let name = code.as_str();
            let _ = writeln!(list, "    - [{name}: {}](errors/{name}.md)", code.title());
        }
    }
    list.push_str("  ");
    let page = fs::read_to_string(docs().join("SUMMARY.md")).unwrap();
    compare("SUMMARY.md", &page, &with_list(&page, &list));
}
