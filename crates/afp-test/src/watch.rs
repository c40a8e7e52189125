//! Follows the records of a run: edges, activations, values of entries and expectations.

mod aside;
mod broken;
mod claims;
mod expected;
pub(crate) mod hits;
pub(crate) mod moments;
pub(crate) mod signals;
#[cfg(test)]
mod tests;

use afp_core::devices::SignalId;
use afp_core::trace::{self, Author, ComponentId, ComponentKind, Ending};
use afp_core::trace::{Names, Record, TraceEntryId};
use afp_core::{Instant, Value, ValueOf, ValueRef};
use afp_dsl::scenario::{
    Cause, Claim, EndCause, Expectation, Operand, Outcome, Scenario, Subject, Wanted,
};
use afp_dsl::unfold::{Goal, Place, places};
use afp_session::{Datum, Holder, SampleRef};
use afp_types::{Measured, Quantity};

pub use broken::Broken;

use expected::Expected;
use hits::Hits;
use moments::Moments;
use signals::Signals;

/// Follows the run of a scenario.
pub(crate) struct Watch<'a> {
    scenario: &'a Scenario,
    places: Vec<Place>,
    state: State,
    /// A taken event whose element is not known yet.
    event: Option<Cause>,
    /// The current commit: its author, and its entries so far.
    commit: Option<(Author, Vec<TraceEntryId>)>,
    /// The start of each active component.
    since: Vec<Option<Instant>>,
    pub(crate) activations: Vec<Activation>,
    /// The outcome whose edge left the outermost plan.
    last: Option<Cause>,
    expected: Vec<Expected<'a>>,
    /// Whether a line expects an end in `Error`.
    expects_error: bool,
    pub(crate) moments: Moments<'a>,
    pub(crate) hits: Hits,
}

/// A time span in which an element was active.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Activation {
    /// The element's number in the graph.
    pub element: u32,
    /// The start.
    pub from: Instant,
    /// The end, or the end of the run.
    pub to: Instant,
}

/// A value for comparisons; a robot's signal can have strings that no entry has.
type Held = ValueOf<String>;

pub(crate) struct State {
    /// Whether each component is active, by number.
    active: Vec<bool>,
    /// Whether each component is suspended, by number.
    suspended: Vec<bool>,
    entries: Vec<Value>,
    /// The same values with names, for messages.
    named: Vec<Datum>,
    /// The SI unit of each entry.
    units: Vec<String>,
    pub(crate) ending: Option<Ending>,
    /// The message of the last fault.
    why: String,
    pub(crate) signals: Signals,
}

/// An event at an instant.
pub(crate) enum Occurrence {
    /// An edge was taken.
    Edge { from: u32, to: Option<Goal>, by: Cause },
    /// A reached state, or a taken event.
    Outcome(Cause),
    /// The plan ended.
    End(Ending, Option<Cause>),
    /// An element was interrupted.
    Interrupt(u32),
    /// A written entry, as the first or a later one of its commit.
    Commit { entry: u32, author: Author, first: bool },
}

impl<'a> Watch<'a> {
    pub(crate) fn new(scenario: &'a Scenario, names: &dyn Names, signals: Signals) -> Self {
        let places = places(&scenario.graph);
        let entries = (0..names.entries()).map(|id| names.entry(TraceEntryId(id)));
        let units: Vec<_> = entries.map(|entry| entry.unit.to_owned()).collect();
        Watch {
            state: State {
                active: vec![false; places.len()],
                suspended: vec![false; places.len()],
                entries: vec![Value::Unset; units.len()],
                named: vec![Datum::Unset; units.len()],
                units,
                ending: None,
                why: String::new(),
                signals,
            },
            hits: Hits::new(&scenario.graph),
            expected: scenario.expectations.iter().map(Expected::new).collect(),
            expects_error: scenario.expectations.iter().any(|line| expects_error(line, names)),
            moments: Moments::new(&scenario.moments),
            scenario,
            since: vec![None; places.len()],
            places,
            activations: Vec::new(),
            event: None,
            commit: None,
            last: None,
        }
    }

