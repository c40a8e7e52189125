//! Gates, which control time, and observers, which receive the events of a run.

use afp_core::devices::SignalId;
use afp_core::trace::{ComponentId, Ending, Names, Record};
use afp_core::{Duration, EntryId, Instant, Value, ValueRef};

use crate::event::{Done, Requested, RunEvent};
use crate::request::{RequestError, RequestId};
use crate::sample::SampleRef;
use crate::stimulus::Stimulus;

/// Whether a run continues.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Go {
    /// The run continues.
    On,
    /// The gate must be asked again, because the next event may have changed.
    Again,
    /// The run must stop.
    Stop,
}

/// The kind of event of a call of [`Session::next_step`](crate::Session::next_step).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Next {
    /// An event before the plan's next step: a sample, a request.
    BeforeStep,
    /// The plan's next step; the plan has not ended.
    Step,
    /// The plan has ended.
    Ended,
}

/// Decides whether time may pass: it can limit a run to real time, pause it or stop it.
///
/// ```
/// use afp_core::Instant;
/// use afp_session::{Gate, Go};
///
/// /// Stops the run after a number of calls.
/// struct AtMost(u32);
///
/// impl Gate for AtMost {
///     fn pass(&mut self, _: Instant, _: Instant) -> Go {
///         match self.0.checked_sub(1) {
///             Some(left) => self.0 = left,
///             None => return Go::Stop,
///         }
///         Go::On
///     }
/// }
/// # let mut gate = AtMost(1);
/// # assert_eq!(gate.pass(Instant::MAX, Instant::ZERO), Go::On);
/// # assert_eq!(gate.pass(Instant::MAX, Instant::ZERO), Go::Stop);
/// ```
pub trait Gate {
    /// Called before time passes from `now` to `target`.
    fn pass(&mut self, target: Instant, now: Instant) -> Go {
        let _ = (target, now);
        Go::On
    }
}

/// The gate that is always open.
#[derive(Clone, Copy, Debug, Default)]
pub struct Open;

impl Gate for Open {}

impl<F: FnMut(Instant, Instant) -> Go> Gate for F {
    fn pass(&mut self, target: Instant, now: Instant) -> Go {
        self(target, now)
    }
}

/// The sample times of an observer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sampling {
    /// No samples.
    Never,
    /// At each multiple of the period, before other events of that instant.
    Every(Duration),
    /// After each step, and at each multiple of the period.
    Following(Duration),
}

impl Sampling {
    pub(crate) fn follows(self) -> bool {
        matches!(self, Sampling::Following(_))
    }

    pub(crate) fn grid(self) -> Option<Duration> {
        match self {
            Sampling::Never => None,
            Sampling::Every(grid) | Sampling::Following(grid) => Some(grid),
        }
    }
}

/// A record with the names for its ids.
#[derive(Clone, Copy)]
pub struct NamedRecord<'a> {
    /// The time of the step.
    pub at: Instant,
    /// The record.
    pub record: &'a Record<'a>,
    /// The names.
    pub names: &'a dyn Names,
    /// The record as a line of the trace, made once for all observers; empty for a poll that found
    /// no event.
    pub line: &'a str,
}

impl NamedRecord<'_> {
    /// The line without its time.
    pub fn text(&self) -> &str {
        self.line.split_once(' ').map_or("", |(_, text)| text)
    }
}

/// A request whose time has come.
#[derive(Clone, Copy, Debug)]
pub struct Applied<'a> {
    /// The present time.
    pub now: Instant,
    /// The time that it was made for.
    pub at: Instant,
    /// Its number.
    pub id: RequestId,
    /// The request.
    pub what: &'a Stimulus,
    /// The reason if it failed.
    pub refused: Option<&'a RequestError>,
}

impl Applied<'_> {
    /// The event of the run for this request.
    pub fn event(&self) -> RunEvent {
        let done = self.refused.map_or(Done::Done, |why| Done::Refused(why.to_string()));
        RunEvent::requested(self.now, Requested { at: self.at, what: self.what.clone(), done })
    }
}

/// Receives the events of a run. It cannot change the session.
///
/// ```
/// use afp_core::{Instant, StartError};
/// use afp_session::{AnySession, NamedRecord, Observer, Open};
///
/// /// Keeps the lines of the trace.
/// #[derive(Default)]
/// struct Lines(Vec<String>);
///
/// impl Observer for Lines {
///     fn on_record(&mut self, record: &NamedRecord<'_>) {
///         self.0.push(record.line.to_owned());
///     }
/// }
///
/// fn trace(session: &mut dyn AnySession) -> Result<Vec<String>, StartError> {
///     let mut lines = Lines::default();
///     session.run(Instant::MAX, &mut Open, &mut [&mut lines])?;
///     Ok(lines.0)
/// }
/// ```
pub trait Observer {
    /// A record of the step that ended.
    fn on_record(&mut self, record: &NamedRecord<'_>) {
        let _ = record;
    }

    /// Whether it receives polls that found no event.
    fn wants_clear_polls(&self) -> bool {
        false
    }

    /// Whether it makes the lines and the hash of the trace instead of the session; then lines are
    /// empty.
    fn makes_trace(&self) -> bool {
        false
    }

    /// `count` records and samples were lost. `entries` are the values of all entries now, by
    /// number.
    fn on_loss(&mut self, at: Instant, count: u64, entries: &[Value]) {
        let _ = (at, count, entries);
    }

    /// All records of a step have been reported.
    fn after_step(&mut self, view: &View<'_>) {
        let _ = view;
    }

    /// Its sample times.
    fn sampling(&self) -> Sampling {
        Sampling::Never
    }

    /// Whether it wants a signal at an instant.
    fn wants(&self, at: Instant, signal: SignalId) -> bool {
        let _ = (at, signal);
        true
    }

    /// A sample of a signal that it wants.
    fn on_sample(&mut self, at: Instant, signal: SignalId, value: SampleRef<'_>) {
        let _ = (at, signal, value);
    }

    /// All samples of an instant have been given.
    fn after_samples(&mut self, at: Instant) {
        let _ = at;
    }

    /// A request was done, or failed.
    fn on_request(&mut self, applied: &Applied<'_>) {
        let _ = applied;
    }
}

/// A session between two steps.
#[derive(Clone, Copy)]
pub struct View<'a> {
    pub(crate) now: Instant,
    pub(crate) inside: &'a dyn Inside,
}

/// The content of a view.
pub(crate) trait Inside {
    fn entry(&self, id: EntryId) -> ValueRef<'_>;
    fn active(&self) -> Option<ComponentId>;
    fn ending(&self) -> Option<Ending>;
    fn names(&self) -> &dyn Names;
    fn read(&self, at: Instant, signal: SignalId, to: &mut dyn FnMut(SampleRef<'_>));
}

impl View<'_> {
    /// The time of the step.
    pub fn now(&self) -> Instant {
        self.now
    }

    /// The value of an entry of the plan itself.
    pub fn entry(&self, id: EntryId) -> ValueRef<'_> {
        self.inside.entry(id)
    }

    /// The active element of the outermost plan.
    pub fn active(&self) -> Option<ComponentId> {
        self.inside.active()
    }

    /// The ending of the plan, if it has ended.
    pub fn ending(&self) -> Option<Ending> {
        self.inside.ending()
    }

    /// The names of the plan.
    pub fn names(&self) -> &dyn Names {
        self.inside.names()
    }

    /// Reads a signal.
    pub fn read(&self, signal: SignalId, to: &mut dyn FnMut(SampleRef<'_>)) {
        self.inside.read(self.now, signal, to);
    }
}
