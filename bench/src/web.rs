//! The size of compiler, interpreter, drawing, edits and simulator as one WebAssembly module.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::report::{Report, Row};

const TARGET: &str = "wasm32-unknown-unknown";
const PACKAGE: &str = "afp-wasm";

/// Builds the module and measures its size, or reports a failure.
pub fn run(_: u32, report: &mut Report) {
    const NAME: &str = "web/module with all of it";
    match measure() {
        Ok(bytes) => report.add(Row::new(NAME, bytes as f64 / 1e6, "MB")),
        Err(why) => report.add(Row::new(NAME, f64::NAN, "MB").limit(why, true)),
    }
}

fn measure() -> Result<u64, String> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let folder = std::env::var_os("CARGO_TARGET_DIR").map(PathBuf::from);
    let folder = folder.unwrap_or_else(|| root.join("target")).join("wasm");
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let mut command = Command::new(cargo);
    command.args(["build", "--quiet", "--release", "--target", TARGET, "--package", PACKAGE]);
    command.current_dir(&root).env("CARGO_TARGET_DIR", &folder);
    let output = command.output().map_err(|why| format!("not run: {why}"))?;
    if !output.status.success() {
        let errors = String::from_utf8_lossy(&output.stderr);
        let line = errors.lines().find(|line| line.starts_with("error")).unwrap_or("failed");
        return Err(format!("not built: {line}"));
    }
    let module = folder.join(TARGET).join("release").join(PACKAGE).with_extension("wasm");
    let data = fs::metadata(&module).map_err(|why| format!("not there: {why}"))?;
    Ok(data.len())
}