    /// The ending of the plan, if it has ended.
    pub(crate) fn ending(&self) -> Option<Ending> {
        self.state.ending
    }

    pub(crate) fn on_record(&mut self, at: Instant, record: &Record<'_>, names: &dyn Names) {
        self.hits.on_record(at, record);
        if !matches!(record, Record::Committed { .. }) {
            self.commit = None;
        }
        match *record {
            Record::Started { component } => self.set_active(at, component, true),
            Record::Event { supervisor, event, .. } => {
                let cause = cause(supervisor, event);
                self.event = Some(cause);
                self.on_occurrence(at, &Occurrence::Outcome(cause));
            }
            Record::Interrupted { element } => {
                self.set_active(at, element, false);
                self.on_occurrence(at, &Occurrence::Interrupt(element.0));
                self.ended_by_event(at, element);
            }
            Record::Diverted { element, .. } => self.ended_by_event(at, element),
            Record::Suspended { element, .. } => {
                self.set_aside(at, element);
                self.ended_by_event(at, element);
            }
            Record::Returned { component, .. } => self.set_active(at, component, true),
            Record::Abandoned { element, started } => self.abandoned(at, element, started),
            Record::Resumed { element, .. } => self.resumed(at, element),
            Record::Finished { element, state } => {
                self.set_active(at, element, false);
                self.leave(at, element, cause(element, state));
            }
            Record::Faulted { component, fault, detail } => {
                self.state.why = fault.explained(detail, names).to_string();
                self.failed(at, component);
            }
            Record::Committed { author, entry, new, .. } => {
                if let Some(named) = self.state.named.get_mut(entry.0 as usize) {
                    *named = Holder::Entry(entry).named(names, new);
                }
                self.committed(at, author, entry, new);
            }
            Record::Ended { plan, ending } => self.ended(at, plan, ending),
            _ => {}
        }
    }

    /// Whether the robot must be checked between steps.
    pub(crate) fn looks_at_robot(&self) -> bool {
        !self.state.signals.is_empty()
    }

