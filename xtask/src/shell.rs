//! Runs other programs, saying which.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::{env, fmt};

/// Why a chore did not succeed.
#[derive(Debug)]
pub struct Failure(pub String);

impl<T: fmt::Display> From<T> for Failure {
    fn from(why: T) -> Self {
        Failure(format!("error: {why}"))
    }
}

/// The root of the checkout.
pub fn root() -> PathBuf {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    here.parent().unwrap_or(here).to_owned()
}

/// Where builds go.
pub fn target() -> PathBuf {
    env::var_os("CARGO_TARGET_DIR").map_or_else(|| root().join("target"), PathBuf::from)
}

/// A program to be run at the root of the checkout.
pub fn program(name: impl AsRef<OsStr>) -> Command {
    let mut command = Command::new(name);
    command.current_dir(root()).stdin(Stdio::null());
    command
}

/// Makes a command build into the folder of all slow tests, without long optimisation.
pub fn quickly_built(command: &mut Command) -> &mut Command {
    quickly(command).env("CARGO_TARGET_DIR", built_plans())
}

/// Makes a command, and the commands that it starts, build without long optimisation.
pub fn quickly(command: &mut Command) -> &mut Command {
    command
        .env("CARGO_PROFILE_RELEASE_OPT_LEVEL", "0")
        .env("CARGO_PROFILE_RELEASE_LTO", "off")
        .env("CARGO_PROFILE_RELEASE_CODEGEN_UNITS", "16")
        .env("CARGO_PROFILE_RELEASE_DEBUG", "0")
}

/// Where all slow tests build.
pub fn built_plans() -> PathBuf {
    target().join("tmp/built-plans")
}

/// The cargo that runs this.
pub fn cargo() -> Command {
    program(env::var_os("CARGO").unwrap_or_else(|| "cargo".into()))
}

/// Runs a program to its end, its output going where ours goes.
///
/// # Errors
/// It cannot be run, or does not succeed.
pub fn run(command: &mut Command) -> Result<(), Failure> {
    let line = line(command);
    eprintln!("$ {line}");
    let status = command.status().map_err(|why| format!("cannot run '{line}': {why}"))?;
    if status.success() { Ok(()) } else { Err(format!("'{line}' failed: {status}").into()) }
}

/// Runs a program and gives what it prints.
///
/// # Errors
/// It cannot be run, or does not succeed.
pub fn output(command: &mut Command) -> Result<String, Failure> {
    let line = line(command);
    eprintln!("$ {line}");
    let output = command.output().map_err(|why| format!("cannot run '{line}': {why}"))?;
    if !output.status.success() {
        let errors = String::from_utf8_lossy(&output.stderr);
        return Err(format!("'{line}' failed: {}\n{errors}", output.status).into());
    }
    Ok(String::from_utf8_lossy(&output.stdout).into_owned())
}

/// A command as one would type it.
fn line(command: &Command) -> String {
    let program = Path::new(command.get_program());
    let name = program.file_name().unwrap_or(program.as_os_str());
    let words = std::iter::once(name).chain(command.get_args());
    words.map(|word| word.to_string_lossy()).collect::<Vec<_>>().join(" ")
}
