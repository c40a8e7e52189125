//! The outermost plan: its start and its steps.

mod drive;
mod guard;
mod outside;

use core::fmt;

use afp_types::{ElementId, EntryId, Instant, MAX_TRANSITIONS_PER_STEP, Value};
use heapless::Deque;

use crate::clock::Clock;
use crate::component::Environment;
use crate::fault::{Failure, Fault};
use crate::machine::Machine;
use crate::rt::{Cx, Flow, Place, Plan, PlanState, Run, StepState};
use crate::trace::{Author, ComponentId, Ending, Names, NoTrace, Record, Sink};

use guard::guarded;

pub use outside::{SetError, TypedEntry};

/// Writes from outside that one step can take.
pub const MAX_WRITES_PER_STEP: usize = 16;

/// What a step leaves to do.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Wake {
    /// Call again at this instant, which is later than the step's; earlier does no harm.
    At(Instant),
    /// The plan has ended; nothing will ever be due.
    Ended(Ending),
    /// The plan has not started, so nothing was done: call [`Scheduler::start`] first.
    NotStarted,
}

/// Why a plan cannot start.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum StartError {
    /// This `in` entry has neither a value nor a default.
    InputMissing(EntryId),
    /// It has been started before.
    AlreadyStarted,
}

/// A plan that can be driven: started, stepped, written to and stopped.
///
/// Whoever drives it calls [`Scheduler::step`] at the times that [`Wake`] names, and calls
/// [`Environment::emergency_stop`] before leaving the robot alone.
///
/// Nothing here catches a panic. Where one unwinds through a call, of a component, the sink or the clock, the plan is broken:
/// the next [`Scheduler::step`], [`Scheduler::start`] or [`Scheduler::abort`] gives the emergency stop
/// and ends the run in `Error`, and no component is called again. Drivers that catch do so at once.
pub struct Scheduler<P: PlanState> {
    machine: Machine<P>,
    state: State,
    last: Instant,
    stop_requested: bool,
    writes: Deque<(u16, Value), MAX_WRITES_PER_STEP>,
    step: StepState,
}

impl fmt::Display for StartError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            StartError::InputMissing(entry) => {
                write!(f, "input {} of the plan (by position, from 0) has no value", entry.0)
            }
            StartError::AlreadyStarted => f.write_str("the plan has been started before"),
        }
    }
}

impl StartError {
    /// The error with the name of the entry in place of its position.
    pub fn named(self, names: &impl Names) -> impl fmt::Display {
        NamedStartError(self, names)
    }
}

struct NamedStartError<'a, N>(StartError, &'a N);

impl<N: Names> fmt::Display for NamedStartError<'_, N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0 {
            StartError::InputMissing(entry) => {
                let name = self.1.entry(entry.into()).path;
                write!(f, "the input '{name}' has no value: set it before the start")
            }
            error => error.fmt(f),
        }
    }
}

impl core::error::Error for StartError {}

#[derive(Clone, Copy, Debug, PartialEq)]
enum State {
    Ready,
    Running,
    /// A panic unwound through a call: of a component, or `outside`, of a sink or a clock.
    Broken {
        outside: bool,
    },
    Ended(Ending),
}

impl<P: PlanState> Scheduler<P> {
    /// A plan that has not started.
    pub fn new(plan: P) -> Self {
        Scheduler {
            machine: Machine::new(plan),
            state: State::Ready,
            last: Instant::ZERO,
            stop_requested: false,
            writes: Deque::new(),
            step: StepState::default(),
        }
    }

    /// A copy that goes on from here by itself, on a platform of its own: a keyframe to come back to.
    /// `None` where a component cannot be copied.
    pub fn try_clone(&self) -> Option<Self> {
        Some(Scheduler {
            machine: self.machine.try_clone()?,
            state: self.state,
            last: self.last,
            stop_requested: self.stop_requested,
            writes: self.writes.clone(),
            step: self.step.clone(),
        })
    }

