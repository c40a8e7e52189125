//! What a plan tells about itself while it runs.
//!
//! A step hands each record to a [`Sink`]. Records speak in ids; [`Names`] turns them into the
//! paths that people know. With [`NoTrace`] the compiler removes all of it.

mod display;
mod hash;
mod names;

use afp_types::{Duration, Instant, ValueRef};

use crate::fault::{Detail, Fault};

pub use afp_types::{ComponentKind, EntryKind};
pub use display::Line;
pub use hash::TraceHash;
pub use names::{
    ComponentId, ComponentName, EntryName, Names, Outcome, PortName, Reaction, TextPlace,
    TraceEntryId, declared,
};

/// How a plan ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ending {
    /// By a state or a computation.
    Ok,
    /// By an event, a missed deadline or a stop request.
    Interrupted,
    /// By a fault.
    Error(Fault),
}

/// Who wrote or stopped.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Author {
    /// A component that ended the activity.
    Component(ComponentId),
    /// Whoever runs the plan.
    Outside,
}

/// What a supervisor's poll said.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// Nothing.
    Clear,
    /// This event.
    Event(Outcome),
    /// It failed.
    Fault(Fault),
}

/// Why a deadline was missed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cause {
    /// The poll began too late to keep it.
    LateRelease,
    /// The poll took too long.
    LongPoll,
}

/// One thing that happened. The order within a step is fixed: outside commit; for each polled
/// supervisor its poll and its miss, and where its event may resume, event, commits and computations
/// until resumed; event; interrupts, innermost first; commits, inner first; starts of supervisors;
/// diverted or started.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Record<'a> {
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
        old: ValueRef<'a>,
        /// Its value now.
        new: ValueRef<'a>,
    },
    /// An input that a component is about to start with.
    Input {
        /// The component.
        component: ComponentId,
        /// The port, by position among the template's input ports.
        port: u16,
        /// What it reads.
        value: ValueRef<'a>,
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

/// Receives records. Called within a step: it must neither block nor allocate where the step
/// must not.
///
/// ```
/// use afp_core::Instant;
/// use afp_core::trace::{Record, Sink};
///
/// /// Counts the faults of components.
/// struct Faults(u32);
///
/// impl Sink for Faults {
///     fn record(&mut self, _: Instant, record: &Record<'_>) {
///         self.0 += u32::from(matches!(record, Record::Faulted { .. }));
///     }
/// }
/// # let mut faults = Faults(0);
/// # faults.record(Instant::ZERO, &Record::StopRequested);
/// # assert_eq!(faults.0, 0);
/// ```
pub trait Sink {
    /// Whether records are wanted at all; `false` removes the code that makes them.
    const ENABLED: bool = true;

    /// Takes one record; `at` is the time of the step.
    fn record(&mut self, at: Instant, record: &Record<'_>);
}

/// No trace, no cost.
#[derive(Clone, Copy, Debug, Default)]
pub struct NoTrace;

impl Sink for NoTrace {
    const ENABLED: bool = false;

    fn record(&mut self, _: Instant, _: &Record<'_>) {}
}

/// Hands each record to a function.
///
/// ```
/// use afp_core::Instant;
/// use afp_core::trace::{Observe, Record};
/// let mut starts = 0;
/// let sink = Observe(|_: Instant, record: &Record<'_>| {
///     starts += u32::from(matches!(record, Record::Started { .. }));
/// });
/// # let _ = sink;
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Observe<F>(
    /// The function: time of the step, record.
    pub F,
);

impl<F: FnMut(Instant, &Record<'_>)> Sink for Observe<F> {
    fn record(&mut self, at: Instant, record: &Record<'_>) {
        (self.0)(at, record);
    }
}

impl<S: Sink + ?Sized> Sink for &mut S {
    const ENABLED: bool = S::ENABLED;

    fn record(&mut self, at: Instant, record: &Record<'_>) {
        (**self).record(at, record);
    }
}

/// Each record goes to both.
impl<A: Sink, B: Sink> Sink for (A, B) {
    const ENABLED: bool = A::ENABLED || B::ENABLED;

    fn record(&mut self, at: Instant, record: &Record<'_>) {
        self.0.record(at, record);
        self.1.record(at, record);
    }
}
