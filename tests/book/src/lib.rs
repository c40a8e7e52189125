//! The code blocks of the book in `docs/`, for their tests.
//!
//! The word after a block's fence names its content; tags after commas select the check:
//!
//! | fence | check |
//! |---|---|
//! | `afp` | a plan or toolbox that compiles without a diagnostic, in canonical form; the plan runs |
//! | `afp,fragment` | a part of one, without syntax errors |
//! | `afp,error=E0203+E0211` | exactly these codes |
//! | `rust` | compiled with the Rust above it on the page; its tests run |
//! | `console` | commands after `$ `, and their output; `...` matches anything |
//! | `sh` | commands; those of `afpc` succeed |
//! | `toml,world`, `toml,project`, `toml,cargo` | read as a world, as `afp.toml`, as a manifest |
//! | `text` | an excerpt |
//! | `ebnf` | the grammar: the parser accepts random sentences of it |
//!
//! `of=PATH` marks a literal excerpt of that file, relative to `examples/vacuum`. `set=ENTRY=VALUE`
//! gives a plan a required input. `file=NAME` writes a block's text to a file with that name, for
//! later blocks of the page.

pub mod rust;

use std::path::Path;
use std::{fs, io};

/// The book's folder, relative to this package.
pub const DOCS: &str = "../../docs";

/// A fenced block of a page.
#[derive(Clone, Debug)]
pub struct Block {
    /// The page, without its extension.
    pub page: String,
    /// The line of its fence, from 1.
    pub line: usize,
    /// The word after the fence.
    pub kind: String,
    /// The tags, `name` or `name=value`.
    pub tags: Vec<String>,
    /// The text between the fences.
    pub text: String,
}

impl Block {
    pub fn has(&self, tag: &str) -> bool {
        self.tags.iter().any(|each| each == tag)
    }

    pub fn value(&self, tag: &str) -> Option<&str> {
        self.tags.iter().find_map(|each| each.strip_prefix(tag)?.strip_prefix('='))
    }

    /// Page and line in the format of editors.
    pub fn place(&self) -> String {
        format!("docs/{}.md:{}", self.page, self.line)
    }
}

/// The handwritten pages, sorted by name without extension. Pages of codes are tested with the
/// compiler.
///
/// # Errors
/// A file is unreadable.
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
/// A file is unreadable, or a fence is indented or not closed.
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

/// The blocks of a page, or the line of an invalid fence.
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
