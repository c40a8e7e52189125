//! The way from a new project to a log of a robot, with an emulated Raspberry Pi, and over a slow
//! connection. It needs root, for namespaces of its own.

use crate::emulated::PI;
use crate::shell::{Failure, cargo, program, run as run_command, target};

/// The test of the way.
const TEST: [&str; 8] =
    ["test", "--package", "afpc", "--features", "full", "--test", "afpc", "deploy::whole"];

/// Runs the test with a program for a Raspberry Pi, then with a connection of 1 Mbit/s.
///
/// # Errors
/// No toolchain or emulator; a step fails, or takes too long.
pub fn run() -> Result<(), Failure> {
    PI.install()?;
    let build = ["build", "--package", "afpc", "--features", "pi", "--target", PI.triple];
    run_command(cargo().args(build).env(PI.variable("LINKER"), PI.linker))?;
    let afpc = target().join(PI.triple).join("debug/afpc");
    let shown = ["--", "--nocapture"];
    run_command(cargo().args(TEST).args(shown).env("AFP_ROBOTS_AFPC", afpc))?;
    // The limit holds only in this network.
    let inside = "ip link set lo up && exec \"$@\"";
    let mut slow = program("unshare");
    slow.args(["--net", "sh", "-c", inside, "sh", "cargo"]).args(TEST).args(shown);
    run_command(slow.env("AFP_SLOW", "1").env("CARGO_NET_OFFLINE", "true"))
}
