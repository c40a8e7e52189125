//! Feeds exported state charts to a public engine and compares the active states with the
//! interpreter's.

use crate::npm;
use crate::shell::{Failure, cargo, program, run as run_command};

/// The program that feeds the charts.
const PROGRAM: &str = "replay.js";

/// Compares random plans and the cases of `tests/run`.
///
/// # Errors
/// No node or npm, no network for the engine, or different active states.
pub fn run(plans: u32) -> Result<(), Failure> {
    let engine = npm::installed("scxml", PROGRAM)?;
    let cases = engine.join("cases.jsonl");
    let write = ["run", "--quiet", "--package", "afp-tests", "--bin", "state_charts", "--"];
    run_command(cargo().args(write).arg(plans.to_string()).arg(&cases))?;
    run_command(program("node").arg(engine.join(PROGRAM)).arg(cases))
}
