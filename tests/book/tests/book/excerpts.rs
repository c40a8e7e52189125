//! Excerpts of the vacuum example: they match its files.

use std::fs;

use crate::{blocks_where, docs};

#[test]
fn excerpts_match_their_files() {
    let excerpts = blocks_where(|block| block.value("of").is_some());
    assert!(!excerpts.is_empty());
    for block in excerpts {
        let file = block.value("of").unwrap_or_default();
        let path = docs().join("../examples/vacuum").join(file);
        let text = fs::read_to_string(&path).unwrap_or_else(|error| panic!("{file}: {error}"));
        assert!(text.contains(&block.text), "{}: not so in {file}:\n{}", block.place(), block.text);
    }
}

#[test]
fn plain_text_is_an_excerpt() {
    for block in blocks_where(|block| block.kind == "text") {
        assert!(block.value("of").is_some(), "{}: says nothing of where it is from", block.place());
    }
}
