//! The outermost plan: its start and its steps.

mod drive;
mod guard;
mod hold;
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

pub use hold::Release;
pub use outside::{SetError, TypedEntry};

/// Maximum number of writes from outside per step.
pub const MAX_WRITES_PER_STEP: usize = 16;

/// The next work after a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Wake {
    /// Call again at this instant, which is later than the step's. An earlier call is harmless.
    At(Instant),
    /// The plan has ended.
    Ended(Ending),
    /// The plan has not started and did nothing: call [`Scheduler::start`] first.
    NotStarted,
}

/// Why a plan cannot start.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum StartError {
    /// This `in` entry has neither a value nor a default.
    InputMissing(EntryId),
    /// The plan was started before.
    AlreadyStarted,
}

/// A plan to start, step, write to and stop.
///
/// The driver calls [`Scheduler::step`] at the times in [`Wake`], and
/// [`Environment::emergency_stop`] before it leaves the robot unattended.
///
/// The scheduler does not catch panics. If a panic of a component, the sink or the clock unwinds
/// through a call, the plan is broken: the next [`Scheduler::step`], [`Scheduler::start`] or
/// [`Scheduler::abort`] calls the emergency stop and ends the run in `Error`, and no component is
/// called again. Drivers that catch panics should make this call immediately.
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
            StartError::AlreadyStarted => f.write_str("the plan has already been started"),
        }
    }
}

impl StartError {
    /// Formats the error with the entry's name instead of its position.
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
    Held,
    /// A panic unwound through a call of a component or, if `outside`, of a sink or a clock.
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

    /// A copy that runs independently on its own platform, as a keyframe. `None` if a component
    /// cannot be copied.
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

    /// Unwraps the plan in its current state.
    pub fn into_plan(self) -> P {
        self.machine.into_plan()
    }

    /// Access for setting `in` entries before the start; `None` afterwards. Write to a running plan
    /// with [`Scheduler::set`] and [`Scheduler::write`].
    pub fn plan_mut(&mut self) -> Option<&mut P> {
        (self.state == State::Ready).then(|| self.machine.plan_mut())
    }

    /// Access to the plan at any time, for tests that inject outcomes.
    #[doc(hidden)]
    pub fn plan_under_test(&mut self) -> &mut P {
        self.machine.plan_mut()
    }

    /// The active element of the outermost plan.
    pub fn active(&self) -> Option<ElementId> {
        self.machine.active()
    }

    /// The ending, if the plan has ended.
    pub fn ending(&self) -> Option<Ending> {
        match self.state {
            State::Ended(ending) => Some(ending),
            State::Ready | State::Running | State::Held | State::Broken { .. } => None,
        }
    }

    /// The failed component and its fault after [`Ending::Error`]: the innermost component whose
    /// fault no `Error` edge took. It is the plan itself (id 0) if no single component failed.
    pub fn failure(&self) -> Option<Failure> {
        match self.state {
            State::Ended(Ending::Error(_)) => self.step.failure,
            _ => None,
        }
    }

    /// Missed deadlines so far, with skipped releases.
    pub fn misses(&self) -> u64 {
        self.step.misses
    }

    /// Starts the plan at `now`.
    ///
    /// # Errors
    /// [`StartError`], without any effect.
    pub fn start<R: Run>(&mut self, mut on: R, now: Instant) -> Result<Wake, StartError>
    where
        P: Plan<R::Env>,
    {
        match self.state {
            State::Ready => {}
            State::Broken { outside } => return Ok(self.broken(outside, on)),
            State::Running | State::Held | State::Ended(_) => {
                return Err(StartError::AlreadyStarted);
            }
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

    /// Performs all work due at `now` and returns the time of the next call. Does nothing before
    /// the start.
    ///
    /// Never allocates. Time grows linearly with the number of due supervisors. A time before the
    /// last step is traced and replaced by the last step's time.
    #[inline]
    pub fn step<R: Run>(&mut self, mut on: R, now: Instant) -> Wake
    where
        P: Plan<R::Env>,
    {
        if self.state != State::Running {
            return self.not_running(on, now);
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

    /// Ends a plan that cannot be stepped any longer, for instance after a panic. The platform
    /// stops, and the run ends in `Error` unless it has ended before.
    pub fn abort<R: Run>(&mut self, mut on: R, fault: Fault) -> Wake {
        match self.state {
            State::Ended(ending) => {
                on.parts().0.emergency_stop();
                Wake::Ended(ending)
            }
            State::Broken { outside } => self.broken(outside, on),
            State::Ready | State::Running | State::Held => self.conclude(Flow::Fatal(fault), on),
        }
    }

    #[inline]
    fn prepare<C: Clock>(&mut self, clock: &C, now: Instant) {
        self.step.edges_left = MAX_TRANSITIONS_PER_STEP;
        self.step.clock =
            guarded(&mut self.state, (&mut NoTrace, clock), |_, clock| clock.now(now));
    }

    #[cold]
    fn not_running<R: Run>(&mut self, on: R, now: Instant) -> Wake
    where
        P: Plan<R::Env>,
    {
        match self.state {
            State::Held if P::HOLDS => self.step_held(on, now),
            State::Ended(ending) => Wake::Ended(ending),
            State::Broken { outside } => self.broken(outside, on),
            State::Ready | State::Running | State::Held => Wake::NotStarted,
        }
    }

    /// Ends a run after a panic without calling any component, even for interruption.
    fn broken<R: Run>(&mut self, outside: bool, on: R) -> Wake {
        match outside {
            true => self.fatal(ComponentId(0), Fault::PANIC_OUTSIDE, on),
            false => self.fatal(self.step.called, Fault::PANIC, on),
        }
    }

    /// Stops the platform and ends the run in `Error`.
    fn fatal<R: Run>(&mut self, component: ComponentId, fault: Fault, mut on: R) -> Wake {
        let (env, sink, _) = on.parts();
        env.emergency_stop();
        let (plan, ending) = (ComponentId(0), Ending::Error(fault));
        // A failed interrupt is stored already.
        if self.step.failure.is_none_or(|known| known.fault != fault) {
            self.step.failure = Some(Failure { component, fault, detail: None });
        }
        // Set first: if the sink panics, nothing is called again.
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
            let held = self.machine.abandon_held(&mut cx);
            match held.and_then(|()| self.machine.interrupt(&mut cx)) {
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

    /// Converts a level's flow to the run's state.
    fn conclude<R: Run>(&mut self, flow: Flow, on: R) -> Wake {
        match flow {
            Flow::Running(wake) => {
                self.state = State::Running;
                Wake::At(wake)
            }
            Flow::Held(wake) => {
                self.state = State::Held;
                Wake::At(wake)
            }
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
