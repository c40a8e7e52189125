//! Compares the simulated robot with another physics engine.

use std::fs;

use crate::python::environment;
use crate::shell::{Failure, cargo, output, program, root, run as run_command, target};

const PACKAGES: [&str; 1] = ["pymunk==7.3.1"];

/// Drives the same manoeuvres with both engines and compares the positions of robot and box over
/// time.
///
/// # Errors
/// No Python, no network for the package, or too large a difference.
pub fn run() -> Result<(), Failure> {
    let python = environment("engine", &PACKAGES)?;
    let manoeuvres = root().join("tests/python/manoeuvres.json");
    let drive = ["run", "--quiet", "--package", "afp-sim", "--example", "manoeuvres", "--"];
    let ours = target().join("xtask/manoeuvres.jsonl");
    fs::write(&ours, output(cargo().args(drive).arg(&manoeuvres))?)?;
    let compare = root().join("tests/python/compare_engine.py");
    run_command(program(python).arg(compare).arg(manoeuvres).arg(ours))
}
