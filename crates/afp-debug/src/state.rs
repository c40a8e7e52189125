//! The state of a running plan, reconstructed from its events.

use std::collections::BTreeMap;

use afp_core::trace::{ComponentId, Outcome, TraceEntryId};
use afp_core::{Duration, Instant};
use afp_dsl::unfold::ComponentKind;
use afp_session::{Datum, EndingKind, EventKind, Miss, RunEvent};

use crate::program::Program;
use crate::text::Line;

/// What is active, what watches, what entries hold: all events up to an instant, put together.
#[derive(Clone, Debug, Default)]
pub struct State {
    /// The active element of each plan, by the plan's number.
    active: BTreeMap<ComponentId, ComponentId>,
    /// The supervisors that watch, and since when.
    watching: BTreeMap<ComponentId, Instant>,
    /// Values of entries that were written.
    entries: BTreeMap<TraceEntryId, Datum>,
    /// What components started with, by port.
    inputs: BTreeMap<ComponentId, (Instant, BTreeMap<String, Datum>)>,
    /// The last event that a supervisor reported, and when.
    reports: BTreeMap<ComponentId, (Instant, String)>,
    /// Deadlines that a supervisor missed, and the last of them.
    misses: BTreeMap<ComponentId, (u64, Miss)>,
    /// When each state was reached, and each event taken by its own edge, last.
    reached: BTreeMap<(ComponentId, Outcome), Instant>,
    /// When each event was taken last to which an element reacts by itself: element, supervisor, event.
    reacted: BTreeMap<(ComponentId, ComponentId, Outcome), Instant>,
    /// The last edge that was taken in each plan.
    taken: BTreeMap<ComponentId, Taken>,
    /// The edge by which each element became active last; none where its plan began with it.
    causes: BTreeMap<ComponentId, Option<Taken>>,
    /// When each element became active last.
    since: BTreeMap<ComponentId, Instant>,
    /// How the plan ended, and in words why where that is `Error`.
    ended: Option<(EndingKind, String)>,
    /// The edge by which it ended.
    ended_by: Option<Taken>,
}

/// An edge that was taken.
#[derive(Clone, Debug, PartialEq)]
pub struct Taken {
    /// The component that led along it.
    pub by: ComponentId,
    /// The state or event.
    pub outcome: String,
    /// Where to.
    pub target: String,
    /// In the words of the trace.
    pub text: String,
    at: Instant,
}

