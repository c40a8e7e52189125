//! What happened in a run as plain data: names in place of ids, so that it needs no plan to be understood.
//!
//! Timelines, lines of JSON, Python and logs read this; a log's file alone has another form of it.

mod facts;
mod named;

use afp_core::trace::{
    Author, Cause, ComponentId, Ending, Names, Outcome, Record, TraceEntryId, Verdict,
};
use afp_core::{Duration, Fault, Instant, ValueRef};

use crate::datum::Datum;
use crate::stimulus::Stimulus;

pub use facts::Facts;
use named::Namer;

/// One thing that happened in a run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RunEvent {
    /// When.
    pub at: Instant,
    /// The component that it is about; of a commit its author; the number 0 without a path for what is about none.
    pub component: NamedComponent,
    /// What.
    pub kind: EventKind,
}

/// The author of a commit that nobody inside the plan made.
pub const OUTSIDE: ComponentId = ComponentId(u32::MAX);

/// What happened.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum EventKind {
    /// Something that this release does not know.
    #[default]
    Unknown,
    /// A step was asked for an earlier time than the one before.
    ClockWentBack {
        /// The time asked for.
        asked: Instant,
    },
    /// The plan was asked to stop.
    StopRequested,
    /// Something came from outside: a press, a fault, a write.
    Requested(Requested),
    /// A component was made to report an outcome.
    Injected(NamedOutcome),
    /// A supervisor was polled: the event that it reported, or how it failed.
    Polled(Result<Option<NamedOutcome>, FaultText>),
    /// A deadline was missed.
    Missed(Miss),
    /// An event was taken.
    Event(EventAt),
    /// An event was not taken, as it leads to the element already active.
    AlreadyThere(EventAt),
    /// An element was interrupted.
    Interrupted,
    /// An element reached a state.
    Finished(NamedOutcome),
    /// An entry changed.
    Committed {
        /// The path of the entry.
        entry: String,
        /// Its number.
        entry_id: TraceEntryId,
        /// Its value before.
        old: Datum,
        /// Its value now.
        new: Datum,
        /// The SI unit of the values.
        unit: String,
    },
    /// A component is about to start with a value at an input port.
    Input {
        /// The name of the port.
        port: String,
        /// What it reads.
        value: Datum,
        /// The SI unit of the value.
        unit: String,
    },
    /// A component started.
    Started,
    /// An event replaced the start of an element.
    Diverted {
        /// The event of the supervisor.
        event: NamedOutcome,
        /// The supervisor that saw a reason.
        supervisor: NamedComponent,
    },
    /// An element goes on after an event that did not interrupt it.
    Resumed {
        /// The supervisor whose event it was.
        supervisor: NamedComponent,
    },
    /// A component failed.
    Faulted(FaultText),
    /// A plan ended.
    Ended {
        /// How.
        ending: EndingKind,
        /// Why, if it ended in an error.
        fault: FaultText,
    },
    /// So many records could not be kept.
    Lost(u64),
}

/// A component by its path and its number.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct NamedComponent {
    /// Dotted path from the outermost plan; `outside` for [`OUTSIDE`].
    pub path: String,
    /// Its number.
    pub id: ComponentId,
}

/// A state or event that a component reports.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NamedOutcome {
    /// Its name.
    pub name: String,
    /// Which of the component's outcomes it is.
    pub outcome: Outcome,
    /// Where it leads: an element, `terminate`, `fail`, `ignore`, `resume`; empty until it is taken.
    pub target: String,
}

/// An event while an element was active or being entered.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct EventAt {
    /// The event.
    pub event: NamedOutcome,
    /// The element.
    pub element: NamedComponent,
    /// Whether that element answered: the target is one of its `on`, not the supervisor's.
    pub on: bool,
}

/// Why something failed.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct FaultText {
    /// The code of the fault.
    pub code: String,
    /// The fault in words.
    pub text: String,
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
    Namer { names }.component(author_id(author)).path
}

/// The number of an author.
fn author_id(author: Author) -> ComponentId {
    match author {
        Author::Component(id) => id,
        Author::Outside => OUTSIDE,
    }
}

impl RunEvent {
    /// A record with the names behind its ids.
    pub fn new(at: Instant, record: &Record<'_>, names: &(impl Names + ?Sized)) -> RunEvent {
        let namer = Namer { names };
        let (id, kind) = namer.describe(record);
        RunEvent { at, component: namer.component(id), kind }
    }

    /// Something that came from outside.
    pub fn requested(at: Instant, request: Requested) -> RunEvent {
        RunEvent { at, kind: EventKind::Requested(request), ..RunEvent::default() }
    }

    /// The record behind it, as far as counting matters: without values, and with one fault for all. `None` where
    /// it says nothing about components.
    pub fn record(&self) -> Option<Record<'static>> {
        let (component, none) = (self.component.id, ValueRef::Unset);
        Some(match &self.kind {
            EventKind::Started => Record::Started { component },
            EventKind::Finished(NamedOutcome { outcome, .. }) => {
                Record::Finished { element: component, state: *outcome }
            }
            EventKind::Interrupted => Record::Interrupted { element: component },
            EventKind::Event(EventAt { event, element, .. }) => {
                let (event, element) = (event.outcome, element.id);
                Record::Event { supervisor: component, event, element }
            }
            EventKind::Faulted(_) => {
                Record::Faulted { component, fault: Fault::INTERNAL, detail: None }
            }
            EventKind::Polled(_) => {
                Record::Polled { supervisor: component, verdict: Verdict::Clear }
            }
            EventKind::Missed(Miss { lateness, cause, skipped }) => {
                let (lateness, skipped) = (*lateness, *skipped);
                let cause = cause.unwrap_or(Cause::LateRelease);
                Record::Missed { supervisor: component, lateness, cause, skipped }
            }
            EventKind::Ended { ending, .. } => Record::Ended {
                plan: component,
                ending: match ending {
                    EndingKind::Ok => Ending::Ok,
                    EndingKind::Interrupted => Ending::Interrupted,
                    EndingKind::Error => Ending::Error(Fault::INTERNAL),
                },
            },
            EventKind::Committed { entry_id, .. } => Record::Committed {
                author: match component {
                    OUTSIDE => Author::Outside,
                    component => Author::Component(component),
                },
                entry: *entry_id,
                old: none,
                new: none,
            },
            _ => return None,
        })
    }
}
