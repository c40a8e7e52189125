//! Records of a trace.

use afp_types::{Duration, Instant, ValueRef};

use super::{Author, Cause, ComponentId, Ending, Outcome, TraceEntryId, Verdict};
use crate::fault::{Detail, Fault};

/// One record; values are held as `V`. The order within a step is fixed:
///
/// 1. outside commit
/// 2. for each polled supervisor its poll, its miss and, if its event may resume, event, commits
///    and computations until resumed
/// 3. event
/// 4. interrupts, innermost first
/// 5. commits, inner first
/// 6. suspended or abandoned
/// 7. starts and returns of supervisors
/// 8. diverted, started or returned
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RecordOf<V> {
    /// A step was requested for an earlier time than the last step; it ran at the last step's time.
    ClockWentBack {
        /// The requested time.
        asked: Instant,
    },
    /// A stop was requested.
    StopRequested,
    /// A component is about to report an outcome that a test injected.
    Injected {
        /// The supervisor or actor.
        component: ComponentId,
        /// The event or state.
        outcome: Outcome,
    },
    /// A supervisor was polled.
    Polled {
        /// The supervisor.
        supervisor: ComponentId,
        /// The result.
        verdict: Verdict,
    },
    /// A supervisor's poll ended after its deadline, or releases passed without a poll.
    Missed {
        /// The supervisor.
        supervisor: ComponentId,
        /// Time after the deadline; zero if only earlier releases were skipped.
        lateness: Duration,
        /// The cause.
        cause: Cause,
        /// Number of releases without a poll.
        skipped: u64,
    },
    /// An event was taken.
    Event {
        /// The supervisor.
        supervisor: ComponentId,
        /// The event.
        event: Outcome,
        /// The active or entered element of the same plan, which determines the target.
        element: ComponentId,
    },
    /// An event was not taken, because its target is already active or being entered.
    AlreadyThere {
        /// The supervisor.
        supervisor: ComponentId,
        /// The event.
        event: Outcome,
        /// That element.
        element: ComponentId,
    },
    /// An actor or sub-plan was interrupted.
    Interrupted {
        /// The element.
        element: ComponentId,
    },
    /// An element reached a state; for a sub-plan 0 is `OK` and 1 `Interrupted`.
    Finished {
        /// The element.
        element: ComponentId,
        /// The state.
        state: Outcome,
    },
    /// An entry changed; all entries of one commit follow one another.
    Committed {
        /// The author.
        author: Author,
        /// The entry.
        entry: TraceEntryId,
        /// Its value before.
        old: V,
        /// Its value now.
        new: V,
    },
    /// An input of a component that is about to start.
    Input {
        /// The component.
        component: ComponentId,
        /// The port, by position among the template's input ports.
        port: u16,
        /// The value.
        value: V,
    },
    /// A component started.
    Started {
        /// The component.
        component: ComponentId,
    },
    /// An event in the look prevented the start of an element.
    Diverted {
        /// The element that did not start.
        element: ComponentId,
        /// The supervisor with the event.
        supervisor: ComponentId,
        /// The event.
        event: Outcome,
    },
    /// An element continues after an event that led to `resume`.
    Resumed {
        /// The element, active or being entered.
        element: ComponentId,
        /// The supervisor with the event.
        supervisor: ComponentId,
    },
    /// An element was set aside for a handler.
    Suspended {
        /// The element.
        element: ComponentId,
        /// The supervisor with the event.
        supervisor: ComponentId,
        /// Whether the element had started.
        started: bool,
    },
    /// A component that was suspended continues.
    Returned {
        /// The actor, sub-plan or supervisor.
        component: ComponentId,
        /// The time since its suspension.
        away: Duration,
    },
    /// An element that was set aside was given up, and interrupted if it had started.
    Abandoned {
        /// The element.
        element: ComponentId,
        /// Whether it had started.
        started: bool,
    },
    /// A debugger holds the plan.
    Held {
        /// The element that is suspended or, if `started` is false, starts on release.
        element: ComponentId,
        /// Whether the element has started and continues on release.
        started: bool,
    },
    /// A held plan continues.
    Released {
        /// The element of the hold.
        element: ComponentId,
    },
    /// A component failed.
    Faulted {
        /// The component.
        component: ComponentId,
        /// The fault.
        fault: Fault,
        /// The value that caused the fault, if any.
        detail: Option<Detail>,
    },
    /// A plan ended; a sub-plan has the id of its element.
    Ended {
        /// The plan.
        plan: ComponentId,
        /// The ending.
        ending: Ending,
    },
}

/// A record with borrowed strings.
pub type Record<'a> = RecordOf<ValueRef<'a>>;

impl<V> RecordOf<V> {
    /// Converts the values.
    pub fn map<'r, W>(&'r self, mut held: impl FnMut(&'r V) -> W) -> RecordOf<W> {
        match *self {
            RecordOf::ClockWentBack { asked } => RecordOf::ClockWentBack { asked },
            RecordOf::StopRequested => RecordOf::StopRequested,
            RecordOf::Injected { component, outcome } => RecordOf::Injected { component, outcome },
            RecordOf::Polled { supervisor, verdict } => RecordOf::Polled { supervisor, verdict },
            RecordOf::Missed { supervisor, lateness, cause, skipped } => {
                RecordOf::Missed { supervisor, lateness, cause, skipped }
            }
            RecordOf::Event { supervisor, event, element } => {
                RecordOf::Event { supervisor, event, element }
            }
            RecordOf::AlreadyThere { supervisor, event, element } => {
                RecordOf::AlreadyThere { supervisor, event, element }
            }
            RecordOf::Interrupted { element } => RecordOf::Interrupted { element },
            RecordOf::Finished { element, state } => RecordOf::Finished { element, state },
            RecordOf::Committed { author, entry, ref old, ref new } => {
                RecordOf::Committed { author, entry, old: held(old), new: held(new) }
            }
            RecordOf::Input { component, port, ref value } => {
                RecordOf::Input { component, port, value: held(value) }
            }
            RecordOf::Started { component } => RecordOf::Started { component },
            RecordOf::Diverted { element, supervisor, event } => {
                RecordOf::Diverted { element, supervisor, event }
            }
            RecordOf::Resumed { element, supervisor } => RecordOf::Resumed { element, supervisor },
            RecordOf::Suspended { element, supervisor, started } => {
                RecordOf::Suspended { element, supervisor, started }
            }
            RecordOf::Returned { component, away } => RecordOf::Returned { component, away },
            RecordOf::Abandoned { element, started } => RecordOf::Abandoned { element, started },
            RecordOf::Held { element, started } => RecordOf::Held { element, started },
            RecordOf::Released { element } => RecordOf::Released { element },
            RecordOf::Faulted { component, fault, detail } => {
                RecordOf::Faulted { component, fault, detail }
            }
            RecordOf::Ended { plan, ending } => RecordOf::Ended { plan, ending },
        }
    }
}
