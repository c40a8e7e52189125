//! What a plan gets from the scheduler while it is asked, and what it answers.

use core::num::NonZeroU32;

use afp_types::{Instant, ValueRef};

use crate::fault::{BadValue, Detail, Failure, Fault, Port, Subject};
use crate::rt::ports::Ports;
use crate::rt::run::Run;
use crate::rt::store::{Entry, Stored};
use crate::rt::table::Child;
use crate::trace::{Author, ComponentId, Ending, Outcome, Record, Sink, TraceEntryId};

/// How a level stands after its start or its step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Flow {
    /// An element is active; nothing is due before this instant.
    Running(Instant),
    /// The plan has ended.
    Ended(Ending),
    /// The whole run has to end: livelock or a failed interrupt.
    Fatal(Fault),
}

/// When a supervisor is due.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Slot {
    pub(crate) next: Instant,
}

/// What a poll of a supervisor brought. A fault beside an event is one of its outputs.
#[derive(Clone, Copy, Debug)]
pub struct Fired {
    /// One more than the event's number: two plain words come back in registers.
    pub(crate) event: Option<NonZeroU32>,
    pub(crate) fault: Option<Fault>,
}

/// What starting an element brought.
#[derive(Clone, Copy, Debug)]
pub enum Started {
    /// It acts.
    Running,
    /// It is a sub-plan; this is how its own start went.
    SubPlan(Flow),
    /// It was a computation, or a sub-plan that ended at once: its state, outputs staged.
    Done(u16),
    /// It failed and does not run.
    Failed(Fault),
}

/// What a poll of an element brought.
#[derive(Clone, Copy, Debug)]
pub enum Polled {
    /// It goes on.
    Pending,
    /// It is a sub-plan; this is how its step went.
    SubPlan(Flow),
    /// It reached a state, outputs staged.
    Done(u16),
    /// It is made to report a state, outputs staged, while it still acts: it has to be interrupted.
    Forced(u16),
    /// It failed and has to be interrupted.
    Failed(Fault),
    /// It is a sub-plan that ended in `Error`, or whose results do not fit: nothing runs in it any more.
    EndedInError(Fault),
}

/// What a step carries through all levels of a plan.
pub struct Cx<'a, R: Run> {
    /// The platform.
    pub env: &'a mut R::Env,
    /// The time of the step.
    pub now: Instant,
    pub(crate) sink: &'a mut R::Sink,
    pub(crate) clock: &'a R::Clock,
    pub(crate) step: &'a mut StepState,
    pub(crate) place: Place,
}

/// What all levels of one step count together.
#[derive(Clone, Debug, Default)]
pub(crate) struct StepState {
    /// Edges that may still be taken.
    pub edges_left: u32,
    /// The latest reading of the clock.
    pub clock: Instant,
    /// Commits so far in the run.
    pub commits: u32,
    /// Deadlines missed so far in the run, skipped releases included.
    pub misses: u64,
    /// The component that was called last, the innermost one of those that are being called: whose a
    /// panic is.
    pub called: ComponentId,
    /// The component that failed last: the innermost one, where sub-plans passed its fault on.
    pub failure: Option<Failure>,
    /// The value that the fault of the component called last is about.
    pub noted: Option<(Detail, Fault)>,
    /// A plan has just ended in `Error`: whoever uses it fails for the same reason.
    pub passed_on: bool,
}

/// Where a level's ids begin.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place {
    /// The plan itself.
    pub plan: ComponentId,
    /// Its first element.
    pub components: u32,
    /// Its first entry.
    pub entries: u32,
    /// The component that is being started.
    pub component: ComponentId,
}

impl Place {
    /// The outermost plan.
    pub const OUTERMOST: Place =
        Place { plan: ComponentId(0), components: 1, entries: 0, component: ComponentId(0) };
}

impl Fired {
    /// Nothing happened.
    pub const NOTHING: Fired = Fired { event: None, fault: None };

    /// An event, by position in the template, and how staging its outputs went.
    #[inline]
    pub fn event(event: u16, staged: Result<(), Fault>) -> Self {
        let event = NonZeroU32::MIN.saturating_add(u32::from(event));
        Fired { event: Some(event), fault: staged.err() }
    }

    /// The poll counts as one that ended after its deadline: for tests.
    pub fn missed() -> Self {
        Fired::event(Outcome::DeadlineMissed.number(), Ok(()))
    }

