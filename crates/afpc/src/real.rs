//! The real robot of a project: of its own crate, or of a profile, whose driver is built in.

use afp_build::{Parts, no_hardware};
use afp_dsl::graph::Graph;
use afp_project::ProjectFile;
use afp_run::RunError;
use afp_session::{Opened, SessionError, Settings};
use afp_toolboxes::project::OwnToolboxes;

use crate::no_plan::NoPlan;
use crate::{Linked, runner};

/// Returns if this program can drive the real robot of a plan's project; otherwise becomes a runner
/// that can.
///
/// # Errors
/// The project has no real robot, or the runner cannot be built. A plan for a profile uses toolboxes
/// of the project.
pub fn link(own: &OwnToolboxes, graph: &Graph, linked: &Linked<'_>) -> Result<(), NoPlan> {
    if profile(&own.project).is_none() {
        return runner::become_one_with_hardware(own, graph, linked);
    }
    let parts = Parts::of_plans([(own, graph)])?;
    if let Some(parts) = parts.filter(|parts| !parts.is_empty()) {
        let message = format!("a robot with a profile does not run {}", parts.names());
        let help = "use the built-in toolboxes, or bring a robot in Rust: docs/robot.md";
        return Err(RunError::usage(message, help).into());
    }
    Ok(())
}

/// The settings of the real robot: names and values.
///
/// # Errors
/// Its crate is missing.
pub fn settings(project: &ProjectFile) -> Result<Vec<(String, String)>, RunError> {
    match profile(project) {
        Some(settings) => Ok(settings),
        None => Ok(project.hardware()?.map(|it| it.settings).unwrap_or_default()),
    }
}

/// Opens the real robot and puts a plan on it.
///
/// # Errors
/// The robot cannot be reached, or does not support the plan. This program has no driver for it.
pub fn open(
    project: &ProjectFile,
    graph: &Graph,
    settings: &Settings,
    linked: &Linked<'_>,
) -> Result<Opened, SessionError> {
    match (profile(project), linked.hardware) {
        (Some(_), _) => {
            let profile = project.project.profile().map_or("", |profile| profile.name);
            open_profile(profile, graph, settings)
        }
        (None, Some((_, opener))) => opener.open(graph, settings),
        (None, None) => Err(SessionError::Hardware(no_hardware(project).to_string().into())),
    }
}

fn profile(project: &ProjectFile) -> Option<Vec<(String, String)>> {
    project.project.robot.as_ref()?.profile_settings()
}

#[cfg(all(feature = "pi", unix))]
fn open_profile(profile: &str, graph: &Graph, settings: &Settings) -> Result<Opened, SessionError> {
    match afp_pi::opener(profile) {
        Some(opener) => opener.open(graph, settings),
        None => Err(SessionError::Hardware(format!("no driver for '{profile}'").into())),
    }
}

#[cfg(not(all(feature = "pi", unix)))]
fn open_profile(_: &str, _: &Graph, _: &Settings) -> Result<Opened, SessionError> {
    let why = "this 'afpc' has no drivers for robots with a profile: install it with \
               'pip install action-flow-plans', or build it with '--features pi'";
    Err(SessionError::Hardware(why.into()))
}
