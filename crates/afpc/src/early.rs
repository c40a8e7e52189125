//! Options that name what is not there, found before a robot or a toolbox of the project is built: that takes minutes.
//!
//! The run itself looks once more, with values and amounts.

use afp_dsl::graph::{EntryKind, Graph};
use afp_run::options::{OF_ROBOT, RunOptions};
use afp_run::world::{self, change};
use afp_run::{RunError, requests};
use afp_session::NotSet;

use crate::no_plan::NoPlan;
use crate::plan_file::PlanFile;
use crate::{Linked, declared, runner};

/// Looks whether the entries, controls, faults and the world that the options of a run name are there.
///
/// # Errors
/// One is not, or the project is wrong.
pub fn check(file: &PlanFile, options: &RunOptions, linked: &Linked<'_>) -> Result<(), NoPlan> {
    // What is wrong with a plan is told first.
    let Some(graph) = &file.compiled.graph else { return Ok(()) };
    // The run says it at once, and more of it.
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
    // Those of the world and of the robot itself, and entries of plans inside, which are not set from outside.
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
