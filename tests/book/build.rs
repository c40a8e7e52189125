//! Writes the book's Rust into modules for the tests.

#[allow(dead_code, reason = "how blocks are checked is for the tests")]
#[path = "src/lib.rs"]
mod book;

use std::path::{Path, PathBuf};
use std::{env, fs, io};

fn main() -> io::Result<()> {
    println!("cargo::rerun-if-changed=src");
    println!("cargo::rerun-if-changed={}", book::DOCS);
    let out = PathBuf::from(env::var_os("OUT_DIR").unwrap_or_default());
    let blocks = book::blocks(Path::new(book::DOCS))?;
    fs::write(out.join("rust.rs"), book::rust::modules(&blocks, &out)?)
}
