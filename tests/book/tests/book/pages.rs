//! Pages: each is in the table of contents, each link has a target, and each block is checked.

use std::fs;

use afp_book::{blocks, pages};

use crate::docs;

/// The kinds of checked blocks.
const KINDS: &[&str] = &["afp", "rust", "toml", "console", "sh", "ebnf", "python", "lua", "text"];

#[test]
fn no_block_goes_unchecked() {
    for block in blocks(&docs()).unwrap() {
        assert!(KINDS.contains(&block.kind.as_str()), "{}: '{}'", block.place(), block.kind);
    }
}

#[test]
fn every_page_is_in_the_table_of_contents() {
    let contents = fs::read_to_string(docs().join("SUMMARY.md")).unwrap();
    for (page, _) in pages(&docs()).unwrap() {
        let listed = contents.contains(&format!("({page}.md)")) || page == "SUMMARY";
        assert!(listed, "SUMMARY.md does not list {page}.md");
    }
}

#[test]
fn links_lead_to_pages_and_headings() {
    for (page, text) in pages(&docs()).unwrap() {
        for link in text.split("](").skip(1).filter_map(|rest| rest.split_once(')')) {
            let (file, heading) = link.0.split_once('#').unwrap_or((link.0, ""));
            let draft = link.0.is_empty() && page == "SUMMARY";
            if draft || link.0.starts_with("https://") {
                continue;
            }
            let file = if file.is_empty() { format!("{page}.md") } else { file.to_owned() };
            let there = fs::read(docs().join(&file));
            let there = there.unwrap_or_else(|_| panic!("docs/{page}.md links to {file}"));
            // A picture is not text and has no headings.
            let there = String::from_utf8_lossy(&there);
            let found = heading.is_empty() || headings(&there).any(|each| each == heading);
            assert!(found, "docs/{page}.md links to {file}#{heading}");
        }
    }
}

/// The names of a page's headings in links.
fn headings(text: &str) -> impl Iterator<Item = String> {
    let titles = text.lines().filter(|line| line.starts_with('#'));
    titles.map(|line| heading(line.trim_start_matches('#').trim()))
}

/// The name of a heading in links.
fn heading(title: &str) -> String {
    let title = title.to_lowercase();
    let kept = title.chars().filter(|c| c.is_alphanumeric() || " -_".contains(*c));
    kept.map(|c| if c == ' ' { '-' } else { c }).collect()
}
