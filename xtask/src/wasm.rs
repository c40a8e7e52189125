//! The gate of the web: compiler, interpreter, drawing, edits and simulator in one WebAssembly module,
//! which runs.

use std::fs;

use crate::shell::{Failure, cargo, program, run as run_command, target};

const TARGET: &str = "wasm32-unknown-unknown";
const PACKAGE: &str = "afp-wasm";
/// The module imports nothing; a failed assertion is a trap.
const RUN: &str = "WebAssembly.instantiate(require('fs').readFileSync(process.argv[1]))\
    .then(({ instance }) => process.exit(instance.exports.main(0, 0)))\
    .catch(why => { console.error(why); process.exit(1); })";

/// Builds the module and runs it in Node.js.
///
/// # Errors
/// Something does not compile for the web, or fails there; the target or Node.js is missing.
pub fn run() -> Result<(), Failure> {
    run_command(program("rustup").args(["target", "add", TARGET])).map_err(|why| {
        Failure(format!("{}\nhelp: install the standard library for {TARGET}", why.0))
    })?;
    let folder = target().join("wasm");
    let build = ["build", "--target", TARGET, "--package", PACKAGE];
    run_command(cargo().args(build).env("CARGO_TARGET_DIR", &folder))?;
    let module = folder.join(TARGET).join("debug").join(PACKAGE).with_extension("wasm");
    println!("{PACKAGE} for {TARGET}: {} bytes, not optimised", fs::metadata(&module)?.len());
    run_command(program("node").arg("--eval").arg(RUN).arg(&module))
        .map_err(|why| Failure(format!("{}\nhelp: the gate needs Node.js (nodejs)", why.0)))?;
    println!("it runs");
    Ok(())
}
