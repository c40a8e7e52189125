//! The studio's page, built from `studio/` with npm, and its tests in a real browser.

use std::env;
use std::path::PathBuf;
use std::process::Command;

use crate::npm;
use crate::shell::{Failure, cargo, program, root, run as run_command, target};

/// Builds the page, then the command line with it, and opens it.
///
/// # Errors
/// No npm, no network for its packages the first time, or a failing build.
pub fn open(arguments: &[String]) -> Result<(), Failure> {
    page()?;
    let here = env::current_dir()?;
    let build = ["run", "--quiet", "--release", "--package", "afpc", "--features", "studio,lsp"];
    let manifest = root().join("Cargo.toml");
    let mut command = cargo();
    command.args(build).arg("--manifest-path").arg(manifest).args(["--", "studio"]);
    run_command(command.args(arguments).current_dir(here))
}

/// Builds `studio/dist`.
///
/// # Errors
/// As [`open`].
pub fn page() -> Result<(), Failure> {
    npm::ci(&root().join("studio"))?;
    run_command(at_page("node").arg("build.mjs"))
}

/// The page's unit tests, then user gestures in Chromium on the real program.
///
/// # Errors
/// As [`open`]; no browser; a failing test.
pub fn test() -> Result<(), Failure> {
    tested(&[])
}

/// The long tests: many random gestures, compared screenshots and a project's own robot; then
/// measurements and an hour's run of an optimised program, with no other load.
///
/// # Errors
/// As [`test`](fn@test); a measurement beyond its limit.
pub fn long() -> Result<(), Failure> {
    tested(&[("AFP_GESTURES", "2000"), ("AFP_SCREENS", "1"), ("AFP_ROBOT", "1")])?;
    let features =
        ["build", "--quiet", "--release", "--package", "afpc", "--features", "studio,lsp"];
    run_command(cargo().args(features))?;
    let settings = [("AFP_BARS", "check"), ("AFP_HOUR", "3600")];
    let afpc = program_in("release");
    run_command(npm().args(["run", "--silent", "bars"]).env("AFPC", afpc).envs(settings))
}

fn tested(settings: &[(&str, &str)]) -> Result<(), Failure> {
    page()?;
    run_command(npm().args(["run", "--silent", "check"]))?;
    let features = ["build", "--quiet", "--package", "afpc", "--features", "full,studio"];
    run_command(cargo().args(features))?;
    controller()?;
    let afpc = program_in("debug");
    run_command(npm().args(["test"]).env("AFPC", afpc).envs(settings.iter().copied()))
}

/// Builds the controller of the robot that tests attach to.
///
/// # Errors
/// A failing build.
pub fn controller() -> Result<(), Failure> {
    let example = ["build", "--quiet", "--package", "afp-pi", "--example", "controller"];
    run_command(cargo().args(example))
}

/// `afpc` as built by a profile.
fn program_in(profile: &str) -> PathBuf {
    target().join(profile).join(format!("afpc{}", env::consts::EXE_SUFFIX))
}

fn npm() -> Command {
    let mut command = npm::npm();
    command.current_dir(root().join("studio"));
    command
}

fn at_page(name: &str) -> Command {
    let mut command = program(name);
    command.current_dir(root().join("studio"));
    command
}
