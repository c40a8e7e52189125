//! The events of a run as plain data, with names instead of ids, so that they need no plan.
//!
//! Timelines, lines of JSON, Python and logs read them; the file of a log has another format.

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

/// An event of a run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RunEvent {
    /// Its time.
    pub at: Instant,
    /// Its component; for a commit, the author. Without a component, the number is 0 and the path
    /// empty.
    pub component: NamedComponent,
    /// Its kind.
    pub kind: EventKind,
}

/// The author of a commit from outside the plan.
pub const OUTSIDE: ComponentId = ComponentId(u32::MAX);

/// The kind of an event.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum EventKind {
    /// A kind that this release does not know.
    #[default]
    Unknown,
    /// The time of a step was earlier than that of the step before.
    ClockWentBack {
        /// The time of the step.
        asked: Instant,
    },
    /// The plan was asked to stop.
    StopRequested,
    /// A request from outside: a press, a fault, a write.
    Requested(Requested),
    /// A component is made to report an outcome.
    Injected(NamedOutcome),
    /// A supervisor was polled, with its event or its fault.
    Polled(Result<Option<NamedOutcome>, FaultText>),
    /// A deadline was missed.
    Missed(Miss),
    /// An event was taken.
    Event(EventAt),
    /// An event was not taken because it leads to the active element.
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
        /// The value before.
        old: Datum,
        /// The value after.
        new: Datum,
        /// The SI unit of the values.
        unit: String,
    },
    /// A component is about to start with a value at an input port.
    Input {
        /// The name of the port.
        port: String,
        /// The value.
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
        /// The supervisor.
        supervisor: NamedComponent,
    },
    /// An element continues after an event that did not interrupt it.
    Resumed {
        /// The supervisor of the event.
        supervisor: NamedComponent,
    },
    /// An element was set aside for a handler.
    Suspended {
        /// The supervisor of the event.
        supervisor: NamedComponent,
        /// Whether the element had started.
        started: bool,
    },
    /// A component that was suspended continues.
    Returned {
        /// The time since its suspension.
        away: Duration,
    },
    /// An element that was set aside was given up, and interrupted if it had started.
    Abandoned {
        /// Whether the element had started.
        started: bool,
    },
    /// A debugger holds the plan.
    Held {
        /// Whether the element has started and continues on release; otherwise it starts.
        started: bool,
    },
    /// A held plan continues.
    Released,
    /// A component failed.
    Faulted(FaultText),
    /// A plan ended.
    Ended {
        /// The ending.
        ending: EndingKind,
        /// The fault, if the ending is an error.
        fault: FaultText,
    },
    /// A number of records that could not be kept.
    Lost(u64),
}

/// A component by path and number.
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
    /// Its position among the outcomes of the component.
    pub outcome: Outcome,
    /// Its target: an element, a keyword or `suspend` with an element; empty until the outcome is
    /// taken.
    pub target: String,
}

/// An event during the activity or the start of an element.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct EventAt {
    /// The event.
    pub event: NamedOutcome,
    /// The element.
    pub element: NamedComponent,
    /// Whether the target comes from an `on` of the element and not from the supervisor.
    pub on: bool,
}

/// A fault as text.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct FaultText {
    /// The code of the fault.
    pub code: String,
    /// The text.
    pub text: String,
}

/// A missed deadline.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Miss {
    /// The time after the deadline.
    pub lateness: Duration,
    /// The cause, if known.
    pub cause: Option<Cause>,
    /// Releases without a poll.
    pub skipped: u64,
}

impl Miss {
    /// The number of missed deadlines: the skipped releases, and the poll itself if it was late.
    pub fn deadlines(&self) -> u64 {
        u64::from(self.lateness > Duration::ZERO) + self.skipped
    }
}

/// The ending of a plan.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EndingKind {
    /// The plan terminated.
    Ok,
    /// The plan was asked to stop.
    Interrupted,
    /// A component failed, and no edge handled the fault.
    Error,
}

/// A request from outside and its result.
#[derive(Clone, Debug, PartialEq)]
pub struct Requested {
    /// The time that it was made for.
    pub at: Instant,
    /// The request.
    pub what: Stimulus,
    /// The result.
    pub done: Done,
}

/// The result of a request.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Done {
    /// It was done.
    Done,
    /// It could not be done, for this reason.
    Refused(String),
    /// The run ended before.
    NotReached,
}

impl EndingKind {
    /// The ending as a word: `ok`, `interrupted`, `error`.
    pub fn word(self) -> &'static str {
        match self {
            EndingKind::Ok => "ok",
            EndingKind::Interrupted => "interrupted",
            EndingKind::Error => "error",
        }
    }
}

impl Miss {
    /// The cause as a word: `late_release`, `long_poll`; empty if unknown.
    pub fn word(&self) -> &'static str {
        match self.cause {
            Some(Cause::LateRelease) => "late_release",
            Some(Cause::LongPoll) => "long_poll",
            None => "",
        }
    }
}

/// The author of a commit: a path or `outside`.
pub fn author(names: &(impl Names + ?Sized), author: Author) -> String {
    Namer { names }.component(author_id(author)).path
}

fn author_id(author: Author) -> ComponentId {
    match author {
        Author::Component(id) => id,
        Author::Outside => OUTSIDE,
    }
}

impl RunEvent {
    /// Replaces ids in a record by names.
    pub fn new(at: Instant, record: &Record<'_>, names: &(impl Names + ?Sized)) -> RunEvent {
        let namer = Namer { names };
        let (id, kind) = namer.describe(record);
        RunEvent { at, component: namer.component(id), kind }
    }

    /// The event of a request from outside.
    pub fn requested(at: Instant, request: Requested) -> RunEvent {
        RunEvent { at, kind: EventKind::Requested(request), ..RunEvent::default() }
    }

    /// The record, complete enough for counts: without values, and with one fault for all. `None`
    /// if it does not concern a component.
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
            EventKind::Diverted { event, supervisor } => {
                let (supervisor, event) = (supervisor.id, event.outcome);
                Record::Diverted { element: component, supervisor, event }
            }
            EventKind::Suspended { supervisor, started } => {
                let (supervisor, started) = (supervisor.id, *started);
                Record::Suspended { element: component, supervisor, started }
            }
            EventKind::Returned { away } => Record::Returned { component, away: *away },
            EventKind::Abandoned { started } => {
                Record::Abandoned { element: component, started: *started }
            }
            EventKind::Held { started } => Record::Held { element: component, started: *started },
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
