//! The state of a running plan, reconstructed from its events.

use std::collections::BTreeMap;

use afp_core::trace::{ComponentId, Outcome, TraceEntryId};
use afp_core::{Duration, Instant};
use afp_dsl::types::Constant;
use afp_dsl::unfold::ComponentKind;
use afp_session::{Datum, EndingKind, EventAt, EventKind, Miss, NamedOutcome, RunEvent};

use crate::program::Program;
use crate::text::Line;

/// The active elements, watching supervisors and values of entries, computed from all events up to
/// an instant.
#[derive(Clone, Debug, Default)]
pub struct State {
    /// The active element of each plan, by the plan's number.
    active: BTreeMap<ComponentId, ComponentId>,
    /// The elements that are set aside, and since when.
    suspended: BTreeMap<ComponentId, Instant>,
    /// The supervisors that watch, and since when.
    watching: BTreeMap<ComponentId, Instant>,
    /// Values of written entries.
    entries: BTreeMap<TraceEntryId, Datum>,
    /// The inputs of components at their start, by port.
    inputs: BTreeMap<ComponentId, (Instant, BTreeMap<String, Datum>)>,
    /// Each supervisor's last event and its time.
    reports: BTreeMap<ComponentId, (Instant, String)>,
    /// Each supervisor's number of missed deadlines, and the last one.
    misses: BTreeMap<ComponentId, (u64, Miss)>,
    /// The last time of each state, and of each event by its own edge.
    reached: BTreeMap<(ComponentId, Outcome), Instant>,
    /// The last time of each event with a reaction of the element: element, supervisor, event.
    reacted: BTreeMap<(ComponentId, ComponentId, Outcome), Instant>,
    /// The last edge taken in each plan.
    taken: BTreeMap<ComponentId, Taken>,
    /// The edge of each element's last start; `None` for the start of its plan.
    causes: BTreeMap<ComponentId, Option<Taken>>,
    /// The time of each element's last start.
    since: BTreeMap<ComponentId, Instant>,
    /// How the plan ended, with the reason for `Error`.
    ended: Option<(EndingKind, String)>,
    /// The last edge of the plan.
    ended_by: Option<Taken>,
}

/// An edge that was taken.
#[derive(Clone, Debug, PartialEq)]
pub struct Taken {
    pub by: ComponentId,
    pub outcome: String,
    pub target: String,
    pub text: String,
    at: Instant,
}

impl State {
    pub fn apply(&mut self, event: &RunEvent, program: &Program) {
        let id = event.component.id;
        self.follow(event, program);
        match &event.kind {
            EventKind::Started => self.start(id, event.at, program),
            EventKind::Finished(_) | EventKind::Interrupted | EventKind::Diverted { .. } => {
                self.leave(id, program);
            }
            EventKind::Suspended { .. } => {
                self.leave(id, program);
                self.suspended.insert(id, event.at);
            }
            EventKind::Returned { .. } => {
                self.suspended.remove(&id);
                self.start(id, event.at, program);
            }
            EventKind::Abandoned { .. } => {
                self.suspended.remove(&id);
            }
            EventKind::Committed { entry_id, new, .. } => {
                self.entries.insert(*entry_id, new.clone());
            }
            EventKind::Input { port, value, .. } => {
                let (at, ports) = self.inputs.entry(id).or_default();
                if *at != event.at {
                    ports.clear();
                }
                *at = event.at;
                ports.insert(port.clone(), value.clone());
            }
            // A poll without a report keeps the last report.
            EventKind::Polled(Ok(None)) => {}
            EventKind::Polled(Ok(Some(reported))) => {
                self.reports.insert(id, (event.at, reported.name.clone()));
            }
            EventKind::Polled(Err(fault)) => {
                self.reports.insert(id, (event.at, format!("failed: {}", fault.text)));
            }
            EventKind::Missed(miss) => {
                let before = self.misses.get(&id).map_or(0, |(count, _)| *count);
                self.misses.insert(id, (before + miss.deadlines(), *miss));
            }
            EventKind::Ended { ending, fault } => {
                self.close(id, program);
                if id == ComponentId(0) {
                    self.ended = Some((*ending, fault.text.clone()));
                    let led = self.taken.remove(&id);
                    self.ended_by = led.filter(|led| led.at == event.at);
                }
            }
            _ => {}
        }
    }

    /// Records the edges by which elements become active.
    fn follow(&mut self, event: &RunEvent, program: &Program) {
        let by = event.component.id;
        let (outcome, element) = match &event.kind {
            // The event that diverts a start came earlier, and so did the computations after it.
            EventKind::Finished(state) => (state.clone(), None),
            EventKind::Event(EventAt { event, element, .. }) => (event.clone(), Some(element.id)),
            EventKind::Faulted(_) => {
                let (name, outcome) = ("Error".to_owned(), Outcome::Declared(0));
                (NamedOutcome { name, outcome, target: String::new() }, None)
            }
            EventKind::Started => return self.begin(by, event.at, program),
            _ => return,
        };
        if program.unit(by).is_some_and(|unit| unit.kind == ComponentKind::Computation) {
            // It is done at once, without a start event.
            self.begin(by, event.at, program);
        }
        let NamedOutcome { name, outcome, target } = outcome;
        let reacts = |element: &ComponentId| {
            let mut reactions = program.unit(*element).into_iter().flat_map(|it| &it.reactions);
            reactions.any(|(of, to, _)| (*of, *to) == (by, outcome))
        };
        match element.filter(reacts) {
            Some(element) => self.reacted.insert((element, by, outcome), event.at),
            None => self.reached.insert((by, outcome), event.at),
        };
        if let Some(unit) = program.unit(by) {
            let text = Line(event).to_string();
            self.taken.insert(unit.plan, Taken { by, outcome: name, target, text, at: event.at });
        }
    }

