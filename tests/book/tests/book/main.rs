//! The book matches the code: its blocks compile, its lists are complete, and its links have
//! targets.
//!
//! A test of `afpc` compares its output. `AFP_BLESS=1` rewrites the lists.

mod afp_blocks;
mod excerpts;
mod gallery;
mod grammar;
mod lists;
mod pages;
mod prose;
mod rust_blocks;
mod safety;
mod toml_blocks;

use std::path::{Path, PathBuf};

use afp_book::Block;
use afp_dsl::Toolboxes;

/// The book's folder.
fn docs() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(afp_book::DOCS)
}

fn blocks(kind: &str) -> Vec<Block> {
    blocks_where(|block| block.kind == kind)
}

fn blocks_where(holds: impl Fn(&Block) -> bool) -> Vec<Block> {
    let mut blocks = afp_book::blocks(&docs()).unwrap();
    blocks.retain(holds);
    blocks
}

/// The built-in toolboxes.
fn toolboxes() -> Toolboxes {
    afp_toolboxes::sources().collect()
}

/// Compares a text of the book with its expected content, or rewrites it with `AFP_BLESS=1`.
#[track_caller]
fn compare(file: &str, actual: &str, wanted: &str) {
    if actual != wanted && std::env::var_os("AFP_BLESS").is_some() {
        std::fs::write(docs().join(file), wanted).unwrap();
        return;
    }
    assert!(
        actual == wanted,
        "docs/{file} is behind; AFP_BLESS=1 cargo test -p afp-book writes:\n{wanted}"
    );
}
