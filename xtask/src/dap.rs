use crate::npm;
use crate::shell::{Failure, cargo, program, root, run as run_command, target};

/// The client program.
const PROGRAM: &str = "debug.js";

/// Debugs a plan with a public client of the Debug Adapter Protocol, over standard input and output
/// and over a socket.
///
/// # Errors
/// No node or npm, no network for the client, or a wrong answer.
pub fn run() -> Result<(), Failure> {
    let folder = npm::installed("dap", PROGRAM)?;
    run_command(cargo().args(["build", "--quiet", "--package", "afpc", "--features", "full"]))?;
    let afpc = target().join("debug").join(format!("afpc{}", std::env::consts::EXE_SUFFIX));
    let debug = folder.join(PROGRAM);
    run_command(program("node").arg(debug).env("AFPC", afpc).env("AFP_PLANS", root().join("plans")))
}
