//! The book's Rust as modules for a test.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::Path;
use std::{fs, io};

use super::Block;

/// The parent of the pages' modules.
const HOME: &str = "rust_blocks";

/// Writes a module for each page with Rust: its blocks in order, and a test that runs its `main`.
///
/// Blocks with file names are written to a folder of the page below `out`, and the Rust refers to
/// that folder.
///
/// # Errors
/// A file cannot be written.
pub fn modules(blocks: &[Block], out: &Path) -> io::Result<String> {
    let mut pages: BTreeMap<&str, Vec<&Block>> = BTreeMap::new();
    for block in blocks {
        pages.entry(&block.page).or_default().push(block);
    }
    let mut code = String::new();
    for (page, blocks) in pages {
        if blocks.iter().any(|block| is_whole(block)) {
            code += &module(page, &blocks, &out.join(page))?;
        }
    }
    Ok(code)
}

/// Whether a block is Rust to compile here; excerpts are compiled in their own files.
fn is_whole(block: &Block) -> bool {
    block.kind == "rust" && block.value("of").is_none()
}

fn module(page: &str, blocks: &[&Block], folder: &Path) -> io::Result<String> {
    let mut files = Vec::new();
    let mut rust = String::new();
    for block in blocks {
        if let Some(name) = block.value("file").filter(|_| block.kind != "rust") {
            let path = folder.join(name);
            fs::create_dir_all(path.parent().unwrap_or(folder))?;
            fs::write(&path, &block.text)?;
            files.push((format!("\"{name}\""), format!("{:?}", path.display().to_string())));
        }
        if is_whole(block) {
            let _ = writeln!(rust, "// {}\n{}", block.place(), block.text);
        }
    }
    for (name, path) in files {
        rust = rust.replace(&name, &path);
    }
    let name = page.replace('-', "_");
    // The reader's crate root is the page's module here.
    rust = rust.replace("=> crate ", &format!("=> crate::{HOME}::{name} "));
    let runs = match rust.contains("\nfn main()") {
        // An error returned by 'main' fails the test.
        true => {
            "#[test]\nfn main_runs() {\n    use std::process::{ExitCode, Termination};\n    \
                 assert_eq!(main().report(), ExitCode::SUCCESS);\n}\n"
        }
        false => "",
    };
    Ok(format!("#[allow(dead_code, unused_imports)]\nmod {name} {{\n{rust}{runs}}}\n"))
}