    #[inline]
    pub(crate) fn outcome(&self) -> Option<Outcome> {
        // Made from 16 bits.
        self.event.map(|event| Outcome::from_number(event.get().saturating_sub(1) as u16))
    }

    /// The supervisor failed.
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

    /// Checks inputs that are read anew.
    ///
    /// # Errors
    /// A value that is not finite or out of range.
    #[inline]
    pub(crate) fn checked<I: Ports>(&mut self, inputs: Result<I, BadValue>) -> Result<I, Fault> {
        let checked = inputs.and_then(|inputs| inputs.check().map(|()| inputs));
        self.noted(checked)
    }

    /// For plans that keep their components in boxes: lends the platform, and what shows the
    /// inputs to the trace, if there is one.
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

    /// Traces that a component reports what whoever tests the plan put there. `part` counts the
    /// plan's elements, then its supervisors.
    pub fn show_injected(&mut self, part: u32, outcome: Outcome) {
        let component = ComponentId(self.place.components.saturating_add(part));
        self.trace(&Record::Injected { component, outcome });
    }

    /// Runs a sub-plan's machine at its own place: its start, its step, its interruption.
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
    /// What became of values of the component that is called, as a fault; what it is about is noted.
    ///
    /// # Errors
    /// The fault alone.
    #[inline]
    pub fn noted<T>(&mut self, value: Result<T, BadValue>) -> Result<T, Fault> {
        value.map_err(|why| self.note(why))
    }

    /// Notes what a fault is about.
    #[cold]
    pub fn note(&mut self, why: BadValue) -> Fault {
        let subject = why.port.map(|port| match port {
            Port::Input(port) => Subject::Input(port),
            Port::Output(port) => Subject::Output(port),
            Port::Entry(entry) => {
                Subject::Entry(TraceEntryId(self.place.entries.saturating_add(entry.into())))
            }
        });
        let (component, value) = (self.step.called, why.value);
        self.step.noted = subject.map(|subject| (Detail { component, subject, value }, why.fault));
        why.fault
    }

    /// As [`Cx::noted`], for what a sub-plan is given and gives back: components inside may have been called
    /// since.
    ///
    /// # Errors
    /// The fault alone.
    pub fn noted_outside<T>(&mut self, value: Result<T, BadValue>) -> Result<T, Fault> {
        value.map_err(|why| {
            self.step.called = self.place.component;
            self.note(why)
        })
    }

    /// Notes who failed, unless it is a sub-plan that passes on the fault of a component inside, and says
    /// which value the fault is about.
    pub(crate) fn note_failure(&mut self, component: ComponentId, fault: Fault) -> Option<Detail> {
        let noted = self.step.noted.take();
        if !core::mem::take(&mut self.step.passed_on) {
            let detail = noted.filter(|(detail, of)| (detail.component, *of) == (component, fault));
            let detail = detail.map(|(detail, _)| detail);
            self.step.failure = Some(Failure { component, fault, detail });
        }
        self.step.failure?.detail
    }

    /// Calls a component, so that a panic in it is known to be its own.
    ///
    /// A guard that the unwinding drops would say so, too, and take back after the call what it says,
    /// but each poll would pay for it. Outside of components nothing of a step panics but a sink or a
    /// clock, which the scheduler tells from components by itself.
    #[inline(always)]
    pub(crate) fn call<T>(
        &mut self,
        component: ComponentId,
        run: impl FnOnce(&mut Self) -> T,
    ) -> T {
        self.step.called = component;
        self.sink.calls(component);
        run(self)
    }
}

impl<R: Run> Cx<'_, R> {
    #[inline]
    pub(crate) fn trace(&mut self, record: &Record<'_>) {
        if R::Sink::ENABLED {
            self.sink.record(self.now, record);
        }
    }

    /// Notes and traces that a component failed.
    #[cold]
    pub(crate) fn failed(&mut self, component: ComponentId, fault: Fault) {
        let detail = self.note_failure(component, fault);
        self.trace(&Record::Faulted { component, fault, detail });
    }
}

/// Writes one commit.
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

    /// Writes one entry of the plan, unless it has that value; whether it did.
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

    /// For plans that keep their entries themselves: traces one entry of the commit.
    pub fn wrote(&mut self, entry: u16, old: ValueRef<'_>, new: ValueRef<'_>) {
        if S::ENABLED {
            self.record(entry, old, new);
        }
    }

    /// The number of this commit, by which objects are known.
    pub fn number(&self) -> u32 {
        self.number
    }
}