    /// Records why an element becomes active.
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

    /// Ends an element and everything inside it.
    fn leave(&mut self, id: ComponentId, program: &Program) {
        let Some(unit) = program.unit(id) else { return };
        if self.active.get(&unit.plan) == Some(&id) {
            self.active.remove(&unit.plan);
        }
        self.close(id, program);
        let owner = |supervisor: &ComponentId| program.unit(*supervisor).and_then(|it| it.owner);
        self.watching.retain(|supervisor, _| owner(supervisor) != Some(id));
    }

    /// Ends everything in a plan.
    fn close(&mut self, plan: ComponentId, program: &Program) {
        let inner = self.active.remove(&plan);
        let of = |id: &ComponentId| program.unit(*id).map(|it| it.plan);
        self.watching.retain(|supervisor, _| of(supervisor) != Some(plan));
        self.suspended.retain(|element, _| of(element) != Some(plan));
        inner.into_iter().for_each(|inner| self.close(inner, program));
    }

    /// The active element of each nested plan, outermost first.
    pub fn stack(&self) -> Vec<ComponentId> {
        let next = |plan: &ComponentId| self.active.get(plan).copied();
        std::iter::successors(next(&ComponentId(0)), next).collect()
    }

    /// The elements that are set aside, by number, and since when.
    pub fn suspended(&self) -> impl Iterator<Item = (ComponentId, Instant)> + '_ {
        self.suspended.iter().map(|(id, since)| (*id, *since))
    }

    /// The watching supervisors, by number.
    pub fn watching(&self) -> impl Iterator<Item = ComponentId> + '_ {
        self.watching.keys().copied()
    }

    /// The active element of a plan, by the plan's number.
    pub fn active(&self, plan: ComponentId) -> Option<ComponentId> {
        self.active.get(&plan).copied()
    }

    /// The next poll of a supervisor with a period; the grid begins with its watch.
    pub fn next_release(&self, id: ComponentId, every: Duration, now: Instant) -> Option<Instant> {
        let since = *self.watching.get(&id)?;
        let every = every.max(Duration::from_nanos(1));
        Some(since + every * ((now - since).periods(every) + 1))
    }

    /// The value of an entry; `None` before the first write.
    pub fn entry(&self, id: TraceEntryId) -> Option<&Datum> {
        self.entries.get(&id)
    }

    /// The values of all entries, by number, for formulas.
    pub(crate) fn constants(&self, program: &Program) -> Vec<Constant> {
        let ids = (0..program.entries.len() as u32).map(TraceEntryId);
        ids.map(|id| program.constant(id, self.entry(id))).collect()
    }

    /// The inputs of a component at its start, by port.
    pub fn inputs(&self, id: ComponentId) -> impl Iterator<Item = (&str, &Datum)> {
        let ports = self.inputs.get(&id).into_iter().flat_map(|(_, ports)| ports);
        ports.map(|(name, value)| (&**name, value))
    }

    /// The last event of a supervisor, and its time.
    pub fn report(&self, id: ComponentId) -> Option<(Instant, &str)> {
        self.reports.get(&id).map(|(at, event)| (*at, &**event))
    }

    /// The missed deadlines of a supervisor, and the last one.
    pub fn misses(&self, id: ComponentId) -> Option<(u64, Miss)> {
        self.misses.get(&id).copied()
    }

    /// The last time of an event with a reaction of the element.
    pub fn reacted(
        &self,
        element: ComponentId,
        supervisor: ComponentId,
        event: Outcome,
    ) -> Option<Instant> {
        self.reacted.get(&(element, supervisor, event)).copied()
    }

    /// The last time of a state, or of an event by its own edge.
    pub fn reached(&self, id: ComponentId, outcome: Outcome) -> Option<Instant> {
        self.reached.get(&(id, outcome)).copied()
    }

    /// The last start of a component, and its edge; no edge for the start of its plan.
    pub fn cause(&self, id: ComponentId) -> Option<(Instant, Option<&Taken>)> {
        let since = *self.since.get(&id)?;
        Some((since, self.causes.get(&id)?.as_ref()))
    }

    /// Whether an element is active or a supervisor watches.
    pub fn is_on(&self, id: ComponentId) -> bool {
        self.watching.contains_key(&id) || self.active.values().any(|active| *active == id)
    }

    /// The last edge of the plan; `None` if it was stopped.
    pub fn ended_by(&self) -> Option<&Taken> {
        self.ended_by.as_ref()
    }

    /// How the plan ended, with the reason for `Error`.
    pub fn ended(&self) -> Option<(EndingKind, &str)> {
        self.ended.as_ref().map(|(ending, why)| (*ending, &**why))
    }
}
