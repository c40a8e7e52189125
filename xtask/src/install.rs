//! Installs `afpc` and uses it in an empty folder.

use std::fs;
use std::path::Path;
use std::process::Command;

use crate::shell::{
    Failure, built_plans, cargo, output, program, quickly, root, run as run_command, target,
};

/// Enough time for the robot to bump and back up.
const UNTIL: [&str; 2] = ["--until", "10s"];

/// Whether the installed program, and the programs that it builds, are optimised.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Profile {
    /// As for users; takes minutes.
    Release,
    /// With the builds of other suites.
    Debug,
}

impl Profile {
    /// A command that builds plans.
    fn builds(self, command: &mut Command) -> &mut Command {
        match self {
            Profile::Release => command,
            Profile::Debug => quickly(command),
        }
    }
}

/// Installs the command line, runs and builds a copy of a plan far from the checkout, and compares
/// the program's output with that of the interpreter, over twenty seeds.
///
/// # Errors
/// A build or a run that fails, or a program that differs from the interpreter.
pub fn run(profile: Profile) -> Result<(), Failure> {
    let home = target().join("xtask/install");
    let mut install = cargo();
    install.args(["install", "--locked", "--force", "--path", "crates/afpc", "--root"]).arg(&home);
    if profile == Profile::Debug {
        install.arg("--debug");
    }
    run_command(&mut install)?;
    let folder = std::env::temp_dir().join(format!("afp-install-{}", std::process::id()));
    fs::create_dir_all(&folder)?;
    let done = use_it(&home.join("bin/afpc"), &folder, profile);
    fs::remove_dir_all(&folder)?;
    done?;
    // The program against the interpreter over twenty seeds.
    let mut long = cargo();
    long.args(["test", "--package", "afpc", "--test", "afpc", "--", "--ignored", "build::"]);
    if profile == Profile::Release {
        // With the command line itself among what is built.
        long.args(["own_toolboxes::", "new::"]);
    }
    run_command(profile.builds(&mut long))
}

fn use_it(afpc: &Path, folder: &Path, profile: Profile) -> Result<(), Failure> {
    fs::copy(root().join("plans/wall_following.afp"), folder.join("mine.afp"))?;
    let here = |command: &Path| {
        let mut command = program(command);
        command.current_dir(folder);
        command
    };
    let said = output(here(afpc).args(["run", "mine.afp", "--json"]).args(UNTIL))?;
    // The folder that the twenty seeds use too: the engine is built once.
    let mut build = here(afpc);
    build.args(["build", "mine.afp"]).env("CARGO_TARGET_DIR", built_plans());
    let path = output(profile.builds(&mut build))?;
    let binary = Path::new(path.lines().last().unwrap_or_default()).to_owned();
    let again = output(here(&binary).arg("--json").args(UNTIL))?;
    if said != again {
        return Err("the program and 'afpc run' do not say the same".into());
    }
    Ok(())
}
