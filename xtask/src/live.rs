use crate::npm;
use crate::shell::{Failure, cargo, program, root, run as run_command, target};

/// The client program.
const PROGRAM: &str = "watch.js";

/// Watches a running plan with Foxglove's own client of its WebSocket protocol.
///
/// # Errors
/// No node or npm, no network for the client, or a wrong answer.
pub fn run() -> Result<(), Failure> {
    let folder = npm::installed("live", PROGRAM)?;
    run_command(cargo().args(["build", "--quiet", "--package", "afpc", "--features", "full"]))?;
    let afpc = target().join("debug").join(format!("afpc{}", std::env::consts::EXE_SUFFIX));
    let watch = folder.join(PROGRAM);
    run_command(program("node").arg(watch).env("AFPC", afpc).env("AFP_PLANS", root().join("plans")))
}
