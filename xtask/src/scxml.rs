//! Feeds exported state charts to a public engine: control must go where the interpreter goes.

use std::fs;
use std::path::PathBuf;

use crate::shell::{Failure, cargo, program, root, run as run_command, target};

/// The project of the engine, in `tests/scxml`.
const PROJECT: [&str; 3] = ["package.json", "package-lock.json", ".npmrc"];

/// The program that feeds the charts.
const PROGRAM: &str = "replay.js";

/// Compares so many random plans, and the cases of `tests/run`.
///
/// # Errors
/// No node or npm, no network for the engine, or a chart in which control goes elsewhere.
pub fn run(plans: u32) -> Result<(), Failure> {
    let engine = engine()?;
    let cases = engine.join("cases.jsonl");
    let write = ["run", "--quiet", "--package", "afp-tests", "--bin", "state_charts", "--"];
    run_command(cargo().args(write).arg(plans.to_string()).arg(&cases))?;
    run_command(program("node").arg(engine.join(PROGRAM)).arg(cases))
}

/// The engine, installed once under target/, and the program beside it.
fn engine() -> Result<PathBuf, Failure> {
    let (project, folder) = (root().join("tests/scxml"), target().join("xtask/scxml"));
    fs::create_dir_all(&folder)?;
    let done = folder.join("installed.json");
    let wanted = fs::read_to_string(project.join("package-lock.json"))?;
    if !fs::read_to_string(&done).is_ok_and(|installed| installed == wanted) {
        for file in PROJECT {
            fs::copy(project.join(file), folder.join(file))?;
        }
        let npm = if cfg!(windows) { "npm.cmd" } else { "npm" };
        run_command(program(npm).arg("ci").current_dir(&folder)).map_err(|why| {
            Failure(format!("{}\nhelp: install Node.js with npm (nodejs, npm)", why.0))
        })?;
        fs::write(done, wanted)?;
    }
    fs::copy(project.join(PROGRAM), folder.join(PROGRAM))?;
    Ok(folder)
}