    /// The plan.
    pub fn plan(&self) -> &P {
        self.machine.plan()
    }

    /// The plan itself, as far as it is.
    pub fn into_plan(self) -> P {
        self.machine.into_plan()
    }

    /// The plan, to set its `in` entries before the start; none once it has started. A running plan
    /// is written to with [`Scheduler::set`] and [`Scheduler::write`].
    pub fn plan_mut(&mut self) -> Option<&mut P> {
        (self.state == State::Ready).then(|| self.machine.plan_mut())
    }

    /// The plan however far it is, for tests that put outcomes in the place of a component's own.
    #[doc(hidden)]
    pub fn plan_under_test(&mut self) -> &mut P {
        self.machine.plan_mut()
    }

    /// The active element of the outermost plan.
    pub fn active(&self) -> Option<ElementId> {
        self.machine.active()
    }

    /// How the plan ended, once it has.
    pub fn ending(&self) -> Option<Ending> {
        match self.state {
            State::Ended(ending) => Some(ending),
            State::Ready | State::Running | State::Broken { .. } => None,
        }
    }

    /// Which component failed and why, where the plan ended in [`Ending::Error`]: the innermost one
    /// whose fault no `Error` edge took. The plan itself (id 0) where no single component failed.
    pub fn failure(&self) -> Option<Failure> {
        match self.state {
            State::Ended(Ending::Error(_)) => self.step.failure,
            _ => None,
        }
    }

    /// Deadlines missed so far, skipped releases included.
    pub fn misses(&self) -> u64 {
        self.step.misses
    }

    /// Starts the plan at `now`.
    ///
    /// # Errors
    /// [`StartError`]; nothing has happened then.
    pub fn start<R: Run>(&mut self, mut on: R, now: Instant) -> Result<Wake, StartError>
    where
        P: Plan<R::Env>,
    {
        match self.state {
            State::Ready => {}
            State::Broken { outside } => return Ok(self.broken(outside, on)),
            State::Running | State::Ended(_) => return Err(StartError::AlreadyStarted),
        }
        if let Some(entry) = self.machine.plan().missing_input() {
            return Err(StartError::InputMissing(EntryId(entry)));
        }
        self.state = State::Running;
        self.last = now;
        self.prepare(on.parts().2, now);
        if self.stop_requested {
            return Ok(self.stop_now(on));
        }
        let (env, sink, clock) = on.parts();
        let flow = guarded(&mut self.state, (sink, clock), |sink, clock| {
            self.machine.start(&mut context((env, sink, clock), now, &mut self.step))
        });
        Ok(self.conclude(flow, on))
    }

    /// Does everything that is due at `now` and says when to call again. Before the start it does
    /// nothing.
    ///
    /// Never allocates. Time grows linearly with the number of due supervisors. A time before
    /// that of the last step is traced and counts as that one.
    #[inline]
    pub fn step<R: Run>(&mut self, mut on: R, now: Instant) -> Wake
    where
        P: Plan<R::Env>,
    {
        if self.state != State::Running {
            return self.not_running(on);
        }
        if now < self.last {
            let (_, sink, clock) = on.parts();
            guarded(&mut self.state, (sink, clock), |sink, _| {
                sink.record(self.last, &Record::ClockWentBack { asked: now });
            });
        }
        self.last = self.last.max(now);
        self.prepare(on.parts().2, self.last);
        if self.stop_requested {
            return self.stop_now(on);
        }
        let (env, sink, clock) = on.parts();
        let flow = guarded(&mut self.state, (sink, clock), |sink, clock| {
            let mut cx = context((env, sink, clock), self.last, &mut self.step);
            if !self.writes.is_empty() {
                while let Some((entry, value)) = self.writes.pop_front() {
                    self.machine.plan_mut().stage(entry, &value);
                }
                self.machine.commit(Author::Outside, &mut cx);
            }
            self.machine.step(&mut cx)
        });
        match flow {
            Flow::Running(wake) => Wake::At(wake),
            flow => self.conclude(flow, on),
        }
    }

