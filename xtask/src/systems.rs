//! The command line for Windows and macOS: it compiles there, with the C compiler of Zig.

use std::path::Path;

use crate::python::environment;
use crate::shell::{Failure, cargo, program, run as run_command};

/// The C compiler for each system, as pip names it.
const ZIG: &str = "ziglang==0.17.0";

/// Targets of Rust, and their names for Zig.
const SYSTEMS: [(&str, &str); 2] =
    [("x86_64-pc-windows-gnu", "x86_64-windows-gnu"), ("aarch64-apple-darwin", "aarch64-macos")];

/// Checks the whole command line for each system.
///
/// # Errors
/// No Python, no network for Zig and the targets, or a crate that does not compile.
pub fn run() -> Result<(), Failure> {
    let python = environment("zig", &[ZIG])?;
    SYSTEMS.iter().try_for_each(|(target, zig)| check(&python, target, zig))
}

fn check(python: &Path, target: &str, zig: &str) -> Result<(), Failure> {
    run_command(program("rustup").args(["target", "add", target]))?;
    let mut check = cargo();
    check.args(["check", "--package", "afpc", "--features", "full,studio", "--target", target]);
    let name = target.replace('-', "_");
    // The options that `cc` would add are not those of Zig.
    check.env("CRATE_CC_NO_DEFAULTS", "1").env(format!("CFLAGS_{name}"), format!("-target {zig}"));
    for (variable, tool) in [("CC", "cc"), ("AR", "ar")] {
        let tool = format!("{} -m ziglang {tool}", python.display());
        check.env(format!("{variable}_{name}"), tool);
    }
    run_command(check.env("RUSTFLAGS", "--deny warnings"))
}
