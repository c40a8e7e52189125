//! The trace of a running plan.
//!
//! A step passes each record to a [`Sink`]. Records hold ids; [`Names`] resolves them to dotted
//! paths. With [`NoTrace`] the compiler removes all tracing.

mod display;
mod hash;
mod names;
mod record;

use afp_types::Instant;

use crate::fault::Fault;

pub use afp_types::{ComponentKind, EntryKind};
pub use display::Line;
pub use hash::TraceHash;
pub use names::{
    ComponentId, ComponentName, EntryName, Names, Outcome, PortName, Reaction, TextPlace,
    TraceEntryId, declared,
};
pub use record::{Record, RecordOf};

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

/// The author of a commit or a stop.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Author {
    /// A component that ended the active element.
    Component(ComponentId),
    /// The program that runs the plan.
    Outside,
}

/// Result of a supervisor's poll.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// No event.
    Clear,
    /// An event.
    Event(Outcome),
    /// A fault.
    Fault(Fault),
}

/// Why a deadline was missed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cause {
    /// The poll began too late.
    LateRelease,
    /// The poll took too long.
    LongPoll,
}

/// Receives records. It is called within a step, so it must not block, nor allocate if the step
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
    /// Whether records are wanted; `false` removes the code that makes them.
    const ENABLED: bool = true;

    /// Takes one record; `at` is the time of the step.
    fn record(&mut self, at: Instant, record: &Record<'_>);

    /// Called before each call of a component, so that another thread can name it if the call never
    /// returns.
    #[inline]
    fn calls(&mut self, component: ComponentId) {
        let _ = component;
    }
}

/// Discards all records, at no cost.
#[derive(Clone, Copy, Debug, Default)]
pub struct NoTrace;

impl Sink for NoTrace {
    const ENABLED: bool = false;

    fn record(&mut self, _: Instant, _: &Record<'_>) {}
}

/// Passes each record to a function.
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
    /// The function of the step's time and the record.
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

    #[inline]
    fn calls(&mut self, component: ComponentId) {
        (**self).calls(component);
    }
}

/// Passes each record to both sinks.
impl<A: Sink, B: Sink> Sink for (A, B) {
    const ENABLED: bool = A::ENABLED || B::ENABLED;

    fn record(&mut self, at: Instant, record: &Record<'_>) {
        self.0.record(at, record);
        self.1.record(at, record);
    }

    #[inline]
    fn calls(&mut self, component: ComponentId) {
        self.0.calls(component);
        self.1.calls(component);
    }
}
