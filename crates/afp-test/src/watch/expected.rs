//! A single expectation during a run.

use afp_core::{Ending, Fault, Instant, Value};
use afp_dsl::scenario::{Claim, Expectation, Operand, Subject, Wanted, Window};

use super::claims::{happens, holds};
use super::moments::Moments;
use super::{Broken, Occurrence, State};

/// The most times listed in a message.
const MOST: usize = 5;

/// The observations for an expectation so far.
pub(super) struct Expected<'a> {
    expectation: &'a Expectation,
    /// The time of the last step, and whether the claim has held since.
    now: Option<(u64, bool)>,
    /// The first instant of the window at which it held.
    held: Option<u64>,
    /// The first instant of the window at which it did not hold.
    failed: Option<u64>,
    /// The first occurrence outside the window.
    outside: Option<u64>,
    /// All occurrences in the window, if they are counted.
    times: Vec<u64>,
}

impl<'a> Expected<'a> {
    pub(super) fn new(expectation: &'a Expectation) -> Self {
        Expected {
            expectation,
            now: None,
            held: None,
            failed: None,
            outside: None,
            times: Vec::new(),
        }
    }

    pub(super) fn on_occurrence(
        &mut self,
        at: u64,
        occurrence: &Occurrence,
        moments: &Moments<'_>,
    ) {
        if !happens(&self.expectation.claim, occurrence) {
            return;
        }
        match self.window(moments).is_some_and(|window| window.contains(at)) {
            true => {
                self.held = self.held.or(Some(at));
                if let Wanted::Times(_) = self.expectation.wanted {
                    self.times.push(at);
                }
            }
            false => self.outside = self.outside.or(Some(at)),
        }
    }

    pub(super) fn after_step(&mut self, at: u64, state: &State, moments: &Moments<'_>) {
        let Some(holds) = holds(&self.expectation.claim, state) else { return };
        self.pass(at, moments);
        self.now = Some((at, holds));
    }

    /// The window, if it is known.
    fn window(&self, moments: &Moments<'_>) -> Option<Window> {
        Some(self.expectation.window.behind(moments.begin(self.expectation.from)?))
    }

    /// Records the state from the last step up to `at`, exclusive.
    fn pass(&mut self, at: u64, moments: &Moments<'_>) {
        let Some((since, held)) = self.now else { return };
        let Some(window) = self.window(moments) else { return };
        let first = since.max(window.from);
        if first >= at || first > window.to {
            return;
        }
        match held {
            true => self.held = self.held.or(Some(first)),
            false => self.failed = self.failed.or(Some(first)),
        }
    }

    /// Ends the run at `end` and returns the broken line.
    pub(super) fn finish(
        mut self,
        end: u64,
        state: &State,
        moments: &Moments<'_>,
    ) -> Option<Broken> {
        // The last state holds to the end of the run.
        self.pass(u64::MAX, moments);
        let expectation = self.expectation;
        // A missing moment is reported separately.
        let window = self.window(moments)?;
        let unsaid = self.now.is_none() && is_about_signal(&expectation.claim);
        let never_came = window.from > end;
        // An occurrence at a different time is the better explanation.
        let elsewhere = expectation.wanted == Wanted::Once && self.outside.is_some();
        let (at, why) = match expectation.wanted {
            _ if unsaid => (window.to.min(end), self.missing(state)),
            _ if never_came && !elsewhere => {
                let over = end as f64 / 1e9;
                (end, format!("that time never came: the run was over at {over:.3} s"))
            }
            Wanted::Once if self.held.is_some() => return None,
            Wanted::Once => (window.to.min(end), self.missing(state)),
            Wanted::Never => (self.held?, "it held".to_owned()),
            Wanted::Always => (self.failed?, self.otherwise(state)),
            Wanted::Times(wanted) if self.times.len() == wanted as usize => return None,
            Wanted::Times(wanted) => match self.times.get(wanted as usize) {
                Some(more) => (*more, self.often()),
                None if self.times.is_empty() => (window.to.min(end), self.missing(state)),
                None => (window.to.min(end), self.often()),
            },
        };
        let (text, span) = (expectation.text.clone(), expectation.span);
        Some(Broken { text, span, at: Instant::from_nanos(at), why })
    }

    /// The number of occurrences in words.
    fn often(&self) -> String {
        let at = self.times.iter().take(MOST).map(|at| format!("{:.3} s", *at as f64 / 1e9));
        let (count, at) = (self.times.len(), at.collect::<Vec<_>>().join(", "));
        let more = if count > MOST { " and so on" } else { "" };
        match count {
            1 => format!("it happened once, at {at}"),
            count => format!("it happened {count} times, at {at}{more}"),
        }
    }

    fn missing(&self, state: &State) -> String {
        match (&self.expectation.claim, self.outside) {
            (_, Some(at)) => {
                format!("it happened outside of that time, at {:.3} s", at as f64 / 1e9)
            }
            (Claim::End(_), None) => match state.ending {
                None => "the plan did not end".to_owned(),
                Some(ending) => format!("the plan ended differently, as {}", state.word(ending)),
            },
            (Claim::Compare { left, right, .. }, None) => compared(left, right, state),
            _ => "it did not happen".to_owned(),
        }
    }

    fn otherwise(&self, state: &State) -> String {
        match &self.expectation.claim {
            Claim::Compare { left, right, .. } => compared(left, right, state),
            _ => "it did not hold".to_owned(),
        }
    }
}

/// The reason for a broken comparison: the final values of both sides.
fn compared(left: &Subject, right: &Operand, state: &State) -> String {
    let (is, other) = (state.held(left).flatten(), state.operand(right).flatten());
    let shown = match (left, state.shown(left, other.as_ref())) {
        (Subject::Entry(_), None) => return "it was never written".to_owned(),
        (Subject::Signal(signal, _), None) => {
            return format!("the robot never returned a value of '{signal}'");
        }
        (_, Some(shown)) => shown,
    };
    match right {
        // For a boolean this is the complete reason.
        Operand::Value(Value::Bool(_)) => "it did not hold".to_owned(),
        Operand::Value(_) => format!("it did not hold; in the end it is {shown}"),
        Operand::Subject(other) => {
            let other = state.shown(other, is.as_ref()).unwrap_or_else(|| "nothing".to_owned());
            format!("it did not hold; in the end it is {shown}, compared with {other}")
        }
    }
}

fn is_about_signal(claim: &Claim) -> bool {
    let is_signal = |subject: &Subject| matches!(subject, Subject::Signal(..));
    match claim {
        Claim::Compare { left, right: Operand::Subject(right), .. } => {
            is_signal(left) || is_signal(right)
        }
        Claim::Compare { left, .. } => is_signal(left),
        _ => false,
    }
}

impl State {
    /// An ending in words. A plan that fails by its own edge has no component's fault.
    pub(super) fn word(&self, ending: Ending) -> String {
        match ending {
            Ending::Ok => "OK".to_owned(),
            Ending::Interrupted => "Interrupted".to_owned(),
            Ending::Error(fault) if fault.code() == Fault::FAILED || self.why.is_empty() => {
                format!("Error: {fault}")
            }
            Ending::Error(_) => format!("Error: {}", self.why),
        }
    }
}
