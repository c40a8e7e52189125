//! What happened in a run as plain data: names in place of ids, so that it needs no plan to be understood.
//!
//! Timelines, lines of JSON, Python and logs read this; a log's file alone has another form of it.

mod named;

use afp_core::trace::{
    Author, Cause, ComponentId, Ending, Names, Outcome, Record, TraceEntryId, Verdict,
};
use afp_core::{Duration, Fault, Instant, ValueRef};

use crate::datum::Datum;
use crate::stimulus::Stimulus;

use named::Namer;

/// One thing that happened in a run. What does not apply to its kind is empty.
#[derive(Clone, Debug, PartialEq)]
pub struct RunEvent {
    /// When.
    pub at: Instant,
    /// What.
    pub kind: EventKind,
    /// The path of the component that it is about; of a commit, of its author.
    pub component: String,
    /// Its number; [`OUTSIDE`] for a commit of nobody inside the plan.
    pub component_id: ComponentId,
    /// The state or event.
    pub outcome: String,
    /// Its position in the template.
    pub outcome_id: u16,
    /// Where the outcome leads: an element, `terminate`, `fail`, `ignore`, `resume`.
    pub target: String,
    /// The supervisor that diverted a start, or whose event resumed.
    pub supervisor: String,
    /// Its number.
    pub supervisor_id: ComponentId,
    /// The element that was active or being entered when an event was taken, or was not.
    pub element: String,
    /// Its number.
    pub element_id: ComponentId,
    /// Whether that element answered: the target is one of its `on`, not the supervisor's.
    pub on: bool,
    /// The entry that was written.
    pub entry: String,
    /// Its number.
    pub entry_id: TraceEntryId,
    /// The input port that was read.
    pub port: String,
    /// The value before a commit.
    pub old: Option<Datum>,
    /// The value after a commit, or of an input.
    pub value: Option<Datum>,
    /// The SI unit of the values.
    pub unit: String,
    /// The code of a fault.
    pub fault: String,
    /// The fault in words.
    pub fault_text: String,
    /// By how much a deadline was missed.
    pub missed: Option<Miss>,
    /// How a plan ended.
    pub ending: Option<EndingKind>,
    /// The time that a step was asked for when the clock went back.
    pub asked: Option<Instant>,
    /// How many records could not be kept.
    pub lost: u64,
    /// What came from outside.
    pub request: Option<Requested>,
}

/// The author of a commit that nobody inside the plan made.
pub const OUTSIDE: ComponentId = ComponentId(u32::MAX);

/// What kind of thing happened.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum EventKind {
    /// Something that this release does not know.
    #[default]
    Unknown,
    /// A step was asked for an earlier time than the one before.
    ClockWentBack,
    /// The plan was asked to stop.
    StopRequested,
    /// Something came from outside: a press, a fault, a write.
    Requested,
    /// A component was made to report an outcome.
    Injected,
    /// A supervisor was polled.
    Polled,
    /// A deadline was missed.
    Missed,
    /// An event was taken.
    Event,
    /// An event was not taken, as it leads to the element already active.
    AlreadyThere,
    /// An element was interrupted.
    Interrupted,
    /// An element reached a state.
    Finished,
    /// An entry changed.
    Committed,
    /// A component is about to start with a value at an input port.
    Input,
    /// A component started.
    Started,
    /// An event replaced the start of an element.
    Diverted,
    /// An element goes on after an event that did not interrupt it.
    Resumed,
    /// A component failed.
    Faulted,
    /// A plan ended.
    Ended,
    /// Records could not be kept.
    Lost,
}

/// A missed deadline.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Miss {
    /// The time after the deadline.
    pub lateness: Duration,
    /// Why, where that is known.
    pub cause: Option<Cause>,
    /// Releases that passed without a poll.
    pub skipped: u64,
}

impl Miss {
    /// How many deadlines were missed: those of the releases that passed, and the poll's own where it was late.
    pub fn deadlines(&self) -> u64 {
        u64::from(self.lateness > Duration::ZERO) + self.skipped
    }
}

/// How a plan ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EndingKind {
    /// As it says itself.
    Ok,
    /// It was asked to stop.
    Interrupted,
    /// A component failed and nobody dealt with it.
    Error,
}

/// What came from outside, and what became of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Requested {
    /// The instant that it was meant for.
    pub at: Instant,
    /// What.
    pub what: Stimulus,
    /// What became of it.
    pub done: Done,
}

/// What became of a request.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Done {
    /// It was done.
    Done,
    /// It could not be done, for this reason.
    Refused(String),
    /// The run was over before.
    NotReached,
}

