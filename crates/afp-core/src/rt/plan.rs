//! The scheduler's context for a plan's calls, and the plan's results.

use core::num::NonZeroU32;

use afp_types::{Instant, ValueRef};

use crate::fault::{BadValue, Detail, Failure, Fault, Port, Subject};
use crate::rt::ports::Ports;
use crate::rt::run::Run;
use crate::rt::store::{Entry, Stored};
use crate::rt::table::{Child, Target};
use crate::trace::{Author, ComponentId, Ending, Outcome, Record, Sink, TraceEntryId};

/// State of a level after its start or step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Flow {
    /// An element is active; the next work is due at this instant.
    Running(Instant),
    /// The outermost plan is held; the next work is due at this instant.
    Held(Instant),
    Ended(Ending),
    /// The whole run must end: livelock or a failed interrupt.
    Fatal(Fault),
}

/// Due time of a supervisor.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Slot {
    pub(crate) next: Instant,
}

/// Result of a supervisor's poll. A fault together with an event is the fault of an output.
#[derive(Clone, Copy, Debug)]
pub struct Fired {
    /// The event's number plus one, so that the result is two words in registers.
    pub(crate) event: Option<NonZeroU32>,
    pub(crate) fault: Option<Fault>,
}

/// Result of starting an element.
#[derive(Clone, Copy, Debug)]
pub enum Started {
    Running,
    /// The result of the sub-plan's start.
    SubPlan(Flow),
    /// State of a computation, or of a sub-plan that ended at once; outputs staged.
    Done(u16),
    Failed(Fault),
}

/// Result of suspending an element.
#[derive(Clone, Copy, Debug)]
pub enum Kept {
    Yes,
    /// The element cannot be suspended and must be interrupted.
    No,
    /// An interrupt inside failed: the whole run must end.
    Broken(Fault),
}

/// Result of polling an element.
#[derive(Clone, Copy, Debug)]
pub enum Polled {
    Pending,
    /// The result of the sub-plan's step.
    SubPlan(Flow),
    /// The state, outputs staged.
    Done(u16),
    /// A state injected by a test, outputs staged. The element still acts and must be interrupted.
    Forced(u16),
    /// The element failed and must be interrupted.
    Failed(Fault),
    /// The sub-plan ended in `Error`, or its results do not fit; nothing runs in it.
    EndedInError(Fault),
}

/// Context of a step, through all levels of a plan.
pub struct Cx<'a, R: Run> {
    pub env: &'a mut R::Env,
    /// The time of the step.
    pub now: Instant,
    pub(crate) sink: &'a mut R::Sink,
    pub(crate) clock: &'a R::Clock,
    pub(crate) step: &'a mut StepState,
    pub(crate) place: Place,
}

/// Counters that all levels share.
#[derive(Clone, Debug, Default)]
pub(crate) struct StepState {
    /// Edges that the step may still take.
    pub edges_left: u32,
    /// The latest reading of the clock.
    pub clock: Instant,
    /// Commits of the run.
    pub commits: u32,
    /// Missed deadlines of the run, with skipped releases.
    pub misses: u64,
    /// The innermost component called last; it owns a panic.
    pub called: ComponentId,
    /// The innermost component that failed last.
    pub failure: Option<Failure>,
    /// The invalid value behind the fault of the component called last.
    pub noted: Option<(Detail, Fault)>,
    /// A plan has just ended in `Error`; the outer plan fails for the same reason.
    pub passed_on: bool,
    /// Whether the outermost plan holds before its next element.
    pub stops: Stops,
    /// The hold of the outermost plan.
    pub hold: Option<Hold>,
}

/// Whether the outermost plan holds before it enters an element.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Stops {
    #[default]
    Never,
    /// Before the next element.
    Next,
    /// Before the element after the next.
    AfterNext,
}

/// A hold of the outermost plan.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Hold {
    pub since: Instant,
    /// The next call of [`Environment::hold`](crate::Environment::hold).
    pub next: Instant,
    /// The edge to follow on release, if no element was suspended, and its ending.
    pub pending: Option<(Target, Ending)>,
}

