//! What a trace consists of.

use afp_types::{Duration, Instant, ValueRef};

use super::{Author, Cause, ComponentId, Ending, Outcome, TraceEntryId, Verdict};
use crate::fault::{Detail, Fault};

/// One thing that happened. The order within a step is fixed: outside commit; for each polled
/// supervisor its poll and its miss, and where its event may resume, event, commits and computations
/// until resumed; event; interrupts, innermost first; commits, inner first; starts of supervisors;
/// diverted or started. Values are held as `V`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RecordOf<V> {
    /// A step was asked for an earlier time than the one before; it ran at the time of that one.
    ClockWentBack {
        /// The time asked for.
        asked: Instant,
    },
    /// Somebody asked the plan to stop.
    StopRequested,
    /// A component is about to report an outcome that is not its own: whoever tests the plan put it
    /// there.
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
        /// What it said.
        verdict: Verdict,
    },
    /// A supervisor's poll ended after its deadline, or releases passed without a poll.
    Missed {
        /// The supervisor.
        supervisor: ComponentId,
        /// Time after the deadline; zero when only earlier releases were skipped.
        lateness: Duration,
        /// Why.
        cause: Cause,
        /// Releases that passed entirely.
        skipped: u64,
    },
    /// An event was taken.
    Event {
        /// The supervisor.
        supervisor: ComponentId,
        /// The event.
        event: Outcome,
        /// The element of the same plan that is active or being entered, which decides where the event leads.
        element: ComponentId,
    },
    /// An event was not taken, because it leads to the element that is already active or being
    /// entered.
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
        /// Who wrote it.
        author: Author,
        /// The entry.
        entry: TraceEntryId,
        /// Its value before.
        old: V,
        /// Its value now.
        new: V,
    },
    /// An input that a component is about to start with.
    Input {
        /// The component.
        component: ComponentId,
        /// The port, by position among the template's input ports.
        port: u16,
        /// What it reads.
        value: V,
    },
    /// A component started.
    Started {
        /// The component.
        component: ComponentId,
    },
    /// An event taken in the look replaced the start of an element.
    Diverted {
        /// The element that did not start.
        element: ComponentId,
        /// The supervisor that saw a reason.
        supervisor: ComponentId,
        /// The event.
        event: Outcome,
    },
    /// An element goes on after an event that led to `resume`.
    Resumed {
        /// The element, active or being entered.
        element: ComponentId,
        /// The supervisor whose event it was.
        supervisor: ComponentId,
    },
    /// A component failed.
    Faulted {
        /// The component.
        component: ComponentId,
        /// Why.
        fault: Fault,
        /// The value that it is about, where it is about one.
        detail: Option<Detail>,
    },
    /// A plan ended; a sub-plan goes by the id of its element.
    Ended {
        /// The plan.
        plan: ComponentId,
        /// How.
        ending: Ending,
    },
}

/// A record that borrows its texts.
pub type Record<'a> = RecordOf<ValueRef<'a>>;

impl<V> RecordOf<V> {
    /// The same record, its values held in another way.
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
            RecordOf::Faulted { component, fault, detail } => {
                RecordOf::Faulted { component, fault, detail }
            }
            RecordOf::Ended { plan, ending } => RecordOf::Ended { plan, ending },
        }
    }
}
