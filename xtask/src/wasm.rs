//! The web gate: compiler, interpreter, drawing, edits and simulator in one WebAssembly module,
//! which is run; the language server in another module, which is tested in Node.js with its own
//! tests.

use std::fs;
use std::path::PathBuf;

use crate::profiles::unoptimised;
use crate::shell::{Failure, cargo, program, root, run as run_command, target};

const TARGET: &str = "wasm32-unknown-unknown";
const PACKAGE: &str = "afp-wasm";
/// The target with standard input and output, for the language server.
const WITH_INPUT: &str = "wasm32-wasip1";
const LANGUAGE_SERVER: &str = "afp-language-server";
/// The module imports nothing; a failed assertion is a trap.
const RUN: &str = "WebAssembly.instantiate(require('fs').readFileSync(process.argv[1]))\
    .then(({ instance }) => process.exit(instance.exports.main(0, 0)))\
    .catch(why => { console.error(why); process.exit(1); })";

/// Builds the modules and runs them in Node.js.
///
/// # Errors
/// A crate does not compile for the web, or fails there; the target or Node.js is missing.
pub fn run() -> Result<(), Failure> {
    run_command(program("rustup").args(["target", "add", TARGET, WITH_INPUT])).map_err(|why| {
        let both = format!("{TARGET} and {WITH_INPUT}");
        Failure(format!("{}\nhelp: install the standard libraries for {both}", why.0))
    })?;
    let module = module(TARGET, PACKAGE)?;
    println!("{PACKAGE} for {TARGET}: {} bytes, not optimised", fs::metadata(&module)?.len());
    run_command(program("node").arg("--eval").arg(RUN).arg(&module))
        .map_err(|why| Failure(format!("{}\nhelp: the gate needs Node.js (nodejs)", why.0)))?;
    println!("it runs");
    talk()
}

/// Tests the language server.
fn talk() -> Result<(), Failure> {
    let module = module(WITH_INPUT, LANGUAGE_SERVER)?;
    println!(
        "{LANGUAGE_SERVER} for {WITH_INPUT}: {} bytes, not optimised",
        fs::metadata(&module)?.len()
    );
    let talk = root().join("tests/lsp/web.js");
    let mut node = program("node");
    node.args(["--no-warnings", "--test-reporter=tap"]).arg(talk);
    node.env("AFP_LANGUAGE_SERVER", &module);
    node.env("AFP_CASES", root().join("crates/afp-lsp/tests/cases"));
    run_command(&mut node)
}

fn module(triple: &str, package: &str) -> Result<PathBuf, Failure> {
    let mut build = cargo();
    build.args(["build", "--target", triple, "--package", package]);
    run_command(unoptimised(&mut build)?)?;
    Ok(target().join(triple).join("debug").join(package).with_extension("wasm"))
}
