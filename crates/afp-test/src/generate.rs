//! Scenarios made from a plan: every event of every supervisor, at five points of each element's run.
//!
//! Runs of the plan say when each element is active: first one without stimuli, then others with
//! another seed, then others in which somebody fires an event or finishes an actor on the way. What none
//! of them reaches has no scenario, and the text says so.

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

/// By what a file of scenarios is known that was made here.
const MADE_BY: &str = "// Made by 'afpc test --generate'.";

/// Whether a file of scenarios was made here: one that may be made again.
pub fn is_generated(text: &str) -> bool {
    text.lines().any(|line| line == MADE_BY)
}

/// Scenarios that were made for a plan.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Generated {
    drafts: Vec<Draft>,
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

/// Scenarios for a graph's plan and all its sub-plans. `quiet` is a run of the plan in which nothing happens;
/// `robot` has the devices of the robot that it runs on; `run` runs it, and others like it.
///
/// They say what an event does; whether that is all that happens is known once they have run: see [`Generated::prove`].
///
/// # Errors
/// What `run` says.
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
    /// How many scenarios there are.
    pub fn count(&self) -> usize {
        self.drafts.len()
    }

    /// The text of a file with them, as the formatter would have it but for alignment. `from` is the plan's file, seen
    /// from that one.
    pub fn text(&self, from: &str) -> String {
        let mut text = format!("use \"{from}\"\n\n{MADE_BY}\n");
        for why in &self.left_out {
            // Writing to a String cannot fail.
            let _ = writeln!(text, "// Left out: {why}.");
        }
        self.drafts.iter().for_each(|draft| draft.write(&mut text));
        text
    }

    /// Runs the scenarios, so that all that are left pass on the plan as it is: those whose plan goes on to end in `Error`
    /// expect that, what does not pass then is left out. `read` gives what stands in the text of a file with them,
    /// `run_all` what each scenario came to.
    ///
    /// # Errors
    /// What `read` and `run_all` say.
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
                    None => Err(format!("'{}' is no scenario of the plan", draft.title)),
                };
                judged.map_err(|why| left_out.push(why)).is_ok()
            });
        }
        Ok(())
    }
}
