//! The grammar in the book: the parser accepts random sentences of it, and has no other keywords.

mod ebnf;

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use afp_syntax::diagnostics::Diagnostics;
use afp_syntax::{Kind, parse};

use crate::{blocks, docs};
use ebnf::Grammar;

/// The number of random files.
const SENTENCES: u64 = 6000;

/// Keywords that the tree marks as names; the checks interpret them.
const MARKED_AS_NAMES: &[&str] = &["ignore", "true", "false"];

fn grammar() -> Grammar {
    let blocks = blocks("ebnf");
    assert_eq!(blocks.len(), 1, "the grammar is in one place");
    Grammar::parse(&blocks[0].text)
}

#[test]
fn the_parser_takes_every_sentence_of_the_grammar() {
    let grammar = grammar();
    for seed in 0..SENTENCES {
        let text = grammar.sentence("file", seed);
        let mut diags = Diagnostics::default();
        parse(&text, 0, &mut diags);
        let found: Vec<_> = diags.iter().map(|each| (each.code, each.message_text())).collect();
        assert!(found.is_empty(), "seed {seed}: {found:?} in\n{text}");
    }
}

#[test]
fn the_words_of_the_grammar_are_those_of_the_parser() {
    let grammar = grammar();
    let sentences = (0..SENTENCES).flat_map(|seed| keywords(&grammar.sentence("file", seed)));
    let mut taken: BTreeSet<String> = sentences.collect();
    // The verb of an action is a name that the tree marks as a keyword.
    taken.retain(|word| !word.starts_with(ebnf::NAME));
    let mut written = grammar.words();
    written.retain(|word| !MARKED_AS_NAMES.contains(&word.as_str()));
    assert_eq!(taken, written, "words that the parser takes, and words of the grammar");
    // The last one is a common misspelling of 'never'.
    let verbs = ["press", "release", "fail", "fire", "finish", "idle", "hit", "not"];
    for file in files(&Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")) {
        for word in keywords(&fs::read_to_string(&file).unwrap()) {
            let known = written.contains(&word) || verbs.contains(&word.as_str());
            assert!(known, "'{word}' in {} is not in the grammar", file.display());
        }
    }
}

#[test]
fn the_words_that_the_book_colours_are_those_of_the_grammar() {
    let script = fs::read_to_string(docs().join("theme/afp.js")).unwrap();
    let (_, list) = script.split_once("const words =").unwrap();
    let list = list.split(';').next().unwrap().replace(['"', '+'], " ");
    let coloured: BTreeSet<String> = list.split_whitespace().map(str::to_owned).collect();
    assert_eq!(coloured, grammar().words());
}

/// The keywords in a text; none if it has errors, since recovery may read a name as a keyword.
fn keywords(text: &str) -> Vec<String> {
    let mut diags = Diagnostics::default();
    let root = parse(text, 0, &mut diags).root();
    if diags.has_errors() {
        return Vec::new();
    }
    let tokens = root.descendants_with_tokens().filter_map(|each| each.into_token());
    tokens.filter(|token| token.kind() == Kind::Keyword).map(|token| token.to_string()).collect()
}

/// All plans and toolboxes of the project.
fn files(root: &Path) -> Vec<PathBuf> {
    let mut folders: Vec<_> =
        ["crates", "plans", "tests", "examples"].map(|name| root.join(name)).into();
    let mut files = Vec::new();
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|ending| ending == "afp") {
                files.push(path);
            }
        }
    }
    files
}
