//! Watches a run with Foxglove's own client of its WebSocket protocol.

use crate::npm;
use crate::shell::{Failure, cargo, program, root, run as run_command, target};

/// The program that watches.
const PROGRAM: &str = "watch.js";

/// Watches a plan while it runs.
///
/// # Errors
/// No node or npm, no network for the client, or an answer that is wrong.
pub fn run() -> Result<(), Failure> {
    let folder = npm::installed("live", PROGRAM)?;
    run_command(cargo().args(["build", "--quiet", "--package", "afpc", "--features", "full"]))?;
    let afpc = target().join("debug").join(format!("afpc{}", std::env::consts::EXE_SUFFIX));
    let watch = folder.join(PROGRAM);
    run_command(program("node").arg(watch).env("AFPC", afpc).env("AFP_PLANS", root().join("plans")))
}
