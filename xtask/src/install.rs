//! Installs `afpc` and uses it in an empty folder.

use std::fs;
use std::path::Path;
use std::process::Command;

use crate::shell::{
    Failure, built_plans, cargo, output, program, quickly, root, run as run_command, target,
};

/// Enough time for the robot to bump and back up.
const UNTIL: [&str; 2] = ["--until", "10s"];

/// The optimisation of the installed program and of the programs that it builds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Profile {
    /// As for users; takes minutes.
    Release,
    /// Shares the builds of other suites.
    Debug,
}

impl Profile {
    fn builds(self, command: &mut Command) -> &mut Command {
        match self {
            Profile::Release => command,
            Profile::Debug => quickly(command),
        }
    }
}

/// Installs the command line, runs and builds a copy of a plan outside of the checkout, and
/// compares the program's output with the interpreter's, over twenty seeds.
///
/// # Errors
/// A build or run fails, or the outputs differ.
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
        // Also builds the command line itself.
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
    // Uses the folder of the twenty seeds, so that the engine is built once.
    let mut build = here(afpc);
    build.args(["build", "mine.afp"]).env("CARGO_TARGET_DIR", built_plans());
    let path = output(profile.builds(&mut build))?;
    let binary = Path::new(path.lines().last().unwrap_or_default()).to_owned();
    let again = output(here(&binary).arg("--json").args(UNTIL))?;
    if said != again {
        return Err("the program and 'afpc run' print different results".into());
    }
    Ok(())
}
