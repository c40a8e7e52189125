//! Projects with their own robot, outside of the workspace as for users: the example, simulated and
//! on hardware with a simulated board, and a new project.

use std::fs;
use std::io::{BufRead, BufReader, Read};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::thread;
use std::time::Duration;

use crate::shell::{
    Failure, cargo, output, program, quickly_built, root, run as run_command, target,
};

const FOLDER: &str = "examples/vacuum";
/// A run that ends by itself.
const RUN: [&str; 5] = ["run", "plans/clean.afp", "--json", "--until", "190s"];

/// Runs the tests of the example's crate, the scenarios of its plan, and those of new projects.
///
/// # Errors
/// A build or test fails.
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
    tests.args(["test", "--workspace"]).current_dir(folder);
    run_command(tests.env("CARGO_TARGET_DIR", target()))
}

/// Runs every command of `afpc` on the robot, and the program that it builds: the outputs must
/// equal the interpreter's.
///
/// # Errors
/// A build or test fails.
pub fn all() -> Result<(), Failure> {
    test()?;
    let afpc = target().join("debug/afpc");
    run_command(here(&afpc).arg("test"))?;
    let said = output(here(&afpc).args(RUN))?;
    run_command(here(&afpc).args(["log", "target/afp/runs/clean.mcap", "--svg"]).arg(picture()))?;
    let sweep = ["sweep", "plans/clean.afp", "--world", "random:0..4", "--until", "60s"];
    run_command(here(&afpc).args(sweep).args(["--restart", "-o"]).arg(table()))?;
    let built = output(here(&afpc).args(["build", "plans/clean.afp", "--hardware"]))?;
    let binary = Path::new(built.lines().last().unwrap_or_default()).to_owned();
    let again = output(here(&binary).args(&RUN[2..]))?;
    if said != again {
        return Err("error: the program and the interpreter differ on the vacuum cleaner".into());
    }
    on_the_board(here(&afpc).args(["run", "plans/clean.afp"]))?;
    on_the_board(&mut here(&binary))
}

/// Runs the plan on the hardware robot with a simulated board: until its time limit, and until a
/// signal ends it, including a stop signal of the terminal. Each time the wheels have turned, and
/// the board receives a stop.
fn on_the_board(command: &mut Command) -> Result<(), Failure> {
    let mut firmware = cargo();
    firmware.args(["build", "--package", "vacuum-board", "--example", "firmware"]);
    run_command(firmware.current_dir(root().join(FOLDER)).env("CARGO_TARGET_DIR", target()))?;
    command.args(["--robot", "hardware", "--json", "--log", "none"]);
    for (signal, code) in [(None, 0), (Some("-TERM"), 143), (Some("-TSTP"), 0), (Some("-INT"), 0)] {
        let (mut board, port) = board()?;
        let mut run = Command::new(command.get_program());
        run.args(command.get_args()).arg("--set").arg(format!("robot.port={port}"));
        run.current_dir(root().join(FOLDER)).stdout(Stdio::null());
        run.envs(command.get_envs().filter_map(|(name, value)| Some((name, value?))));
        if signal.is_none() {
            run.args(["--until", "2s"]);
        }
        eprintln!("$ on a simulated board: {run:?}");
        let mut run = run.spawn()?;
        if let Some(signal) = signal {
            // It was built before, so it drives soon.
            thread::sleep(Duration::from_secs(4));
            run_command(program("kill").args([signal, &run.id().to_string()]))?;
        }
        let ended = run.wait()?.code();
        let mut told = String::new();
        // The board exits when it receives a stop.
        board
            .stdout
            .take()
            .into_iter()
            .try_for_each(|mut out| out.read_to_string(&mut told).map(drop))?;
        board.wait()?;
        let moved = told.lines().any(|line| line.starts_with("Drive { speed: 0.2"));
        if ended != Some(code) || !moved || !told.ends_with("Stop\n") {
            return Err(
                format!("error: it ended with {ended:?}, the board received\n{told}").into()
            );
        }
    }
    Ok(())
}

/// A simulated board, and its port.
fn board() -> Result<(Child, String), Failure> {
    let path = target().join("debug/examples/firmware");
    let mut board = program(path).stdout(Stdio::piped()).spawn()?;
    let mut port = String::new();
    if let Some(out) = board.stdout.take() {
        let mut out = BufReader::with_capacity(1, out);
        out.read_line(&mut port)?;
        board.stdout = Some(out.into_inner());
    }
    Ok((board, port.trim().to_owned()))
}

fn picture() -> PathBuf {
    target().join("xtask/vacuum.svg")
}

fn table() -> PathBuf {
    target().join("xtask/vacuum.csv")
}

fn here(command: &Path) -> Command {
    let mut command = program(command);
    quickly_built(command.current_dir(root().join(FOLDER)));
    command
}
