//! Finds unknown names in options before a robot or toolbox is built, because a build takes
//! minutes.
//!
//! The run itself checks again, including values and amounts.

use afp_dsl::graph::{EntryKind, Graph};
use afp_run::options::{OF_ROBOT, RunOptions};
use afp_run::world::{self, change};
use afp_run::{RunError, requests};
use afp_session::NotSet;

use crate::no_plan::NoPlan;
use crate::plan_file::PlanFile;
use crate::{Linked, declared, runner};

/// Checks that the entries, controls, faults and the world in the options of a run exist.
///
/// # Errors
/// A name is unknown, or the project is invalid.
pub fn check(file: &PlanFile, options: &RunOptions, linked: &Linked<'_>) -> Result<(), NoPlan> {
    // Errors in the plan are reported first.
    let Some(graph) = &file.compiled.graph else { return Ok(()) };
    // The run itself reports it immediately, and in more detail.
    if runner::is_linked(&file.own, graph, linked)? {
        return Ok(());
    }
    if let Some(asked) = &options.world {
        world::check(asked)?;
    }
    let devices = declared::of_project(&file.own)?;
    let devices = devices.unwrap_or_else(|| linked.robot.kind().devices());
    requests::check(devices, &options.press, &options.fail)?;
    options.set.iter().try_for_each(|(name, _)| check_entry(graph, name))?;
    Ok(())
}

fn check_entry(graph: &Graph, name: &str) -> Result<(), RunError> {
    // Values of the world and the robot, and entries of sub-plans, which have their own rules.
    let is_else = change::key(name).is_some() || name.starts_with(OF_ROBOT) || name.contains('.');
    let entries = &graph.main().entries;
    if is_else || entries.iter().any(|entry| entry.name == name) {
        return Ok(());
    }
    let inputs = entries.iter().filter(|entry| entry.kind == EntryKind::In);
    let inputs = inputs.map(|entry| (entry.name.as_str(), entry.ty.to_string()));
    let NotSet { why, help, .. } = NotSet::unknown(name, inputs);
    Err(RunError::usage(why, help))
}
