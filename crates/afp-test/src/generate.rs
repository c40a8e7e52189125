//! Scenarios made from a plan: every event of every supervisor, at five points of each element's run.
//!
//! Runs of the plan say when each element is active: first one without stimuli, then others with
//! another seed, then others in which somebody fires an event or finishes an actor on the way. What none
//! of them reaches has no scenario, and the text says so.

mod pair;
mod reach;

use std::fmt::Write;
use std::sync::Arc;

use afp_core::devices::{DeviceRow, find_signal};
use afp_dsl::graph::{Component, Graph};
use afp_dsl::scenario::Scenario;
use afp_run::RunError;

use crate::parts::Parts;
use crate::verdict::Verdict;
use pair::Pair;
use reach::Reach;

/// By what a file of scenarios is known that was made here.
const MADE_BY: &str = "// Made by 'afpc test --generate'.";

/// Whether a file of scenarios was made here: one that may be made again.
pub fn is_generated(text: &str) -> bool {
    text.lines().any(|line| line == MADE_BY)
}

/// The text of a file of scenarios.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Generated {
    /// The text, as the formatter would have it but for alignment.
    pub text: String,
    /// How many scenarios it has.
    pub scenarios: usize,
    /// What has none, and why.
    pub left_out: Vec<String>,
}

/// What a robot signals when it is to stand and does; where it declares such signals, scenarios expect them.
#[derive(Clone, Copy, Debug)]
struct Rest {
    /// `robot.halted`: whether the last command was to stand.
    halted: bool,
    /// `robot.standing`: whether it does not move.
    standing: bool,
}

impl Rest {
    fn of(robot: &[DeviceRow]) -> Rest {
        let has = |name| find_signal(robot, "robot", name).is_some();
        Rest { halted: has("halted"), standing: has("standing") }
    }
}

/// Scenarios for a graph's plan and all its sub-plans. `from` is the plan's file, seen from the one to be
/// written; `quiet` is a run of the plan in which nothing happens; `robot` has the devices of the robot that it
/// runs on; `run` runs it, and others like it.
///
/// # Errors
/// What `run` says.
pub fn generate(
    from: &str,
    quiet: &Scenario,
    robot: &[DeviceRow],
    run: &mut dyn FnMut(&Scenario) -> Result<Verdict, RunError>,
) -> Result<Generated, RunError> {
    let graph: &Arc<Graph> = &quiet.graph;
    let parts = Parts::new(graph);
    let rest = Rest::of(robot);
    let reach = Reach::explore(&parts, quiet, run)?;
    let mut all = Generated { text: String::new(), scenarios: 0, left_out: Vec::new() };
    for element in parts.elements() {
        if matches!(parts.component(element), Some(Component::Computation(_)) | None) {
            continue;
        }
        let Some((run, active)) = reach.of(element) else {
            all.left_out.push(format!("no run reached '{}'", parts.path(element)));
            continue;
        };
        for supervisor in parts.supervisors_over(element) {
            let pair = Pair { parts: &parts, rest, run, active, element, supervisor };
            pair.add(&mut all);
        }
    }
    let mut text = format!("use \"{from}\"\n\n{MADE_BY}\n");
    for why in &all.left_out {
        // Writing to a String cannot fail.
        let _ = writeln!(text, "// Left out: {why}.");
    }
    text.push_str(&all.text);
    Ok(Generated { text, ..all })
}
