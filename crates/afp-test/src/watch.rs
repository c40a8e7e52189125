//! Follows the records of a run: which edges are taken, what is active, what entries hold, what was expected.

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
    /// An event that was taken, until it is known which element it ends.
    event: Option<Cause>,
    /// The commit whose records are coming in: who writes, and which entries so far.
    commit: Option<(Author, Vec<TraceEntryId>)>,
    /// Since when each active component is.
    since: Vec<Option<Instant>>,
    pub(crate) activations: Vec<Activation>,
    /// What the edge out of the outermost plan belongs to.
    last: Option<Cause>,
    expected: Vec<Expected<'a>>,
    /// Whether a line expects that the plan ends in `Error`.
    expects_error: bool,
    pub(crate) moments: Moments<'a>,
    pub(crate) hits: Hits,
}

/// A stretch of time in which an element was active.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Activation {
    /// The element, by its number.
    pub element: u32,
    /// When it started.
    pub from: Instant,
    /// When it was left, or the run was over.
    pub to: Instant,
}

/// A value as it is compared: one that a robot signals may have a text that no entry holds.
type Held = ValueOf<String>;

/// How things stand.
pub(crate) struct State {
    /// Whether each component is active, by number.
    active: Vec<bool>,
    /// What each entry holds, by number.
    entries: Vec<Value>,
    /// The same with the names in it, for people.
    named: Vec<Datum>,
    /// The SI unit of each entry.
    units: Vec<String>,
    pub(crate) ending: Option<Ending>,
    /// What people are told of the last fault.
    why: String,
    pub(crate) signals: Signals,
}

/// Something that happened at an instant.
pub(crate) enum Occurrence {
    /// An edge was taken.
    Edge { from: u32, to: Option<Goal>, by: Cause },
    /// A state was reached or an event taken.
    Outcome(Cause),
    /// The plan ended.
    End(Ending, Option<Cause>),
    /// An element was interrupted.
    Interrupt(u32),
    /// An entry was written, as the first one of its commit or behind others.
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

    /// How the plan ended, once it has.
    pub(crate) fn ending(&self) -> Option<Ending> {
        self.state.ending
    }

    /// Takes a record into account.
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

    /// Whether the robot has to be looked at between steps.
    pub(crate) fn looks_at_robot(&self) -> bool {
        !self.state.signals.is_empty()
    }

    /// The first entry that holds something else than its commits say: its number, what it holds, and
    /// what was committed. `held` are the entries of the outermost plan.
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

    /// A signal of the robot says something.
    pub(crate) fn on_signal(&mut self, signal: SignalId, value: SampleRef<'_>) {
        self.state.signals.set(signal, value);
    }

    /// All signals of an instant have been heard.
    pub(crate) fn after_samples(&mut self) {
        self.state.signals.after_samples();
    }

    /// The step at this instant is over: what holds now holds until the next one.
    pub(crate) fn after_step(&mut self, at: Instant) {
        self.moments.after_step(at.as_nanos(), &self.state);
        for each in &mut self.expected {
            each.after_step(at.as_nanos(), &self.state, &self.moments);
        }
    }

    /// The run is over.
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

    /// A plan that ends in `Error` although no expectation names that.
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
        // A commit writes an entry once.
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
        if let Some(known) = self.state.active.get_mut(id.0 as usize) {
            *known = active;
        }
    }

    /// An event ends an element of its own plan; those inside of it end along with it.
    fn ended_by_event(&mut self, at: Instant, element: ComponentId) {
        let Some(event) = self.event else { return };
        let home = |id: u32| self.places.get(id as usize).map(|place| place.plan);
        if home(event.component) == home(element.0) {
            self.event = None;
            self.leave(at, element, event);
        }
    }

    /// An element goes on: the edge that the event took leaves nothing.
    fn resumed(&mut self, at: Instant, element: ComponentId) {
        if let Some(by) = self.event.take() {
            let to = self.goal(by, element);
            self.on_occurrence(at, &Occurrence::Edge { from: element.0, to, by });
        }
    }

    /// An element is left.
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

    /// Where an outcome leads while an element is active.
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

    /// A component failed: the element that it is, or that it watches over, takes its `Error` edge.
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
    /// What an entry holds or a signal says; nothing inside for an unset entry, an object, or a signal that measured
    /// nothing or fell silent; none at all for a signal that said nothing yet.
    fn held(&self, subject: &Subject) -> Option<Option<Held>> {
        match subject {
            Subject::Entry(entry) => Some(self.entries.get(*entry as usize).and_then(held)),
            Subject::Signal(signal, field) => self.signals.said(signal, *field),
        }
    }

    /// The same for what something is compared with.
    fn operand(&self, operand: &Operand) -> Option<Option<Held>> {
        match operand {
            Operand::Value(value) => Some(held(value)),
            Operand::Subject(subject) => self.held(subject),
        }
    }

    /// The same for people, so that it does not read like another value; none where there is nothing to tell.
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

/// A number as people write it; to its last digit if it would read like the other value.
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

/// A value as it is compared; `None` for an unset entry or an object.
fn held(value: &Value) -> Option<Held> {
    let is_compared = !matches!(value, Value::Unset | Value::Object(_));
    is_compared.then(|| value.as_deref().map(str::to_owned, |choice| choice, |object| object))
}

/// An outcome of the trace.
fn cause(component: ComponentId, outcome: trace::Outcome) -> Cause {
    let outcome = match outcome {
        trace::Outcome::DeadlineMissed | trace::Outcome::Error => Outcome::Special,
        trace::Outcome::Declared(position) => Outcome::Declared(position),
    };
    Cause { component: component.0, outcome: Some(outcome) }
}

/// Whether what happened is what a scenario names.
fn fits(wanted: &Cause, by: Cause) -> bool {
    wanted.component == by.component
        && wanted.outcome.is_none_or(|outcome| Some(outcome) == by.outcome)
}

/// Whether a line expects that the plan ends in `Error`, or by that of an element.
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

/// Whether the plan ended as a scenario says.
fn ends(wanted: Option<EndCause>, ending: Ending, last: Option<Cause>) -> bool {
    match wanted {
        None => true,
        Some(EndCause::Ok) => ending == Ending::Ok,
        Some(EndCause::Interrupted) => ending == Ending::Interrupted,
        Some(EndCause::Error) => matches!(ending, Ending::Error(_)),
        Some(EndCause::Cause(wanted)) => last.is_some_and(|last| fits(&wanted, last)),
    }
}
