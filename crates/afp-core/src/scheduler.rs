//! The outermost plan: its start, its steps, and what comes from outside.

use core::fmt;

use heapless::Deque;

use crate::clock::Clock;
use crate::component::Environment;
use crate::fault::Fault;
use crate::machine::{Flow, MAX_TRANSITIONS_PER_STEP, Machine};
use crate::rt::{Cx, Place, Plan, PlanState, StepState, WriteError};
use crate::time::Instant;
use crate::trace::{Author, ComponentId, Ending, Record, Sink};
use crate::value::Value;

/// Writes from outside that one step can take.
pub const MAX_WRITES_PER_STEP: usize = 16;

/// What a step leaves to do.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Wake {
    /// Call again at this instant, which is later than the step's; earlier does no harm.
    At(Instant),
    /// The plan has ended; nothing will ever be due.
    Ended(Ending),
}

/// Why a plan cannot start.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StartError {
    /// This `in` entry, by position, has neither a value nor a default.
    InputMissing(u16),
    /// It has been started before.
    AlreadyStarted,
}

/// A plan that can be driven: started, stepped, written to and stopped.
///
/// Whoever drives it calls [`Scheduler::step`] at the times that [`Wake`] names, and calls
/// [`Environment::emergency_stop`] before leaving the robot alone.
///
/// Nothing here catches a panic. Where one of a component unwinds through a call, the plan is broken:
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
            StartError::InputMissing(entry) => write!(f, "entry {entry} of the plan has no value"),
            StartError::AlreadyStarted => f.write_str("the plan has been started before"),
        }
    }
}

impl core::error::Error for StartError {}

#[derive(Clone, Copy, Debug, PartialEq)]
enum State {
    Ready,
    Running,
    /// A panic unwound through a call.
    Broken,
    Ended(Ending),
}

/// Stands around a call of the machine: dropped by the unwinding of a panic, it marks the plan broken.
struct Unwinding<'a>(&'a mut State);

impl Drop for Unwinding<'_> {
    fn drop(&mut self) {
        *self.0 = State::Broken;
    }
}