impl State {
    /// Takes in the next event.
    pub fn apply(&mut self, event: &RunEvent, program: &Program) {
        let id = event.component_id;
        self.follow(event, program);
        match event.kind {
            EventKind::Started => self.start(id, event.at, program),
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
                    self.misses.insert(id, (before + miss.deadlines(), miss));
                }
            }
            EventKind::Ended => self.end(event, program),
            _ => {}
        }
    }

    /// Keeps in mind by which edges elements become active.
    fn follow(&mut self, event: &RunEvent, program: &Program) {
        let id = event.component_id;
        let by = match event.kind {
            // The event that diverts a start was heard before, as were computations behind it.
            EventKind::Finished | EventKind::Event | EventKind::Faulted => id,
            EventKind::Started => return self.begin(id, event.at, program),
            _ => return,
        };
        if program.unit(by).is_some_and(|unit| unit.kind == ComponentKind::Computation) {
            // It is done at once, without a start.
            self.begin(by, event.at, program);
        }
        let (element, outcome) = (event.element_id, Outcome::from_number(event.outcome_id));
        let reactions = program.unit(element).map_or(&[][..], |unit| &unit.reactions);
        let reacts = |(of, to, _): &(ComponentId, Outcome, String)| (*of, *to) == (by, outcome);
        match event.kind == EventKind::Event && reactions.iter().any(reacts) {
            true => self.reacted.insert((element, by, outcome), event.at),
            false => self.reached.insert((by, outcome), event.at),
        };
        let (target, text) = (event.target.clone(), Line(event).to_string());
        if let Some(unit) = program.unit(by) {
            let outcome = match event.kind {
                EventKind::Faulted => "Error".to_owned(),
                _ => event.outcome.clone(),
            };
            self.taken.insert(unit.plan, Taken { by, outcome, target, text, at: event.at });
        }
    }

    /// Keeps in mind why an element becomes active.
    fn begin(&mut self, id: ComponentId, at: Instant, program: &Program) {
        let unit = program.unit(id).filter(|unit| unit.kind != ComponentKind::Supervisor);
        let Some(unit) = unit else { return };
        let led = self.taken.remove(&unit.plan);
        self.causes.insert(id, led.filter(|led| led.at == at && led.target == unit.name));
        self.since.insert(id, at);
    }

    fn start(&mut self, id: ComponentId, at: Instant, program: &Program) {
        let Some(unit) = program.unit(id) else { return };
        match unit.kind {
            ComponentKind::Supervisor => {
                self.watching.insert(id, at);
            }
            ComponentKind::Plan => {}
            ComponentKind::Actor | ComponentKind::Computation | ComponentKind::SubPlan => {
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
        self.watching.retain(|supervisor, _| owner(supervisor) != Some(id));
    }

    /// Nothing in a plan goes on.
    fn close(&mut self, plan: ComponentId, program: &Program) {
        let inner = self.active.remove(&plan);
        let of = |supervisor: &ComponentId| program.unit(*supervisor).map(|it| it.plan);
        self.watching.retain(|supervisor, _| of(supervisor) != Some(plan));
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
            self.ended_by = self.taken.remove(&ComponentId(0)).filter(|led| led.at == event.at);
        }
    }

    /// The active element of each nested plan, the outermost first.
    pub fn stack(&self) -> Vec<ComponentId> {
        let next = |plan: &ComponentId| self.active.get(plan).copied();
        std::iter::successors(next(&ComponentId(0)), next).collect()
    }

    /// The supervisors that watch, by number.
    pub fn watching(&self) -> impl Iterator<Item = ComponentId> + '_ {
        self.watching.keys().copied()
    }

    /// The active element of a plan, by the plan's number.
    pub fn active(&self, plan: ComponentId) -> Option<ComponentId> {
        self.active.get(&plan).copied()
    }

    /// When a supervisor that is asked so often is asked next: the grid begins where it began to watch.
    pub fn next_release(&self, id: ComponentId, every: Duration, now: Instant) -> Option<Instant> {
        let since = *self.watching.get(&id)?;
        let every = every.max(Duration::from_nanos(1));
        Some(since + every * ((now - since).periods(every) + 1))
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

    /// When an event was taken last to which an element reacts by itself.
    pub fn reacted(
        &self,
        element: ComponentId,
        supervisor: ComponentId,
        event: Outcome,
    ) -> Option<Instant> {
        self.reacted.get(&(element, supervisor, event)).copied()
    }

    /// When a state was reached, or an event taken by its own edge, last.
    pub fn reached(&self, id: ComponentId, outcome: Outcome) -> Option<Instant> {
        self.reached.get(&(id, outcome)).copied()
    }

    /// When a component started last, and the edge that led to it; none where its plan began with it.
    pub fn cause(&self, id: ComponentId) -> Option<(Instant, Option<&Taken>)> {
        let since = *self.since.get(&id)?;
        Some((since, self.causes.get(&id)?.as_ref()))
    }

    /// Whether an element is active, a supervisor watches.
    pub fn is_on(&self, id: ComponentId) -> bool {
        self.watching.contains_key(&id) || self.active.values().any(|active| *active == id)
    }

    /// The edge by which the plan ended; none where it was made to end.
    pub fn ended_by(&self) -> Option<&Taken> {
        self.ended_by.as_ref()
    }

    /// How the plan ended, and in words why where that is `Error`.
    pub fn ended(&self) -> Option<(EndingKind, &str)> {
        self.ended.as_ref().map(|(ending, why)| (*ending, &**why))
    }
}
