//! Calls cargo and finds what it made.

use std::env;
use std::io::{BufRead, BufReader, ErrorKind};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use afp_run::RunError;
use serde_json::Value;

use crate::plan_file::NoPlan;

/// Builds the crate in `folder` and gives the path of its binary, if it has one.
///
/// # Errors
/// There is no cargo, or it fails; it has told standard error why.
pub(super) fn build(folder: &Path, target: Option<&Path>) -> Result<Option<PathBuf>, NoPlan> {
    let cargo = env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let mut command = Command::new(&cargo);
    command.args(["build", "--release", "--message-format=json-render-diagnostics"]);
    command.arg("--manifest-path").arg(folder.join("Cargo.toml"));
    if let (Some(target), None) = (target, env::var_os("CARGO_TARGET_DIR")) {
        command.arg("--target-dir").arg(target);
    }
    let started = command.stdin(Stdio::null()).stdout(Stdio::piped()).spawn();
    let mut child = started.map_err(|error| match error.kind() {
        ErrorKind::NotFound => RunError::Missing {
            message: "there is no cargo to build the crate with".to_owned(),
            help: "install Rust from https://rustup.rs; 'afpc run' works without it".to_owned(),
        },
        _ => RunError::file("cannot start", cargo.as_ref())(error),
    })?;
    let mut binary = None;
    if let Some(out) = child.stdout.take() {
        for line in BufReader::new(out).lines().map_while(Result::ok) {
            binary = executable(&line).or(binary);
        }
    }
    let status = child.wait().map_err(RunError::file("cannot wait for", cargo.as_ref()))?;
    match status.success() {
        true => Ok(binary),
        false => {
            anstream::eprintln!("error: cargo could not build the crate in '{}'", folder.display());
            Err(NoPlan::Wrong)
        }
    }
}

/// The binary that a message of cargo tells of.
fn executable(line: &str) -> Option<PathBuf> {
    let message: Value = serde_json::from_str(line).ok()?;
    message.get("executable")?.as_str().map(PathBuf::from)
}
