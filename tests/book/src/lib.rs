//! The code blocks of the book in `docs/`, for the tests that keep them true.
//!
//! The word behind a block's fence says what is in it, tags behind commas how it is checked:
//!
//! | fence | how it is checked |
//! |---|---|
//! | `afp` | a plan or toolbox that compiles without a diagnostic, in canonical form; the plan runs |
//! | `afp,fragment` | a part of one, without syntax errors |
//! | `afp,error=E0203+E0211` | exactly these codes |
//! | `rust` | compiled with the Rust above it on the page; its tests run |
//! | `console` | commands behind `$ `, and what they print; `...` stands for anything |
//! | `sh` | commands; those of `afpc` succeed |
//! | `toml,world`, `toml,project`, `toml,cargo` | read as a world, as `afp.toml`, as a manifest |
//! | `text` | an excerpt |
//! | `ebnf` | the grammar: the parser takes random sentences of it |
//!
//! `of=PATH` says that a block is an excerpt of that file, seen from `examples/vacuum`, to the letter.
//! `set=ENTRY=VALUE` gives a plan an input that it needs to run. `file=NAME` puts a block's text into a file of that name, for the blocks after it on the page.

pub mod rust;

use std::path::Path;
use std::{fs, io};

/// Where the book is, seen from this package.
pub const DOCS: &str = "../../docs";

/// A fenced block of a page.
#[derive(Clone, Debug)]
pub struct Block {
    /// The page, without its ending.
    pub page: String,
    /// The line of its fence, from 1.
    pub line: usize,
    /// The word behind the fence.
    pub kind: String,
    /// What follows the word, `name` or `name=value`.
    pub tags: Vec<String>,
    /// The text between the fences.
    pub text: String,
}

impl Block {
    /// Whether a tag is there.
    pub fn has(&self, tag: &str) -> bool {
        self.tags.iter().any(|each| each == tag)
    }

    /// The value of a tag.
    pub fn value(&self, tag: &str) -> Option<&str> {
        self.tags.iter().find_map(|each| each.strip_prefix(tag)?.strip_prefix('='))
    }

    /// Page and line, as editors jump to them.
    pub fn place(&self) -> String {
        format!("docs/{}.md:{}", self.page, self.line)
    }
}

/// The pages written by hand, by name without ending, sorted: all but the pages of codes, which are
/// tested with the compiler.
///
/// # Errors
/// A file cannot be read.
pub fn pages(docs: &Path) -> io::Result<Vec<(String, String)>> {
    let mut pages = Vec::new();
    for entry in fs::read_dir(docs)? {
        let path = entry?.path();
        if path.extension().is_some_and(|ending| ending == "md") {
            let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
            pages.push((name, fs::read_to_string(&path)?));
        }
    }
    pages.sort();
    Ok(pages)
}

/// The blocks of all pages, in order.
///
/// # Errors
/// A file cannot be read; a fence is indented or not closed.
pub fn blocks(docs: &Path) -> io::Result<Vec<Block>> {
    let mut all = Vec::new();
    for (page, text) in pages(docs)? {
        let found = blocks_of(&page, &text).map_err(|line| {
            io::Error::other(format!("docs/{page}.md:{line}: an indented or open fence"))
        })?;
        all.extend(found);
    }
    Ok(all)
}

/// The blocks of a page, or the line of a fence that is wrong.
fn blocks_of(page: &str, text: &str) -> Result<Vec<Block>, usize> {
    let mut blocks: Vec<Block> = Vec::new();
    let mut open = false;
    for (number, line) in text.lines().enumerate() {
        let fence = line.strip_prefix("```");
        match (fence, open) {
            (Some(""), true) => open = false,
            (Some(info), false) => {
                open = true;
                blocks.push(block(page, number + 1, info));
            }
            (Some(_), true) => return Err(number + 1),
            (None, _) if line.trim_start().starts_with("```") => return Err(number + 1),
            (None, true) => {
                if let Some(block) = blocks.last_mut() {
                    block.text += line;
                    block.text.push('\n');
                }
            }
            (None, false) => {}
        }
    }
    match (open, blocks.last()) {
        (true, Some(block)) => Err(block.line),
        _ => Ok(blocks),
    }
}

fn block(page: &str, line: usize, info: &str) -> Block {
    let mut words = info.split(',').map(str::to_owned);
    let kind = words.next().unwrap_or_default();
    Block { page: page.to_owned(), line, kind, tags: words.collect(), text: String::new() }
}
