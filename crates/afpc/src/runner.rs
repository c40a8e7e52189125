//! Runners: this program linked with the robot and toolboxes of a project.
//!
//! The first command that runs a plan of such a project builds the runner, caches it, and becomes
//! it. Later commands become it immediately until a source changes. Arguments, exit code, terminal
//! and signals are those of one process.

use std::env;
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::Command;

use afp_build::{Parts, Product};
use afp_dsl::graph::Graph;
use afp_project::ProjectFile;
use afp_run::RunError;
use afp_toolboxes::project::OwnToolboxes;

use crate::no_plan::NoPlan;
use crate::{FEATURES, Linked};

/// Returns if this program has the robot and the toolboxes of all these plans. Otherwise builds the
/// runner if needed, and replaces this process with the same arguments.
///
/// # Errors
/// A robot or a toolbox without a crate, two robots, two toolboxes of one name, no cargo, a crate
/// that does not build, a file that cannot be written.
pub fn become_one_for<'a>(
    plans: impl IntoIterator<Item = (&'a OwnToolboxes, &'a Graph)>,
    linked: &Linked<'_>,
) -> Result<(), NoPlan> {
    Parts::of_plans(plans)?.map_or(Ok(()), |parts| become_one(parts, linked))
}

/// Like [`become_one_for`] for one plan, with the hardware robot.
///
/// # Errors
/// Those of [`become_one_for`], and a project without a hardware robot.
pub fn become_one_with_hardware(
    own: &OwnToolboxes,
    graph: &Graph,
    linked: &Linked<'_>,
) -> Result<(), NoPlan> {
    become_one(Parts::of_plan_on_hardware(own, graph)?, linked)
}

/// Whether this program has the robot and the toolboxes of a plan.
///
/// # Errors
/// A robot or a toolbox without a crate.
pub fn is_linked(own: &OwnToolboxes, graph: &Graph, linked: &Linked<'_>) -> Result<bool, NoPlan> {
    let parts = Parts::of_plans([(own, graph)])?;
    Ok(parts.is_none_or(|parts| linked.has(&parts)))
}

/// Returns if this program has the robot of a project; otherwise becomes a runner with it.
///
/// # Errors
/// Those of [`become_one_for`].
pub fn become_one_of(project: &ProjectFile, linked: &Linked<'_>) -> Result<(), NoPlan> {
    become_one(Parts::of_robot(project)?, linked)
}

/// Returns if this program has all parts; otherwise becomes a runner with them.
fn become_one(parts: Parts<'_>, linked: &Linked<'_>) -> Result<(), NoPlan> {
    match linked.has(&parts) {
        true => Ok(()),
        false => Err(turn_into(&built(parts, linked)?).into()),
    }
}

/// The runner with these parts, built if needed.
///
/// # Errors
/// Those of [`become_one_for`]; this program is a runner itself.
pub fn built(parts: Parts<'_>, linked: &Linked<'_>) -> Result<PathBuf, NoPlan> {
    if linked.is_runner() {
        let message = format!("this runner was not built for {}", parts.names());
        return Err(RunError::usage(message, "start 'afpc' instead").into());
    }
    Ok(parts.product(Product::Runner(FEATURES))?)
}

/// Replaces this process with another program and the same arguments; returns only on failure.
#[cfg(unix)]
fn turn_into(program: &Path) -> RunError {
    use std::os::unix::process::CommandExt;
    let error = Command::new(program).args(arguments()).exec();
    RunError::file("cannot start", program)(error)
}

/// Runs another program with the same arguments and exits with its exit code.
#[cfg(not(unix))]
fn turn_into(program: &Path) -> RunError {
    match Command::new(program).args(arguments()).status() {
        Ok(status) => std::process::exit(status.code().unwrap_or(1)),
        Err(error) => RunError::file("cannot start", program)(error),
    }
}

fn arguments() -> impl Iterator<Item = OsString> {
    env::args_os().skip(1)
}