    /// The first entry that differs from its commits: its number, its value, and the committed one.
    /// `held` are the entries of the outermost plan.
    pub(crate) fn differs<'v>(
        &'v self,
        held: impl Iterator<Item = ValueRef<'v>>,
    ) -> Option<(usize, ValueRef<'v>, ValueRef<'v>)> {
        let committed = self.state.entries.iter().map(Value::as_deref);
        let pairs = held.zip(committed).enumerate();
        let mut pairs = pairs.map(|(index, (held, committed))| (index, held, committed));
        pairs.find(|(_, held, committed)| held != committed)
    }

    pub(crate) fn signals(&self) -> &Signals {
        &self.state.signals
    }

    pub(crate) fn on_signal(&mut self, signal: SignalId, value: SampleRef<'_>) {
        self.state.signals.set(signal, value);
    }

    /// Ends the signals of an instant.
    pub(crate) fn after_samples(&mut self) {
        self.state.signals.after_samples();
    }

    /// Ends the step of an instant: its state holds until the next step.
    pub(crate) fn after_step(&mut self, at: Instant) {
        self.moments.after_step(at.as_nanos(), &self.state);
        for each in &mut self.expected {
            each.after_step(at.as_nanos(), &self.state, &self.moments);
        }
    }

    pub(crate) fn finish(&mut self, end: Instant) -> Vec<Broken> {
        for id in 0..self.since.len() as u32 {
            self.set_active(end, ComponentId(id), false);
        }
        let end = end.as_nanos();
        let mut broken: Vec<_> = std::mem::take(&mut self.expected)
            .into_iter()
            .filter_map(|each| each.finish(end, &self.state, &self.moments))
            .collect();
        broken.extend(self.moments.missed(end));
        broken.extend(self.unexpected_error(end));
        broken.sort_by_key(|broken| broken.at);
        broken
    }

    /// An end in `Error` without an expectation for it.
    fn unexpected_error(&self, end: u64) -> Option<Broken> {
        let Some(ending @ Ending::Error(_)) = self.state.ending else { return None };
        (!self.expects_error).then(|| Broken {
            text: "(a plan that ends in Error fails its scenario)".to_owned(),
            span: self.scenario.span,
            at: Instant::from_nanos(self.hits.ended.unwrap_or(end)),
            why: format!(
                "the plan ended in {}; if it must, write 'expect end by Error'",
                self.state.word(ending)
            ),
        })
    }

    fn committed(&mut self, at: Instant, author: Author, id: TraceEntryId, new: ValueRef<'_>) {
        let entry = id.0;
        if let Some(value) = self.state.entries.get_mut(entry as usize) {
            *value = new.to_value().unwrap_or_default();
        }
        // A commit writes each entry at most once.
        let first = match &mut self.commit {
            Some((known, entries)) if *known == author && !entries.contains(&id) => {
                entries.push(id);
                false
            }
            commit => {
                *commit = Some((author, vec![id]));
                true
            }
        };
        self.on_occurrence(at, &Occurrence::Commit { entry, author, first });
    }

    fn place(&self, id: ComponentId) -> Option<&Place> {
        self.places.get(id.0 as usize)
    }

    fn set_active(&mut self, at: Instant, id: ComponentId, active: bool) {
        if let Some(since) = self.since.get_mut(id.0 as usize) {
            if let Some(from) = since.take() {
                self.activations.push(Activation { element: id.0, from, to: at });
            }
            *since = active.then_some(at);
        }
        if active {
            self.state.set_suspended(id, false);
        }
        if let Some(known) = self.state.active.get_mut(id.0 as usize) {
            *known = active;
        }
    }

    /// An event ends an element of its own plan and everything inside it.
    fn ended_by_event(&mut self, at: Instant, element: ComponentId) {
        let Some(event) = self.event else { return };
        let home = |id: u32| self.places.get(id as usize).map(|place| place.plan);
        if home(event.component) == home(element.0) {
            self.event = None;
            self.leave(at, element, event);
        }
    }

    /// An element continues: the event's edge does not leave it.
    fn resumed(&mut self, at: Instant, element: ComponentId) {
        if let Some(by) = self.event.take() {
            let to = self.goal(by, element);
            self.on_occurrence(at, &Occurrence::Edge { from: element.0, to, by });
        }
    }

    fn leave(&mut self, at: Instant, element: ComponentId, by: Cause) {
        let to = self.goal(by, element);
        let outermost = self.place(element).is_some_and(|place| place.plan == 0);
        if outermost && matches!(to, Some(Goal::Terminate | Goal::Fail(_))) {
            self.last = Some(by);
        }
        if by.component == element.0 {
            self.on_occurrence(at, &Occurrence::Outcome(by));
        }
        self.on_occurrence(at, &Occurrence::Edge { from: element.0, to, by });
    }

    /// The target of an outcome during an element.
    fn goal(&self, by: Cause, element: ComponentId) -> Option<Goal> {
        let place = self.places.get(by.component as usize)?;
        let here = |event| self.place(element)?.reaction(by.component, event);
        match by.outcome? {
            Outcome::Declared(outcome) => {
                let own = place.outcomes.get(usize::from(outcome)).copied().flatten();
                here(Some(outcome)).or(own)
            }
            Outcome::Special => here(None).or(place.special),
        }
    }

    /// A component fails: its element, or the element that it watches, takes its `Error` edge.
    fn failed(&mut self, at: Instant, component: ComponentId) {
        let Some(place) = self.place(component) else { return };
        let element = place.owner.unwrap_or(component.0);
        let by = Cause { component: element, outcome: Some(Outcome::Special) };
        let outermost = place.plan == 0;
        self.set_active(at, ComponentId(element), false);
        match self.goal(by, ComponentId(element)) {
            Some(_) => self.leave(at, ComponentId(element), by),
            None if outermost => self.last = Some(by),
            None => {}
        }
    }

    fn ended(&mut self, at: Instant, plan: ComponentId, ending: Ending) {
        for (place, active) in self.places.iter().zip(&mut self.state.active) {
            if place.plan == plan.0 {
                *active = false;
            }
        }
        if plan == ComponentId(0) {
            self.state.ending = Some(ending);
            self.hits.ended = Some(at.as_nanos());
            let last = self.last;
            self.on_occurrence(at, &Occurrence::End(ending, last));
        }
    }

    fn on_occurrence(&mut self, at: Instant, occurrence: &Occurrence) {
        self.moments.on_occurrence(at.as_nanos(), occurrence);
        for each in &mut self.expected {
            each.on_occurrence(at.as_nanos(), occurrence, &self.moments);
        }
    }
}

