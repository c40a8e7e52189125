//! Projects that bring their own robot, outside of the workspace as their authors have them: the example, and a new one.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::shell::{
    Failure, cargo, output, program, quickly_built, root, run as run_command, target,
};

/// Where the project is.
const FOLDER: &str = "examples/vacuum";
/// A run that ends by itself.
const RUN: [&str; 5] = ["run", "plans/clean.afp", "--json", "--until", "190s"];

/// Runs the tests of the example's crate, the scenarios of its plan, and those of new projects.
///
/// # Errors
/// Whatever does not work.
pub fn test() -> Result<(), Failure> {
    run_command(cargo().args(["build", "--package", "afpc"]))?;
    for (name, option) in [("greeter", "--toolbox"), ("rover", "--robot")] {
        let folder = target().join("xtask/new").join(name);
        if folder.exists() {
            fs::remove_dir_all(&folder)?;
        }
        let mut new = program(target().join("debug/afpc"));
        run_command(new.args(["new", option]).arg(&folder))?;
        let mut tests = cargo();
        run_command(tests.arg("test").current_dir(folder).env("CARGO_TARGET_DIR", target()))?;
    }
    let folder = root().join(FOLDER);
    // The versions that the workspace is tested with.
    fs::copy(root().join("Cargo.lock"), folder.join("Cargo.lock"))?;
    let mut tests = cargo();
    run_command(tests.arg("test").current_dir(folder).env("CARGO_TARGET_DIR", target()))
}

/// Runs every command of `afpc` on the robot, and the program that it builds: it says what the interpreter says.
///
/// # Errors
/// Whatever does not work.
pub fn all() -> Result<(), Failure> {
    test()?;
    let afpc = target().join("debug/afpc");
    run_command(here(&afpc).arg("test"))?;
    let said = output(here(&afpc).args(RUN))?;
    run_command(here(&afpc).args(["log", "target/afp/runs/clean.mcap", "--svg"]).arg(picture()))?;
    let sweep = ["sweep", "plans/clean.afp", "--world", "random:0..4", "--until", "60s"];
    run_command(here(&afpc).args(sweep).args(["--restart", "-o"]).arg(table()))?;
    let built = output(here(&afpc).args(["build", "plans/clean.afp"]))?;
    let binary = Path::new(built.lines().last().unwrap_or_default()).to_owned();
    let again = output(here(&binary).args(&RUN[2..]))?;
    match said == again {
        true => Ok(()),
        false => Err("error: the program and the interpreter differ on the vacuum cleaner".into()),
    }
}

fn picture() -> PathBuf {
    target().join("xtask/vacuum.svg")
}

fn table() -> PathBuf {
    target().join("xtask/vacuum.csv")
}

/// A command in the project.
fn here(command: &Path) -> Command {
    let mut command = program(command);
    quickly_built(command.current_dir(root().join(FOLDER)));
    command
}
