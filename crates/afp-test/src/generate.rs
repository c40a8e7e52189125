//! Scenarios generated from a plan: every event of every supervisor, at five points of each
//! element's run.
//!
//! Sample runs of the plan give the activation times of elements. The first run has no stimuli.
//! Others have a different seed. Further ones fire an event or finish an actor at some time. An
//! element that no run reaches has no scenario, and the generated file lists it.

mod draft;
mod pair;
mod reach;

use std::collections::HashMap;
use std::fmt::Write;
use std::sync::Arc;

use afp_core::devices::{DeviceRow, find_signal};
use afp_dsl::graph::{Component, Graph};
use afp_dsl::scenario::Scenario;
use afp_run::RunError;

use crate::parts::Parts;
use crate::verdict::Verdict;
use draft::Draft;
use pair::Pair;
use reach::Reach;

/// The mark of a generated file.
const MADE_BY: &str = "// Made by 'afpc test --generate'.";

/// Whether a file of scenarios is generated, so that it may be overwritten.
pub fn is_generated(text: &str) -> bool {
    text.lines().any(|line| line == MADE_BY)
}

/// Scenarios generated for a plan.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Generated {
    drafts: Vec<Draft>,
    /// Omitted scenarios, with their reasons.
    pub left_out: Vec<String>,
}

/// The robot's signals for stopping; if it has such signals, scenarios check them.
#[derive(Clone, Copy, Debug)]
struct Rest {
    /// `robot.halted`: whether the last command was to stop.
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

/// Generates scenarios for a graph's plan and all its sub-plans. `quiet` is a run of the plan
/// without stimuli, `robot` has the robot's devices, and `run` executes runs.
///
/// The scenarios expect the direct effect of each event. [`Generated::prove`] adds later effects.
///
/// # Errors
/// Those of `run`.
pub fn generate(
    quiet: &Scenario,
    robot: &[DeviceRow],
    run: &mut dyn FnMut(&Scenario) -> Result<Verdict, RunError>,
) -> Result<Generated, RunError> {
    let graph: &Arc<Graph> = &quiet.graph;
    let parts = Parts::new(graph);
    let rest = Rest::of(robot);
    let reach = Reach::explore(&parts, quiet, run)?;
    let mut all = Generated { drafts: Vec::new(), left_out: Vec::new() };
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
    if all.drafts.is_empty() && all.left_out.is_empty() {
        let plan = parts.path(0);
        all.left_out.push(format!("no event interrupts anything in '{plan}'"));
    }
    Ok(all)
}

impl Generated {
    /// The number of scenarios.
    pub fn count(&self) -> usize {
        self.drafts.len()
    }

    /// The text of their file in canonical form, except for alignment. `from` is the plan's file
    /// relative to that one.
    pub fn text(&self, from: &str) -> String {
        let mut text = format!("use \"{from}\"\n\n{MADE_BY}\n");
        for why in &self.left_out {
            // Writing to a String cannot fail.
            let _ = writeln!(text, "// Left out: {why}.");
        }
        self.drafts.iter().for_each(|draft| draft.write(&mut text));
        text
    }

    /// Runs the scenarios, so that all remaining ones pass on the current plan. If the plan later
    /// ends in `Error`, the scenario expects that; other failing scenarios are omitted. `read`
    /// parses the text of a file, and `run_all` returns the verdict of each scenario.
    ///
    /// # Errors
    /// Those of `read` and `run_all`.
    pub fn prove<E>(
        &mut self,
        read: impl Fn(&Generated) -> Result<Vec<Scenario>, E>,
        run_all: impl Fn(&[Scenario]) -> Result<Vec<Verdict>, E>,
    ) -> Result<(), E> {
        while self.drafts.iter().any(|draft| !draft.proven) {
            let is_new = |name: &str| self.drafts.iter().any(|it| !it.proven && it.title == name);
            let mut scenarios = read(self)?;
            scenarios.retain(|scenario| is_new(&scenario.name));
            let verdicts = run_all(&scenarios)?;
            let came: HashMap<_, _> =
                scenarios.iter().map(|scenario| &*scenario.name).zip(&verdicts).collect();
            let left_out = &mut self.left_out;
            self.drafts.retain_mut(|draft| {
                let judged = match came.get(&*draft.title) {
                    _ if draft.proven => Ok(()),
                    Some(verdict) => draft.judge(verdict),
                    None => Err(format!("'{}' is not a scenario of the plan", draft.title)),
                };
                judged.map_err(|why| left_out.push(why)).is_ok()
            });
        }
        Ok(())
    }
}
