//! What is the case in a running plan, as far as its events tell.

use std::collections::{BTreeMap, BTreeSet};

use afp_core::Instant;
use afp_core::trace::{ComponentId, TraceEntryId};
use afp_dsl::unfold::Kind;
use afp_session::{Datum, EndingKind, EventKind, Miss, RunEvent};

use crate::program::Program;

/// What is active, what watches, what entries hold: all events up to an instant, put together.
#[derive(Clone, Debug, Default)]
pub struct State {
    /// The active element of each plan, by the plan's number.
    active: BTreeMap<ComponentId, ComponentId>,
    /// The supervisors that watch.
    watching: BTreeSet<ComponentId>,
    /// Values of entries that were written.
    entries: BTreeMap<TraceEntryId, Datum>,
    /// What components started with, by port.
    inputs: BTreeMap<ComponentId, (Instant, BTreeMap<String, Datum>)>,
    /// The last event that a supervisor reported, and when.
    reports: BTreeMap<ComponentId, (Instant, String)>,
    /// Deadlines that a supervisor missed, and the last of them.
    misses: BTreeMap<ComponentId, (u64, Miss)>,
    /// How the plan ended, and in words why where that is `Error`.
    ended: Option<(EndingKind, String)>,
}

impl State {
    /// Takes in the next event.
    pub fn apply(&mut self, event: &RunEvent, program: &Program) {
        let id = event.component_id;
        match event.kind {
            EventKind::Started => self.start(id, program),
            EventKind::Finished | EventKind::Interrupted => self.leave(id, program),
            EventKind::Diverted => self.leave(id, program),
            EventKind::Committed => {
                let value = event.value.clone().unwrap_or(Datum::Unset);
                self.entries.insert(event.entry_id, value);
            }
            EventKind::Input => self.read(event),
            // What saw nothing leaves what was seen last.
            EventKind::Polled if event.outcome.is_empty() && event.fault.is_empty() => {}
            EventKind::Polled => {
                let said = match &*event.fault_text {
                    "" => event.outcome.clone(),
                    why => format!("failed: {why}"),
                };
                self.reports.insert(id, (event.at, said));
            }
            EventKind::Missed => {
                if let Some(miss) = event.missed {
                    let before = self.misses.get(&id).map_or(0, |(count, _)| *count);
                    self.misses.insert(id, (before + 1 + miss.skipped, miss));
                }
            }
            EventKind::Ended => self.end(event, program),
            _ => {}
        }
    }

    fn start(&mut self, id: ComponentId, program: &Program) {
        let Some(unit) = program.unit(id) else { return };
        match unit.kind {
            Kind::Supervisor => {
                self.watching.insert(id);
            }
            Kind::Plan => {}
            Kind::Actor | Kind::Computation | Kind::SubPlan => {
                self.active.insert(unit.plan, id);
            }
        }
    }

    /// An element is not active any more, and nothing inside it.
    fn leave(&mut self, id: ComponentId, program: &Program) {
        let Some(unit) = program.unit(id) else { return };
        if self.active.get(&unit.plan) == Some(&id) {
            self.active.remove(&unit.plan);
        }
        self.close(id, program);
        let owner = |supervisor: &ComponentId| program.unit(*supervisor).and_then(|it| it.owner);
        self.watching.retain(|supervisor| owner(supervisor) != Some(id));
    }

    /// Nothing in a plan goes on.
    fn close(&mut self, plan: ComponentId, program: &Program) {
        let inner = self.active.remove(&plan);
        let of = |supervisor: &ComponentId| program.unit(*supervisor).map(|it| it.plan);
        self.watching.retain(|supervisor| of(supervisor) != Some(plan));
        inner.into_iter().for_each(|inner| self.close(inner, program));
    }

    fn read(&mut self, event: &RunEvent) {
        let (at, ports) = self.inputs.entry(event.component_id).or_default();
        if *at != event.at {
            ports.clear();
        }
        *at = event.at;
        ports.insert(event.port.clone(), event.value.clone().unwrap_or(Datum::Unset));
    }

    fn end(&mut self, event: &RunEvent, program: &Program) {
        self.close(event.component_id, program);
        if event.component_id == ComponentId(0) {
            let ending = event.ending.unwrap_or(EndingKind::Ok);
            self.ended = Some((ending, event.fault_text.clone()));
        }
    }

    /// The active element of each nested plan, the outermost first.
    pub fn stack(&self) -> Vec<ComponentId> {
        let next = |plan: &ComponentId| self.active.get(plan).copied();
        std::iter::successors(next(&ComponentId(0)), next).collect()
    }

    /// The supervisors that watch, by number.
    pub fn watching(&self) -> impl Iterator<Item = ComponentId> + '_ {
        self.watching.iter().copied()
    }

    /// The value of an entry; none before it was written.
    pub fn entry(&self, id: TraceEntryId) -> Option<&Datum> {
        self.entries.get(&id)
    }

    /// What a component started with, by port.
    pub fn inputs(&self, id: ComponentId) -> impl Iterator<Item = (&str, &Datum)> {
        let ports = self.inputs.get(&id).into_iter().flat_map(|(_, ports)| ports);
        ports.map(|(name, value)| (&**name, value))
    }

    /// The last event that a supervisor reported, and when.
    pub fn report(&self, id: ComponentId) -> Option<(Instant, &str)> {
        self.reports.get(&id).map(|(at, event)| (*at, &**event))
    }

    /// How many deadlines a supervisor missed, and the last of them.
    pub fn misses(&self, id: ComponentId) -> Option<(u64, Miss)> {
        self.misses.get(&id).copied()
    }

    /// How the plan ended, and in words why where that is `Error`.
    pub fn ended(&self) -> Option<(EndingKind, &str)> {
        self.ended.as_ref().map(|(ending, why)| (*ending, &**why))
    }
}
