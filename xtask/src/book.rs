//! Renders the book for reading; its tests do not need it.

use std::io::ErrorKind;

use crate::shell::{Failure, program, root, run as run_command, target};

/// Builds `docs/` with mdBook into `book/` of the target folder.
///
/// # Errors
/// mdBook is missing or reports an error.
pub fn run() -> Result<(), Failure> {
    if let Err(error) = program("mdbook").arg("--version").output()
        && error.kind() == ErrorKind::NotFound
    {
        let why = "error: mdbook is not installed\n  help: run 'cargo install mdbook --locked'";
        return Err(Failure(why.to_owned()));
    }
    let book = target().join("book");
    run_command(program("mdbook").args(["build", "docs", "--dest-dir"]).arg(&book))?;
    let page = root().join(book).join("index.html");
    println!("{}", page.display());
    Ok(())
}
