//! Programs for a Raspberry Pi, run under emulation: their output must equal that of `afpc run` on
//! this machine.

use std::path::Path;

use crate::emulated::{Emulated, PI, PI32};
use crate::shell::{
    Failure, built_plans, cargo, output, program, quickly, root, run as run_command, target,
};

/// A folder, a plan in it, and its options.
type Case = (&'static str, &'static str, &'static [&'static str]);

/// Enough time for the robot to bump and back up.
const WALL: Case = (".", "plans/wall_following.afp", &["--until", "10s"]);
/// A plan with a project's own robot.
const VACUUM: Case = ("examples/vacuum", "plans/clean.afp", &["--until", "30s"]);

const SEEDS: [&str; 3] = ["0", "1", "7"];

/// With the installed tools: the paper's plan for 64 bit, without long optimisation.
///
/// # Errors
/// The output differs.
pub fn short() -> Result<(), Failure> {
    let missing = PI.missing();
    if !missing.is_empty() {
        eprintln!("skipped: to run it, first: {}", missing.join(" && "));
        return Ok(());
    }
    prepare()?;
    compare(&PI, WALL, true)
}

/// Both machines, also with a project's robot, built as for users; installs missing packages.
///
/// # Errors
/// No toolchain or emulator, or a different output.
pub fn run() -> Result<(), Failure> {
    prepare()?;
    for machine in [&PI, &PI32] {
        machine.install()?;
        for case in [WALL, VACUUM] {
            compare(machine, case, false)?;
        }
    }
    Ok(())
}

fn prepare() -> Result<(), Failure> {
    run_command(cargo().args(["build", "--package", "afpc"]))
}

/// Builds a plan for a machine and compares its output with the interpreter's.
fn compare(machine: &Emulated, (folder, plan, until): Case, quick: bool) -> Result<(), Failure> {
    let (folder, afpc) = (root().join(folder), target().join("debug/afpc"));
    let here = |command: &Path| {
        let mut command = program(command);
        command.current_dir(&folder).env("CARGO_TARGET_DIR", built_plans());
        if quick {
            quickly(&mut command);
        }
        command
    };
    let built = output(here(&afpc).args(["build", plan, "--target", machine.name]))?;
    let binary = built.lines().last().unwrap_or_default();
    let [qemu, words @ ..] = machine.emulator();
    for seed in SEEDS {
        let options = ["--json", "--log", "none", "--svg", "none", "--seed", seed];
        let said = output(here(&afpc).args(["run", plan]).args(until).args(options))?;
        let emulated =
            output(here(qemu.as_ref()).args(words).arg(binary).args(until).args(options))?;
        if said != emulated {
            let name = machine.name;
            return Err(format!("'{plan}' with seed {seed} differs on '{name}'").into());
        }
        println!(
            "{plan}, seed {seed}: {} lines, equal on '{}'",
            said.lines().count(),
            machine.name
        );
    }
    Ok(())
}
