//! The Rust of the book as modules that a test can include.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::Path;
use std::{fs, io};

use super::Block;

/// The module that includes the modules of the pages.
const HOME: &str = "rust_blocks";

/// A module for each page with Rust: its blocks one after the other, and a test that runs its `main`.
///
/// Files that blocks are written to go to a folder of the page below `out`, and the Rust names them
/// there.
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

/// Whether a block is Rust that is compiled here; excerpts are compiled where they stand.
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
    // What is the crate's root for readers is the page's module here.
    rust = rust.replace("=> crate ", &format!("=> crate::{HOME}::{name} "));
    let runs = match rust.contains("\nfn main()") {
        // An error that 'main' ends with fails the test as it fails the program.
        true => {
            "#[test]\nfn main_runs() {\n    use std::process::{ExitCode, Termination};\n    \
                 assert_eq!(main().report(), ExitCode::SUCCESS);\n}\n"
        }
        false => "",
    };
    Ok(format!("#[allow(dead_code, unused_imports)]\nmod {name} {{\n{rust}{runs}}}\n"))
}
