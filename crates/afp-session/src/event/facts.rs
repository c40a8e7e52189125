//! The content of events in a uniform form, for lines of JSON and Python.

use super::{
    EndingKind, EventKind, FaultText, Miss, NamedComponent, NamedOutcome, Requested, RunEvent,
};
use crate::datum::Datum;
use afp_types::Duration;

/// The content of an event, without its component. Fields that the kind lacks are empty.
#[derive(Clone, Copy, Debug, Default)]
pub struct Facts<'a> {
    /// The state or event.
    pub outcome: Option<&'a NamedOutcome>,
    /// The element that was active or starting at an event.
    pub element: Option<&'a NamedComponent>,
    /// Whether the target comes from an `on` of the element and not from the supervisor.
    pub on: bool,
    /// The supervisor that diverted a start, or whose event resumed or suspended an element.
    pub supervisor: Option<&'a NamedComponent>,
    /// The entry that was written.
    pub entry: &'a str,
    /// The input port that was read.
    pub port: &'a str,
    /// The value before a commit.
    pub old: Option<&'a Datum>,
    /// The value after a commit, or of an input.
    pub value: Option<&'a Datum>,
    /// The SI unit of the values.
    pub unit: &'a str,
    /// Whether an element that was suspended, abandoned or held had started.
    pub started: Option<bool>,
    /// The time since the suspension of a component that returned.
    pub away: Option<Duration>,
    /// The fault.
    pub fault: Option<&'a FaultText>,
    /// The missed deadline.
    pub miss: Option<&'a Miss>,
    /// The ending of a plan.
    pub ending: Option<EndingKind>,
    /// The request from outside.
    pub request: Option<&'a Requested>,
}

impl RunEvent {
    /// The content of the event.
    pub fn facts(&self) -> Facts<'_> {
        let none = Facts::default();
        match &self.kind {
            EventKind::Unknown
            | EventKind::ClockWentBack { .. }
            | EventKind::StopRequested
            | EventKind::Polled(Ok(None))
            | EventKind::Interrupted
            | EventKind::Started
            | EventKind::Released
            | EventKind::Lost(_) => none,
            EventKind::Requested(request) => Facts { request: Some(request), ..none },
            EventKind::Injected(outcome)
            | EventKind::Polled(Ok(Some(outcome)))
            | EventKind::Finished(outcome) => Facts { outcome: Some(outcome), ..none },
            EventKind::Missed(miss) => Facts { miss: Some(miss), ..none },
            EventKind::Event(at) | EventKind::AlreadyThere(at) => {
                let (outcome, element) = (Some(&at.event), Some(&at.element));
                Facts { outcome, element, on: at.on, ..none }
            }
            EventKind::Committed { entry, old, new, unit, .. } => {
                Facts { entry, old: Some(old), value: Some(new), unit, ..none }
            }
            EventKind::Input { port, value, unit } => {
                Facts { port, value: Some(value), unit, ..none }
            }
            EventKind::Diverted { event, supervisor } => {
                Facts { outcome: Some(event), supervisor: Some(supervisor), ..none }
            }
            EventKind::Resumed { supervisor } => Facts { supervisor: Some(supervisor), ..none },
            EventKind::Suspended { supervisor, started } => {
                Facts { supervisor: Some(supervisor), started: Some(*started), ..none }
            }
            EventKind::Returned { away } => Facts { away: Some(*away), ..none },
            EventKind::Abandoned { started } | EventKind::Held { started } => {
                Facts { started: Some(*started), ..none }
            }
            EventKind::Polled(Err(fault)) | EventKind::Faulted(fault) => {
                Facts { fault: Some(fault), ..none }
            }
            EventKind::Ended { ending, fault } => {
                Facts { ending: Some(*ending), fault: Some(fault), ..none }
            }
        }
    }
}

impl EventKind {
    /// The kind as a word, for JSON and Python.
    pub fn word(&self) -> &'static str {
        match self {
            EventKind::Unknown => "unknown",
            EventKind::ClockWentBack { .. } => "clock_went_back",
            EventKind::StopRequested => "stop_requested",
            EventKind::Requested(_) => "requested",
            EventKind::Injected(_) => "injected",
            EventKind::Polled(_) => "polled",
            EventKind::Missed(_) => "missed",
            EventKind::Event(_) => "event",
            EventKind::AlreadyThere(_) => "already_there",
            EventKind::Interrupted => "interrupted",
            EventKind::Finished(_) => "finished",
            EventKind::Committed { .. } => "committed",
            EventKind::Input { .. } => "input",
            EventKind::Started => "started",
            EventKind::Diverted { .. } => "diverted",
            EventKind::Resumed { .. } => "resumed",
            EventKind::Suspended { .. } => "suspended",
            EventKind::Returned { .. } => "returned",
            EventKind::Abandoned { .. } => "abandoned",
            EventKind::Held { .. } => "held",
            EventKind::Released => "released",
            EventKind::Faulted(_) => "faulted",
            EventKind::Ended { .. } => "ended",
            EventKind::Lost(_) => "lost",
        }
    }
}