    /// The plan cannot be stepped any more, for instance because a component panicked: the
    /// platform stops, the run ends in `Error` unless it has ended before.
    pub fn abort<R: Run>(&mut self, mut on: R, fault: Fault) -> Wake {
        match self.state {
            State::Ended(ending) => {
                on.parts().0.emergency_stop();
                Wake::Ended(ending)
            }
            State::Broken { outside } => self.broken(outside, on),
            State::Ready | State::Running => self.conclude(Flow::Fatal(fault), on),
        }
    }

    #[inline]
    fn prepare<C: Clock>(&mut self, clock: &C, now: Instant) {
        self.step.edges_left = MAX_TRANSITIONS_PER_STEP;
        self.step.clock =
            guarded(&mut self.state, (&mut NoTrace, clock), |_, clock| clock.now(now));
    }

    #[cold]
    fn not_running<R: Run>(&mut self, on: R) -> Wake {
        match self.state {
            State::Ended(ending) => Wake::Ended(ending),
            State::Broken { outside } => self.broken(outside, on),
            State::Ready | State::Running => Wake::NotStarted,
        }
    }

    /// Ends a run after a panic: nobody is asked, not even to be interrupted.
    fn broken<R: Run>(&mut self, outside: bool, on: R) -> Wake {
        match outside {
            true => self.fatal(ComponentId(0), Fault::PANIC_OUTSIDE, on),
            false => self.fatal(self.step.called, Fault::PANIC, on),
        }
    }

    /// The platform stops, the run ends in `Error`.
    fn fatal<R: Run>(&mut self, component: ComponentId, fault: Fault, mut on: R) -> Wake {
        let (env, sink, _) = on.parts();
        env.emergency_stop();
        let (plan, ending) = (ComponentId(0), Ending::Error(fault));
        // An actor that could not be interrupted has been noted already.
        if self.step.failure.is_none_or(|known| known.fault != fault) {
            self.step.failure = Some(Failure { component, fault, detail: None });
        }
        // First: whatever the sink does, nothing is called any more.
        self.state = State::Ended(ending);
        sink.record(self.last, &Record::Faulted { component, fault, detail: None });
        sink.record(self.last, &Record::Ended { plan, ending });
        Wake::Ended(ending)
    }

    fn stop_now<R: Run>(&mut self, mut on: R) -> Wake
    where
        P: Plan<R::Env>,
    {
        let (env, sink, clock) = on.parts();
        let flow = guarded(&mut self.state, (sink, clock), |sink, clock| {
            let mut cx = context((env, sink, clock), self.last, &mut self.step);
            cx.trace(&Record::StopRequested);
            match self.machine.interrupt(&mut cx) {
                Ok(()) => {
                    let ending = Ending::Interrupted;
                    cx.trace(&Record::Ended { plan: ComponentId(0), ending });
                    Flow::Ended(ending)
                }
                Err(fault) => Flow::Fatal(fault),
            }
        });
        self.conclude(flow, on)
    }

    /// Turns a level's flow into the run's state.
    fn conclude<R: Run>(&mut self, flow: Flow, on: R) -> Wake {
        match flow {
            Flow::Running(wake) => Wake::At(wake),
            Flow::Ended(ending) => {
                self.state = State::Ended(ending);
                Wake::Ended(ending)
            }
            Flow::Fatal(fault) => self.fatal(ComponentId(0), fault, on),
        }
    }
}

fn context<'a, E: Environment + ?Sized, S: Sink, C: Clock>(
    (env, sink, clock): (&'a mut E, &'a mut S, &'a C),
    now: Instant,
    step: &'a mut StepState,
) -> Cx<'a, (&'a mut E, &'a mut S, &'a C)> {
    Cx { env, now, sink, clock, step, place: Place::OUTERMOST }
}
