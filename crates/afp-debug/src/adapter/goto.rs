//! Goes to an element along the plan's own edges: active elements and watching supervisors report
//! the outcomes on the path.
//!
//! Every entry into an element follows an edge, so values come from the edges on the path. Sensors
//! could produce the same trace, so the run can be stepped back and repeated.

use std::collections::VecDeque;
use std::collections::btree_map::{BTreeMap, Entry};
use std::time::Duration as Wall;

use afp_core::trace::{ComponentId, Outcome};
use afp_dsl::unfold::ComponentKind;
use afp_session::EventKind;

use super::mode::Mode;
use super::{Adapter, Answer, Refusal, Run};
use crate::program::{Program, Spot, Unit};
use crate::target::Happened;

#[derive(Clone, Debug, PartialEq, Eq)]
struct Report {
    component: ComponentId,
    outcome: String,
}

impl Adapter<'_> {
    /// Lists the elements at a line.
    pub(super) fn goto_targets(
        &mut self,
        asked: dapts::GotoTargetsArguments,
    ) -> Answer<dapts::GotoTargetsResponse> {
        let path = self.host.path(asked.source.path.as_deref().unwrap_or_default());
        let first = self.counting().first_line;
        let program = self.run()?.target.program();
        let line = asked.line.saturating_sub(first);
        let found = program.file(&path).and_then(|file| program.at_line(file, line));
        let (line, spots) = found.filter(|(at, _)| *at == line).unwrap_or((line, &[]));
        let elements = spots.iter().filter_map(|spot| match spot {
            Spot::Start(id) => Some(*id),
            Spot::Reports(id) if program.unit(*id)?.kind == ComponentKind::Computation => Some(*id),
            _ => None,
        });
        let targets = elements.filter_map(|id| {
            Some(dapts::GotoTarget {
                id: u64::from(id.0),
                label: program.unit(id)?.path.clone(),
                line: line + first,
                column: None,
                end_column: None,
                end_line: None,
                instruction_pointer_reference: None,
            })
        });
        Ok(dapts::GotoTargetsResponse { targets: targets.collect() })
    }

    /// Goes to an element, along edges.
    pub(super) fn goto(&mut self, asked: dapts::GotoArguments, now: Wall) -> Answer<()> {
        let run = self.run()?;
        if run.target.is_recorded() {
            return Err("a log cannot be changed: launch its plan to go to another element".into());
        }
        let id = u32::try_from(asked.target_id).map(ComponentId);
        let id = id.map_err(|_| Refusal("there is no such target".to_owned()))?;
        run.lead(id)?;
        self.go(Mode::Goto(id), now)
    }
}

impl Run<'_> {
    /// Causes the next report on the path to an element.
    fn lead(&mut self, to: ComponentId) -> Result<(), String> {
        let program = self.target.program().clone();
        let unit = program.unit(to).filter(|unit| unit.kind != ComponentKind::Supervisor);
        let unit = unit.ok_or("there is no such target")?;
        let Some(from) = self.target.state().active(unit.plan) else {
            let plan = program.unit(unit.plan).map_or("", |plan| &*plan.path);
            return Err(format!(
                "'{plan}' is not active: continue until it is, then go to the element"
            ));
        };
        let steps = way(&program, unit.plan, from, &unit.name);
        let Some(Report { component, outcome }) = steps else {
            let from = program.unit(from).map_or("", |unit| &*unit.name);
            return Err(format!("no edge from '{from}' to '{}' can be forced", unit.name));
        };
        self.target.fire(component, &outcome)
    }

    /// Causes the next report after a step on the path.
    ///
    /// # Errors
    /// The reason if no report leads on.
    pub(super) fn lead_on(&mut self, happened: &[Happened]) -> Result<(), String> {
        let Mode::Goto(to) = self.mode else { return Ok(()) };
        let plan = self.target.program().unit(to).map(|unit| unit.plan);
        let moved = happened.iter().any(|what| {
            let unit = self.target.program().unit(what.event.component.id);
            let started = what.event.kind == EventKind::Started;
            started
                && unit.is_some_and(|unit| {
                    Some(unit.plan) == plan && unit.kind != ComponentKind::Supervisor
                })
        });
        if moved { self.lead(to) } else { Ok(()) }
    }
}

/// Whether the target was reached; a computation is done as soon as it begins.
pub(super) fn is_there(happened: &[Happened], to: ComponentId) -> bool {
    happened.iter().any(|what| {
        let kind = matches!(what.event.kind, EventKind::Started | EventKind::Finished(_));
        kind && what.event.component.id == to
    })
}

/// The first report on a shortest path between two elements of a plan.
fn way(program: &Program, plan: ComponentId, from: ComponentId, to: &str) -> Option<Report> {
    let is_it =
        |unit: &Unit, name: &str| unit.plan == plan && unit.owner.is_none() && unit.name == name;
    let number = |name: &str| program.parts().find(|(_, unit)| is_it(unit, name)).map(|it| it.0);
    let mut first: BTreeMap<ComponentId, Option<Report>> = [(from, None)].into();
    let mut open = VecDeque::from([from]);
    while let Some(here) = open.pop_front() {
        for (report, target) in edges(program, plan, here) {
            let begun = first.get(&here).cloned().flatten().unwrap_or(report);
            if target == to {
                return Some(begun);
            }
            let Some(next) = number(target) else { continue };
            if let Entry::Vacant(free) = first.entry(next) {
                free.insert(Some(begun));
                open.push_back(next);
            }
        }
    }
    None
}

/// The edges that can be taken while an element is active: its own if it is an actor, and those of
/// its supervisors.
fn edges(program: &Program, plan: ComponentId, here: ComponentId) -> Vec<(Report, &str)> {
    let Some(unit) = program.unit(here) else { return Vec::new() };
    let report =
        |component: ComponentId, outcome: &str| Report { component, outcome: outcome.to_owned() };
    let mut all = Vec::new();
    if unit.kind == ComponentKind::Actor {
        all.extend(unit.outcomes.iter().map(|(name, target)| (report(here, name), &**target)));
    }
    let watchers = program.parts().filter(|(_, it)| {
        it.kind == ComponentKind::Supervisor
            && it.plan == plan
            && it.owner.is_none_or(|owner| owner == here)
    });
    for (id, watcher) in watchers {
        for (event, (name, target)) in (0..).map(Outcome::Declared).zip(&watcher.outcomes) {
            let own = unit.reactions.iter().find(|(of, on, _)| (*of, *on) == (id, event));
            let target = own.map_or(&**target, |(.., target)| target);
            all.push((report(id, name), target));
        }
        let missed = (id, Outcome::DeadlineMissed);
        let missed = unit.reactions.iter().find(|(of, on, _)| (*of, *on) == missed);
        all.extend(missed.map(|(.., target)| (report(id, "DeadlineMissed"), &**target)));
    }
    all
}