/// Runs `call` so that a panic in it leaves the state broken.
#[inline(always)]
fn guarded<R>(state: &mut State, call: impl FnOnce() -> R) -> R {
    let unwinding = Unwinding(state);
    let result = call();
    core::mem::forget(unwinding);
    result
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

    /// The plan, to set its `in` entries before the start. A running plan is written to with
    /// [`Scheduler::write`].
    pub fn plan_mut(&mut self) -> &mut P {
        self.machine.plan_mut()
    }

    /// The active element of the outermost plan, by position.
    pub fn active(&self) -> Option<u16> {
        self.machine.active()
    }

    /// How the plan ended, once it has.
    pub fn ending(&self) -> Option<Ending> {
        match self.state {
            State::Ended(ending) => Some(ending),
            State::Ready | State::Running | State::Broken => None,
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
    pub fn start<E, S, C>(
        &mut self,
        env: &mut E,
        sink: &mut S,
        clock: &C,
        now: Instant,
    ) -> Result<Wake, StartError>
    where
        E: Environment + ?Sized,
        S: Sink,
        C: Clock,
        P: Plan<E>,
    {
        match self.state {
            State::Ready => {}
            State::Broken => return Ok(self.broken(env, sink)),
            State::Running | State::Ended(_) => return Err(StartError::AlreadyStarted),
        }
        if let Some(entry) = self.machine.plan().missing_input() {
            return Err(StartError::InputMissing(entry));
        }
        self.state = State::Running;
        self.last = now;
        self.prepare(clock, now);
        if self.stop_requested {
            return Ok(self.stop_now(env, sink, clock));
        }
        let flow = guarded(&mut self.state, || {
            self.machine.start(&mut context(env, sink, clock, now, &mut self.step))
        });
        Ok(self.conclude(flow, env, sink))
    }

    /// Does everything that is due at `now` and says when to call again.
    ///
    /// Never allocates. Time grows linearly with the number of due supervisors. A time before
    /// that of the last step is traced and counts as that one.
    #[inline]
    pub fn step<E, S, C>(&mut self, env: &mut E, sink: &mut S, clock: &C, now: Instant) -> Wake
    where
        E: Environment + ?Sized,
        S: Sink,
        C: Clock,
        P: Plan<E>,
    {
        if self.state != State::Running {
            return self.not_running(env, sink, now);
        }
        if now < self.last {
            sink.record(self.last, &Record::ClockWentBack { asked: now });
        }
        self.last = self.last.max(now);
        self.prepare(clock, self.last);
        if self.stop_requested {
            return self.stop_now(env, sink, clock);
        }
        let flow = guarded(&mut self.state, || {
            let mut cx = context(env, sink, clock, self.last, &mut self.step);
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
            flow => self.conclude(flow, env, sink),
        }
    }

    /// Drives the plan in virtual time up to and including `until`, from the start if it has not
    /// started: before each step `advance` brings the platform to the step's instant.
    ///
    /// # Errors
    /// [`StartError`] when it cannot start.
    pub fn run<E, S, C>(
        &mut self,
        env: &mut E,
        sink: &mut S,
        clock: &C,
        until: Instant,
        mut advance: impl FnMut(&mut E, Instant),
    ) -> Result<Wake, StartError>
    where
        E: Environment + ?Sized,
        S: Sink,
        C: Clock,
        P: Plan<E>,
    {
        let mut wake = match self.state {
            State::Ready => self.start(env, sink, clock, self.last)?,
            State::Running | State::Broken | State::Ended(_) => {
                self.step(env, sink, clock, self.last)
            }
        };
        while let Wake::At(at) = wake {
            if at > until {
                break;
            }
            advance(env, at);
            wake = self.step(env, sink, clock, at);
        }
        Ok(wake)
    }

    /// Stages a write to an `in` or `var` entry; the next step commits it.
    ///
    /// # Errors
    /// [`WriteError`]: the plan gets nothing.
    pub fn write(&mut self, entry: u16, value: Value) -> Result<(), WriteError> {
        if matches!(self.state, State::Broken | State::Ended(_)) {
            return Err(WriteError::Ended);
        }
        self.machine.plan().accepts(entry, &value)?;
        self.writes.push_back((entry, value)).map_err(|_| WriteError::QueueFull)
    }

    /// Asks the plan to stop: the next step interrupts it and ends it as `Interrupted`. A plan that
    /// has not started then ends at its start, before anything runs.
    pub fn request_stop(&mut self) {
        self.stop_requested = true;
    }

    /// The plan cannot be stepped any more, for instance because a component panicked: the
    /// platform stops, the run ends in `Error` unless it has ended before.
    pub fn abort<E, S>(&mut self, env: &mut E, sink: &mut S, fault: Fault) -> Wake
    where
        E: Environment + ?Sized,
        S: Sink,
    {
        match self.state {
            State::Ended(ending) => {
                env.emergency_stop();
                Wake::Ended(ending)
            }
            State::Broken => self.broken(env, sink),
            State::Ready | State::Running => self.conclude(Flow::Fatal(fault), env, sink),
        }
    }

    #[inline]
    fn prepare<C: Clock>(&mut self, clock: &C, now: Instant) {
        self.step.edges_left = MAX_TRANSITIONS_PER_STEP;
        self.step.clock = clock.now(now);
    }

    #[cold]
    fn not_running<E, S>(&mut self, env: &mut E, sink: &mut S, now: Instant) -> Wake
    where
        E: Environment + ?Sized,
        S: Sink,
    {
        match self.state {
            State::Ended(ending) => Wake::Ended(ending),
            State::Broken => self.broken(env, sink),
            State::Ready | State::Running => Wake::At(now),
        }
    }

    /// Ends a run after a panic: nobody is asked, not even to be interrupted.
    fn broken<E, S>(&mut self, env: &mut E, sink: &mut S) -> Wake
    where
        E: Environment + ?Sized,
        S: Sink,
    {
        self.fatal(self.step.called, Fault::PANIC, env, sink)
    }

    /// The platform stops, the run ends in `Error`.
    fn fatal<E, S>(
        &mut self,
        component: ComponentId,
        fault: Fault,
        env: &mut E,
        sink: &mut S,
    ) -> Wake
    where
        E: Environment + ?Sized,
        S: Sink,
    {
        env.emergency_stop();
        let (plan, ending) = (ComponentId(0), Ending::Error(fault));
        sink.record(self.last, &Record::Faulted { component, fault });
        sink.record(self.last, &Record::Ended { plan, ending });
        self.state = State::Ended(ending);
        Wake::Ended(ending)
    }

    fn stop_now<E, S, C>(&mut self, env: &mut E, sink: &mut S, clock: &C) -> Wake
    where
        E: Environment + ?Sized,
        S: Sink,
        C: Clock,
        P: Plan<E>,
    {
        let flow = guarded(&mut self.state, || {
            let mut cx = context(env, sink, clock, self.last, &mut self.step);
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
        self.conclude(flow, env, sink)
    }

    /// Turns a level's flow into the run's state.
    fn conclude<E, S>(&mut self, flow: Flow, env: &mut E, sink: &mut S) -> Wake
    where
        E: Environment + ?Sized,
        S: Sink,
    {
        match flow {
            Flow::Running(wake) => Wake::At(wake),
            Flow::Ended(ending) => {
                self.state = State::Ended(ending);
                Wake::Ended(ending)
            }
            Flow::Fatal(fault) => self.fatal(ComponentId(0), fault, env, sink),
        }
    }
}

fn context<'a, E: ?Sized, S, C>(
    env: &'a mut E,
    sink: &'a mut S,
    clock: &'a C,
    now: Instant,
    step: &'a mut StepState,
) -> Cx<'a, E, S, C> {
    Cx { env, now, sink, clock, step, place: Place::OUTERMOST }
}