/// First ids of a level.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place {
    pub plan: ComponentId,
    pub components: u32,
    pub entries: u32,
    /// The component that is being started.
    pub component: ComponentId,
}

impl Place {
    pub const OUTERMOST: Place =
        Place { plan: ComponentId(0), components: 1, entries: 0, component: ComponentId(0) };
}

impl Fired {
    pub const NOTHING: Fired = Fired { event: None, fault: None };

    /// An event, by position in the template, and the result of staging its outputs.
    #[inline]
    pub fn event(event: u16, staged: Result<(), Fault>) -> Self {
        let event = NonZeroU32::MIN.saturating_add(u32::from(event));
        Fired { event: Some(event), fault: staged.err() }
    }

    /// Counts the poll as ended after its deadline; for tests.
    pub fn missed() -> Self {
        Fired::event(Outcome::DeadlineMissed.number(), Ok(()))
    }

    #[inline]
    pub(crate) fn outcome(&self) -> Option<Outcome> {
        // The number has 16 bits.
        self.event.map(|event| Outcome::from_number(event.get().saturating_sub(1) as u16))
    }

    #[inline]
    pub fn fault(fault: Fault) -> Self {
        Fired { event: None, fault: Some(fault) }
    }
}

impl<R: Run> Cx<'_, R> {
    /// Traces and checks the inputs of the component that is being started.
    ///
    /// # Errors
    /// A value that is not finite or out of range.
    pub fn read<I: Ports>(&mut self, inputs: Result<I, BadValue>) -> Result<I, Fault> {
        let inputs = self.noted(inputs)?;
        if R::Sink::ENABLED {
            let (component, at) = (self.place.component, self.now);
            let sink = &mut *self.sink;
            inputs.each(&mut |port, value| {
                sink.record(at, &Record::Input { component, port, value });
            });
        }
        self.checked(Ok(inputs))
    }

    /// Checks live inputs.
    ///
    /// # Errors
    /// A value that is not finite or out of range.
    #[inline]
    pub(crate) fn checked<I: Ports>(&mut self, inputs: Result<I, BadValue>) -> Result<I, Fault> {
        let checked = inputs.and_then(|inputs| inputs.check().map(|()| inputs));
        self.noted(checked)
    }

    /// For plans with boxed components: lends the platform, and the function that traces inputs, if
    /// there is a trace.
    pub fn show_inputs<T>(
        &mut self,
        run: impl FnOnce(Option<&mut dyn FnMut(u16, ValueRef<'_>)>, &mut R::Env, Instant) -> T,
    ) -> T {
        let (component, at) = (self.place.component, self.now);
        let sink = &mut *self.sink;
        let mut see = |port: u16, value: ValueRef<'_>| {
            sink.record(at, &Record::Input { component, port, value });
        };
        run(if R::Sink::ENABLED { Some(&mut see) } else { None }, &mut *self.env, at)
    }

    /// Traces an outcome that a test injects. `part` counts the plan's elements, then its
    /// supervisors.
    pub fn show_injected(&mut self, part: u32, outcome: Outcome) {
        let component = ComponentId(self.place.components.saturating_add(part));
        self.trace(&Record::Injected { component, outcome });
    }

    /// Runs a sub-plan's start, step or interruption with its own first ids.
    #[inline]
    pub fn inside<T>(&mut self, child: Child, run: impl FnOnce(&mut Cx<'_, R>) -> T) -> T {
        run(&mut Cx {
            env: &mut *self.env,
            now: self.now,
            sink: &mut *self.sink,
            clock: self.clock,
            step: &mut *self.step,
            place: Place {
                plan: self.place.component,
                components: self.place.components.saturating_add(child.components),
                entries: self.place.entries.saturating_add(child.entries),
                component: self.place.component,
            },
        })
    }
}

impl<R: Run> Cx<'_, R> {
    /// Converts the error of a value of the called component to a fault, and stores its detail.
    ///
    /// # Errors
    /// Only the fault.
    #[inline]
    pub fn noted<T>(&mut self, value: Result<T, BadValue>) -> Result<T, Fault> {
        value.map_err(|why| self.note(why))
    }

    /// Stores the detail of a fault.
    #[cold]
    pub fn note(&mut self, why: BadValue) -> Fault {
        let subject = why.port.map(|port| match port {
            Port::Input(port) => Subject::Input(port),
            Port::Output(port) => Subject::Output(port),
            Port::State(state) => Subject::State(state),
            Port::Entry(entry) => {
                Subject::Entry(TraceEntryId(self.place.entries.saturating_add(entry.into())))
            }
        });
        let (component, value) = (self.step.called, why.value);
        self.step.noted = subject.map(|subject| (Detail { component, subject, value }, why.fault));
        why.fault
    }

    /// As [`Cx::noted`], for the inputs and results of a sub-plan: inner components may have been
    /// called meanwhile.
    ///
    /// # Errors
    /// Only the fault.
    pub fn noted_outside<T>(&mut self, value: Result<T, BadValue>) -> Result<T, Fault> {
        value.map_err(|why| {
            self.step.called = self.place.component;
            self.note(why)
        })
    }

    /// Stores the failed component, unless a sub-plan passes an inner fault on. Returns the detail.
    pub(crate) fn note_failure(&mut self, component: ComponentId, fault: Fault) -> Option<Detail> {
        let noted = self.step.noted.take();
        if !core::mem::take(&mut self.step.passed_on) {
            let detail = noted.filter(|(detail, of)| (detail.component, *of) == (component, fault));
            let detail = detail.map(|(detail, _)| detail);
            self.step.failure = Some(Failure { component, fault, detail });
        }
        self.step.failure?.detail
    }

    /// Calls a component and records its id, so that a panic can be attributed.
    ///
    /// A drop guard could also record the id and clear it after the call, but every poll would pay
    /// for it. Apart from components only a sink or a clock can panic in a step; the scheduler
    /// detects these itself.
    #[inline(always)]
    pub(crate) fn call<T>(
        &mut self,
        component: ComponentId,
        run: impl FnOnce(&mut Self) -> T,
    ) -> T {
        self.calls(component);
        run(self)
    }

    /// Records the component that is called next.
    #[inline(always)]
    pub(crate) fn calls(&mut self, component: ComponentId) {
        self.step.called = component;
        self.sink.calls(component);
    }
}

