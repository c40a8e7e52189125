//! Runs of the interpreter as cases for a state chart engine.
//!
//! A run's trace lists events in order, with the positions of control in between. The events are
//! fed to the plan's chart. Whenever the trace names the position of control, the chart's active
//! states must agree. The module does not follow edges; all expectations come only from the trace.

mod places;
mod steps;

use std::cell::RefCell;

use afp_core::Instant;
use afp_core::trace::{Observe, Record};
use afp_dsl::graph::Graph;
use serde_json::{Value, json};

use crate::drive::drive_with;
use crate::interpret::load;
use crate::script::Script;
use steps::{Seen, Steps};

/// Makes the case of a plan under some scripts, for the program that feeds it to the engine:
/// `name`, `chart`, and `runs`, each a list of steps.
///
/// A step has an `event` (`null` for the start) and expectations: `active`, ids of active states;
/// `only`, the id of the only active state without states inside; `same`, no change. `cut` counts
/// the runs that end early because a value of a sub-plan did not convert or was out of its range,
/// which charts cannot see.
pub fn case(name: &str, graph: &Graph, scripts: &[Script]) -> Value {
    let places = places::places(graph);
    let runs = scripts.iter().map(|script| steps::steps(&places, &seen(graph, script)));
    let runs: Vec<Steps> = runs.collect();
    let cut = runs.iter().filter(|run| run.cut).count();
    let runs: Vec<Value> = runs.iter().map(Steps::json).collect();
    let chart = afp_draw::scxml(graph, None, true);
    json!({ "name": name, "chart": chart, "runs": runs, "cut": cut })
}

/// The interpreter's records about the flow of action.
fn seen(graph: &Graph, script: &Script) -> Vec<Seen> {
    let seen = RefCell::new(Vec::new());
    let note = |_: Instant, record: &Record<'_>| seen.borrow_mut().extend(Seen::of(record));
    drive_with(load(graph), script, Observe(note));
    seen.into_inner()
}