impl State {
    /// The value of an entry or signal. The inner `None` means unset, an object, or a signal
    /// without a measurement; the outer one means that the signal has not sent anything yet.
    fn held(&self, subject: &Subject) -> Option<Option<Held>> {
        match subject {
            Subject::Entry(entry) => Some(self.entries.get(*entry as usize).and_then(held)),
            Subject::Signal(signal, field) => self.signals.said(signal, *field),
        }
    }

    /// The value of the other side of a comparison, likewise.
    fn operand(&self, operand: &Operand) -> Option<Option<Held>> {
        match operand {
            Operand::Value(value) => Some(held(value)),
            Operand::Subject(subject) => self.held(subject),
        }
    }

    /// The value for a message, distinguishable from another value; `None` if there is none.
    fn shown(&self, subject: &Subject, other: Option<&Held>) -> Option<String> {
        match subject {
            Subject::Signal(signal, field) => self.signals.shown(signal, *field, other),
            Subject::Entry(entry) => {
                let unit = self.units.get(*entry as usize).map_or("", String::as_str);
                match self.named.get(*entry as usize)? {
                    Datum::Unset => None,
                    Datum::Float(number) => Some(apart(*number, unit, other)),
                    value => Some(value.to_string()),
                }
            }
        }
    }
}

/// A readable number, with all digits if it would otherwise look like the other value.
fn apart(number: f64, unit: &str, other: Option<&Held>) -> String {
    let misleads = |other: f64| Measured::misleads(number, other, unit);
    let is_misleading = match other {
        Some(Held::Float(other)) => misleads(*other),
        Some(Held::Int(other)) => misleads(*other as f64),
        _ => false,
    };
    match is_misleading {
        true => Quantity { value: number, unit }.to_string(),
        false => Measured::new(number, unit).to_string(),
    }
}

/// A value for comparisons; `None` if it is unset or an object.
fn held(value: &Value) -> Option<Held> {
    let is_compared = !matches!(value, Value::Unset | Value::Object(_));
    is_compared.then(|| value.as_deref().map(str::to_owned, |choice| choice, |object| object))
}

fn cause(component: ComponentId, outcome: trace::Outcome) -> Cause {
    let outcome = match outcome {
        trace::Outcome::DeadlineMissed | trace::Outcome::Error => Outcome::Special,
        trace::Outcome::Declared(position) => Outcome::Declared(position),
    };
    Cause { component: component.0, outcome: Some(outcome) }
}

/// Whether an outcome matches a scenario's.
fn fits(wanted: &Cause, by: Cause) -> bool {
    wanted.component == by.component
        && wanted.outcome.is_none_or(|outcome| Some(outcome) == by.outcome)
}

/// Whether a line expects an end in `Error`, or by an element's `Error`.
fn expects_error(line: &Expectation, names: &dyn Names) -> bool {
    let is_named = match line.claim {
        Claim::End(Some(EndCause::Error)) => true,
        Claim::End(Some(EndCause::Cause(Cause { component, outcome }))) => {
            let kind = names.component(ComponentId(component)).kind;
            outcome == Some(Outcome::Special) && kind != ComponentKind::Supervisor
        }
        _ => false,
    };
    is_named && line.wanted != Wanted::Never
}

/// Whether the plan's ending matches a scenario's.
fn ends(wanted: Option<EndCause>, ending: Ending, last: Option<Cause>) -> bool {
    match wanted {
        None => true,
        Some(EndCause::Ok) => ending == Ending::Ok,
        Some(EndCause::Interrupted) => ending == Ending::Interrupted,
        Some(EndCause::Error) => matches!(ending, Ending::Error(_)),
        Some(EndCause::Cause(wanted)) => last.is_some_and(|last| fits(&wanted, last)),
    }
}