impl<R: Run> Cx<'_, R> {
    #[inline]
    pub(crate) fn trace(&mut self, record: &Record<'_>) {
        if R::Sink::ENABLED {
            self.sink.record(self.now, record);
        }
    }

    /// Stores and traces the failure of a component.
    #[cold]
    pub(crate) fn failed(&mut self, component: ComponentId, fault: Fault) {
        let detail = self.note_failure(component, fault);
        self.trace(&Record::Faulted { component, fault, detail });
    }
}

pub struct Committer<'a, S> {
    pub(crate) sink: &'a mut S,
    pub(crate) at: Instant,
    pub(crate) author: Author,
    pub(crate) entries: u32,
    pub(crate) number: u32,
}

impl<S: Sink> Committer<'_, S> {
    /// Writes one entry of the plan.
    #[inline]
    pub fn write<T: Stored>(&mut self, entry: u16, to: &mut Entry<T>, mut value: T) {
        value.committed(self.number);
        if S::ENABLED {
            self.record(entry, to.as_value(), value.as_value());
        }
        to.set(value);
    }

    /// Writes one entry of the plan if its value differs; returns whether it does.
    pub fn update<T: Stored>(&mut self, entry: u16, to: &mut Entry<T>, value: T) -> bool {
        let changed = !to.get().is_still(&value);
        if changed {
            self.write(entry, to, value);
        }
        changed
    }

    fn record(&mut self, entry: u16, old: ValueRef<'_>, new: ValueRef<'_>) {
        let entry = TraceEntryId(self.entries.saturating_add(u32::from(entry)));
        let record = Record::Committed { author: self.author, entry, old, new };
        self.sink.record(self.at, &record);
    }

    /// For plans that store their entries themselves: traces one entry of the commit.
    pub fn wrote(&mut self, entry: u16, old: ValueRef<'_>, new: ValueRef<'_>) {
        if S::ENABLED {
            self.record(entry, old, new);
        }
    }

    /// The number of this commit, which identifies objects.
    pub fn number(&self) -> u32 {
        self.number
    }
}
