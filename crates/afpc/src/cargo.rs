//! Calls cargo, finds what it made, and shows its errors where people can mend them.

mod blame;
mod message;

use std::env;
use std::io::{BufRead, BufReader, ErrorKind};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use afp_run::{RunError, say};
use serde_json::Value;

use crate::plan_file::NoPlan;
use crate::toolchain::Toolchain;

pub use blame::{Blame, Generated};
use message::Message;

/// What cargo shall build.
pub struct Job<'a> {
    /// The folder of the crate.
    pub folder: &'a Path,
    /// Where cargo puts what it makes, unless the environment says otherwise; else below the folder.
    pub target: Option<&'a Path>,
    /// What builds for another machine.
    pub toolchain: Option<&'a Toolchain>,
    /// Where errors come from.
    pub blame: Blame<'a>,
    /// What to say when there is no cargo.
    pub no_cargo: RunError,
}

/// Builds a crate and gives the path of its binary, if it has one.
///
/// # Errors
/// There is no cargo, or it fails; standard error has been told why.
pub fn build(job: Job<'_>) -> Result<Option<PathBuf>, NoPlan> {
    let cargo = env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let mut command = Command::new(&cargo);
    command.args(["build", "--release", "--message-format=json-diagnostic-rendered-ansi"]);
    command.arg("--manifest-path").arg(job.folder.join("Cargo.toml"));
    if let (Some(target), None) = (job.target, env::var_os("CARGO_TARGET_DIR")) {
        command.arg("--target-dir").arg(target);
    }
    if let Some(toolchain) = job.toolchain {
        command.args(["--target", toolchain.triple]);
        command.envs(toolchain.environment.iter().map(|(name, value)| (name, value)));
    }
    let started = command.stdin(Stdio::null()).stdout(Stdio::piped()).spawn();
    let mut child = started.map_err(|error| match error.kind() {
        ErrorKind::NotFound => job.no_cargo,
        _ => RunError::file("cannot start", cargo.as_ref())(error),
    })?;
    let (mut binary, mut messages) = (None, Vec::new());
    if let Some(out) = child.stdout.take() {
        let lines = BufReader::new(out).lines().map_while(Result::ok);
        for line in lines.filter_map(|line| serde_json::from_str::<Value>(&line).ok()) {
            binary = executable(&line).or(binary);
            messages.extend(Message::read(&line));
        }
    }
    let status = child.wait().map_err(RunError::file("cannot wait for", cargo.as_ref()))?;
    // Only now, so that cargo's progress and the errors do not run into one another.
    messages.iter().for_each(|message| job.blame.tell(message));
    match status.success() {
        true => Ok(binary),
        false => {
            let folder = job.folder.display();
            say(format_args!("error: cargo could not build the crate in '{folder}'"));
            Err(NoPlan::Wrong)
        }
    }
}

/// The binary that a message of cargo tells of.
fn executable(line: &Value) -> Option<PathBuf> {
    line.get("executable")?.as_str().map(PathBuf::from)
}
