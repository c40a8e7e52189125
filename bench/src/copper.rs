//! The same work as five tasks of copper-rs, built and run as a separate program, so that its
//! hundred and forty dependencies stay out of the project's lock file.

use std::path::{Path, PathBuf};
use std::process::Command;

use crate::report::{Report, Row};

/// Builds and runs it, or reports a failure.
pub fn run(rounds: u32, report: &mut Report) {
    const NAME: &str = "step/cu29, five tasks";
    match measure(rounds) {
        Ok(nanos) => report.add(Row::new(NAME, nanos, "ns")),
        Err(why) => report.add(Row::new(NAME, f64::NAN, "ns").limit(why, true)),
    }
}

fn measure(rounds: u32) -> Result<f64, String> {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let manifest = here.join("copper/Cargo.toml");
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let mut command = Command::new(cargo);
    command.args(["run", "--quiet", "--release", "--locked", "--manifest-path"]).arg(manifest);
    command.arg("--").arg(rounds.to_string());
    let target = std::env::var_os("CARGO_TARGET_DIR").map(PathBuf::from);
    let target = target.unwrap_or_else(|| here.join("../target"));
    command.env("CARGO_TARGET_DIR", target.join("copper"));
    let output = command.output().map_err(|why| format!("not run: {why}"))?;
    if !output.status.success() {
        let errors = String::from_utf8_lossy(&output.stderr);
        let line = errors.lines().find(|line| line.starts_with("error")).unwrap_or("failed");
        return Err(format!("not built: {line}"));
    }
    let text = String::from_utf8_lossy(&output.stdout);
    text.trim().parse().map_err(|_| format!("not understood: {text}"))
}
