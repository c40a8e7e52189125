//! Records as lines of text, for reading and comparing traces.

use core::fmt;

use afp_types::{Instant, ValueRef};

use super::{
    Author, Cause, ComponentId, ComponentKind, Ending, Names, Outcome, Record, TraceEntryId,
    Verdict,
};
use crate::fault::Fault;

/// One record as a line: time in seconds, component, record.
///
/// ```text
/// 2.431000 searchFirstWall.touch event TouchSensorPressed -> backupCollision
/// ```
pub struct Line<'a, N: ?Sized> {
    /// The time of the step.
    pub at: Instant,
    /// The record.
    pub record: &'a Record<'a>,
    /// The names of the plan.
    pub names: &'a N,
}

impl<N: Names + ?Sized> Line<'_, N> {
    fn path(&self, id: ComponentId) -> &str {
        self.names.component(id).path
    }

    fn value(
        &self,
        f: &mut fmt::Formatter<'_>,
        id: TraceEntryId,
        value: ValueRef<'_>,
    ) -> fmt::Result {
        let entry = self.names.entry(id);
        match value {
            ValueRef::Choice(choice) => {
                write!(f, "{}.{}", entry.ty, self.names.choice(id, choice))
            }
            ValueRef::Object(commit) => write!(f, "{}#{commit}", entry.ty),
            ValueRef::Float(number) if !entry.unit.is_empty() => {
                write!(f, "{number} {}", entry.unit)
            }
            other => write!(f, "{other}"),
        }
    }

    /// An outcome and its target while an element is active.
    fn outcome(
        &self,
        f: &mut fmt::Formatter<'_>,
        id: ComponentId,
        outcome: Outcome,
        element: ComponentId,
    ) -> fmt::Result {
        f.write_str(self.names.outcome(id, outcome))?;
        match self.names.target_at(id, outcome, element) {
            "" => Ok(()),
            target => write!(f, " -> {target}"),
        }
    }

    /// The target of a failed element's `Error` edge; supervisors have none.
    fn error_target(&self, f: &mut fmt::Formatter<'_>, id: ComponentId) -> fmt::Result {
        let supervisor = self.names.component(id).kind == ComponentKind::Supervisor;
        match self.names.target(id, Outcome::Error) {
            target if !supervisor && !target.is_empty() => write!(f, " -> {target}"),
            _ => Ok(()),
        }
    }

    fn polled(&self, f: &mut fmt::Formatter<'_>, id: ComponentId, verdict: Verdict) -> fmt::Result {
        write!(f, "{} polled: ", self.path(id))?;
        match verdict {
            Verdict::Clear => f.write_str("clear"),
            Verdict::Event(event) => f.write_str(self.names.outcome(id, event)),
            Verdict::Fault(fault) => write!(f, "fault {}", fault.code()),
        }
    }

    fn ended(&self, f: &mut fmt::Formatter<'_>, plan: ComponentId, ending: Ending) -> fmt::Result {
        match ending {
            Ending::Ok => write!(f, "{} ended OK", self.path(plan)),
            Ending::Interrupted => write!(f, "{} ended Interrupted", self.path(plan)),
            Ending::Error(fault) if fault.code() == Fault::FAILED => {
                write!(f, "{} ended Error({}: {fault})", self.path(plan), fault.code())
            }
            Ending::Error(fault) => write!(f, "{} ended Error({})", self.path(plan), fault.code()),
        }
    }

    fn author(&self, author: Author) -> &str {
        match author {
            Author::Component(id) => self.path(id),
            Author::Outside => "outside",
        }
    }
}

fn before(started: bool) -> &'static str {
    if started { "" } else { " before its start" }
}

impl<N: Names + ?Sized> fmt::Display for Line<'_, N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} ", self.at)?;
        match *self.record {
            Record::ClockWentBack { asked } => write!(f, "clock went back to {asked}"),
            Record::StopRequested => f.write_str("stop requested"),
            Record::Injected { component, outcome } => {
                let (path, name) = (self.path(component), self.names.outcome(component, outcome));
                write!(f, "{path} is made to report {name}")
            }
            Record::Polled { supervisor, verdict } => self.polled(f, supervisor, verdict),
            Record::Missed { supervisor, lateness, cause, skipped } => {
                let cause = match cause {
                    Cause::LateRelease => "late release",
                    Cause::LongPoll => "long poll",
                };
                let path = self.path(supervisor);
                write!(f, "{path} missed its deadline by {lateness} ({cause}, {skipped} skipped)")
            }
            Record::Event { supervisor, event, element } => {
                write!(f, "{} event ", self.path(supervisor))?;
                self.outcome(f, supervisor, event, element)
            }
            Record::AlreadyThere { supervisor, event, element } => {
                write!(f, "{} already there: ", self.path(supervisor))?;
                self.outcome(f, supervisor, event, element)
            }
            Record::Interrupted { element } => write!(f, "{} interrupted", self.path(element)),
            Record::Finished { element, state } => {
                write!(f, "{} finished ", self.path(element))?;
                self.outcome(f, element, state, element)
            }
            Record::Committed { author, entry, old, new } => {
                write!(f, "{} commits {}: ", self.author(author), self.names.entry(entry).path)?;
                self.value(f, entry, old)?;
                f.write_str(" -> ")?;
                self.value(f, entry, new)
            }
            Record::Input { component, port, value } => {
                let name = self.names.input(component, port);
                write!(f, "{} reads {name} = {value}", self.path(component))
            }
            Record::Started { component } => write!(f, "{} started", self.path(component)),
            Record::Diverted { element, supervisor, .. } => {
                write!(f, "{} diverted by {}", self.path(element), self.path(supervisor))
            }
            Record::Resumed { element, supervisor } => {
                write!(f, "{} resumed by {}", self.path(element), self.path(supervisor))
            }
            Record::Suspended { element, supervisor, started } => {
                let path = self.path(element);
                write!(f, "{path} suspended by {}{}", self.path(supervisor), before(started))
            }
            Record::Returned { component, away } => {
                write!(f, "{} returned after {away}", self.path(component))
            }
            Record::Abandoned { element, started } => {
                write!(f, "{} abandoned{}", self.path(element), before(started))
            }
            Record::Held { element, started } => {
                write!(f, "{} held{}", self.path(element), before(started))
            }
            Record::Released { element } => write!(f, "{} released", self.path(element)),
            Record::Faulted { component, fault, .. } => {
                write!(f, "{} fault {}: {fault}", self.path(component), fault.code())?;
                self.error_target(f, component)
            }
            Record::Ended { plan, ending } => self.ended(f, plan, ending),
        }
    }
}