impl EventKind {
    /// The kind in a word, as JSON and Python have it.
    pub fn word(self) -> &'static str {
        match self {
            EventKind::Unknown => "unknown",
            EventKind::ClockWentBack => "clock_went_back",
            EventKind::StopRequested => "stop_requested",
            EventKind::Requested => "requested",
            EventKind::Injected => "injected",
            EventKind::Polled => "polled",
            EventKind::Missed => "missed",
            EventKind::Event => "event",
            EventKind::AlreadyThere => "already_there",
            EventKind::Interrupted => "interrupted",
            EventKind::Finished => "finished",
            EventKind::Committed => "committed",
            EventKind::Input => "input",
            EventKind::Started => "started",
            EventKind::Diverted => "diverted",
            EventKind::Resumed => "resumed",
            EventKind::Faulted => "faulted",
            EventKind::Ended => "ended",
            EventKind::Lost => "lost",
        }
    }
}

impl EndingKind {
    /// The ending in a word: `ok`, `interrupted`, `error`.
    pub fn word(self) -> &'static str {
        match self {
            EndingKind::Ok => "ok",
            EndingKind::Interrupted => "interrupted",
            EndingKind::Error => "error",
        }
    }
}

impl Miss {
    /// Why, in a word: `late_release`, `long_poll`; empty where that is not known.
    pub fn word(&self) -> &'static str {
        match self.cause {
            Some(Cause::LateRelease) => "late_release",
            Some(Cause::LongPoll) => "long_poll",
            None => "",
        }
    }
}

/// The author of a commit: a path, or `outside`.
pub fn author(names: &(impl Names + ?Sized), author: Author) -> String {
    match author {
        Author::Component(id) => names.component(id).path.to_owned(),
        Author::Outside => "outside".to_owned(),
    }
}

impl Default for RunEvent {
    fn default() -> Self {
        let (none, text) = (ComponentId(0), String::new);
        RunEvent {
            at: Instant::ZERO,
            kind: EventKind::Unknown,
            component: text(),
            component_id: none,
            outcome: text(),
            outcome_id: 0,
            target: text(),
            supervisor: text(),
            supervisor_id: none,
            element: text(),
            element_id: none,
            on: false,
            entry: text(),
            entry_id: TraceEntryId(0),
            port: text(),
            old: None,
            value: None,
            unit: text(),
            fault: text(),
            fault_text: text(),
            missed: None,
            ending: None,
            asked: None,
            lost: 0,
            request: None,
        }
    }
}

impl RunEvent {
    /// A record with the names behind its ids.
    pub fn new(at: Instant, record: &Record<'_>, names: &(impl Names + ?Sized)) -> RunEvent {
        RunEvent { at, ..Namer { names }.describe(record) }
    }

    /// Something that came from outside.
    pub fn requested(at: Instant, request: Requested) -> RunEvent {
        RunEvent { at, kind: EventKind::Requested, request: Some(request), ..RunEvent::default() }
    }

    /// The record behind it, as far as counting matters: without values, and with one fault for all. `None` where
    /// it says nothing about components.
    pub fn record(&self) -> Option<Record<'static>> {
        let (component, none) = (self.component_id, ValueRef::Unset);
        let outcome = Outcome::from_number(self.outcome_id);
        Some(match self.kind {
            EventKind::Started => Record::Started { component },
            EventKind::Finished => Record::Finished { element: component, state: outcome },
            EventKind::Interrupted => Record::Interrupted { element: component },
            EventKind::Event => {
                let element = self.element_id;
                Record::Event { supervisor: component, event: outcome, element }
            }
            EventKind::Faulted => {
                Record::Faulted { component, fault: Fault::INTERNAL, detail: None }
            }
            EventKind::Polled => Record::Polled { supervisor: component, verdict: Verdict::Clear },
            EventKind::Missed => {
                let Miss { lateness, cause, skipped } = self.missed?;
                let cause = cause.unwrap_or(Cause::LateRelease);
                Record::Missed { supervisor: component, lateness, cause, skipped }
            }
            EventKind::Ended => Record::Ended {
                plan: component,
                ending: match self.ending? {
                    EndingKind::Ok => Ending::Ok,
                    EndingKind::Interrupted => Ending::Interrupted,
                    EndingKind::Error => Ending::Error(Fault::INTERNAL),
                },
            },
            EventKind::Committed => Record::Committed {
                author: match component {
                    OUTSIDE => Author::Outside,
                    component => Author::Component(component),
                },
                entry: self.entry_id,
                old: none,
                new: none,
            },
            _ => return None,
        })
    }
}
