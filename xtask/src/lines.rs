//! Counts the lines of code in `crates/`, without blank lines, comments, tests and generated Rust.
//!
//! A line counts if it has a token of code. Files are formatted by `rustfmt` first, so joined lines
//! make no difference.

use std::collections::{BTreeMap, BTreeSet};
use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};

use proc_macro2::{TokenStream, TokenTree};

use crate::shell::{Failure, output, program, root};

/// Prints the lines of code of each crate, and their total.
///
/// # Errors
/// A file cannot be read or formatted.
pub fn print() -> Result<(), Failure> {
    let listed = output(program("git").args([
        "ls-files",
        "-co",
        "--exclude-standard",
        "crates/*/src/*.rs",
    ]))?;
    let (mut files, mut tests) = (BTreeMap::new(), BTreeSet::new());
    for path in
        listed.lines().map(Path::new).filter(|path| counts(path) && root().join(path).exists())
    {
        let mut lines = BTreeSet::new();
        collect(formatted(path)?.parse()?, path, &mut lines, &mut tests);
        files.insert(path, lines.len());
    }
    let of_test =
        |path: &Path| path.ancestors().any(|part| tests.contains(&part.with_extension("rs")));
    files.retain(|path, _| !of_test(path));
    let mut crates: BTreeMap<_, usize> = BTreeMap::new();
    for (path, lines) in &files {
        *crates
            .entry(path.iter().nth(1).and_then(OsStr::to_str).unwrap_or_default())
            .or_default() += lines;
    }
    let total = crates.values().sum();
    for (name, lines) in crates.into_iter().chain([("total", total)]) {
        println!("{name:<16} {lines:>7}");
    }
    Ok(())
}

/// Whether a file is handwritten code of a crate.
fn counts(path: &Path) -> bool {
    let apart = ["tests", "tests.rs", "benches", "examples", "proto"];
    !path.iter().any(|part| apart.iter().any(|apart| part == *apart))
}

fn formatted(path: &Path) -> Result<String, Failure> {
    let mut rustfmt = program("rustfmt");
    rustfmt.args(["--edition", "2024"]).stdin(fs::File::open(root().join(path))?);
    let done = rustfmt.output()?;
    if !done.status.success() {
        return Err(format!("rustfmt cannot read {}", path.display()).into());
    }
    Ok(String::from_utf8(done.stdout)?)
}

/// Collects the lines with a token of code, and the files of test modules. Submodules of a test
/// module are in the folder of its name.
fn collect(
    tokens: TokenStream,
    path: &Path,
    lines: &mut BTreeSet<usize>,
    tests: &mut BTreeSet<PathBuf>,
) {
    let mut tokens = tokens.into_iter().peekable();
    while let Some(token) = tokens.next() {
        let is_mark = matches!(&token, TokenTree::Punct(mark) if mark.as_char() == '#');
        tokens.next_if(|next| is_mark && next.to_string() == "!");
        let attribute = tokens.peek().filter(|_| is_mark).map(ToString::to_string);
        let begins = |with| attribute.as_ref().is_some_and(|text| text.starts_with(with));
        if begins("[cfg (test)") {
            let item = tokens.by_ref().take_while(|token| !token.to_string().ends_with(['}', ';']));
            if let [.., keyword, TokenTree::Ident(name)] = &item.collect::<Vec<_>>()[..]
                && keyword.to_string() == "mod"
            {
                tests.insert(folder(path).join(format!("{name}.rs")));
            }
        } else if begins("[doc = \"") {
            tokens.next();
        } else if let TokenTree::Group(group) = token {
            lines.extend([group.span_open().start().line, group.span_close().start().line]);
            collect(group.stream(), path, lines, tests);
        } else {
            lines.extend(token.span().start().line..=token.span().end().line);
        }
    }
}

/// The folder of a file's submodules.
fn folder(path: &Path) -> PathBuf {
    let root = ["lib.rs", "main.rs"].iter().any(|root| path.ends_with(root));
    if root { path.with_file_name("") } else { path.with_extension("") }
}
