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
            State::Ready | State::Running => None,
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
        if self.state != State::Ready {
            return Err(StartError::AlreadyStarted);
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
        let flow = self.machine.start(&mut context(env, sink, clock, now, &mut self.step));
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
            return self.not_running(now);
        }
        if now < self.last {
            sink.record(self.last, &Record::ClockWentBack { asked: now });
        }
        self.last = self.last.max(now);
        self.prepare(clock, self.last);
        if self.stop_requested {
            return self.stop_now(env, sink, clock);
        }
        let mut cx = context(env, sink, clock, self.last, &mut self.step);
        if !self.writes.is_empty() {
            while let Some((entry, value)) = self.writes.pop_front() {
                self.machine.plan_mut().stage(entry, &value);
            }
            self.machine.commit(Author::Outside, &mut cx);
        }
        match self.machine.step(&mut cx) {
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
            State::Running | State::Ended(_) => self.step(env, sink, clock, self.last),
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
        if self.ending().is_some() {
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
            State::Ready | State::Running => self.conclude(Flow::Fatal(fault), env, sink),
        }
    }

    #[inline]
    fn prepare<C: Clock>(&mut self, clock: &C, now: Instant) {
        self.step.edges_left = MAX_TRANSITIONS_PER_STEP;
        self.step.clock = clock.now(now);
    }

    fn not_running(&self, now: Instant) -> Wake {
        match self.state {
            State::Ended(ending) => Wake::Ended(ending),
            State::Ready | State::Running => Wake::At(now),
        }
    }

    fn stop_now<E, S, C>(&mut self, env: &mut E, sink: &mut S, clock: &C) -> Wake
    where
        E: Environment + ?Sized,
        S: Sink,
        C: Clock,
        P: Plan<E>,
    {
        let mut cx = context(env, sink, clock, self.last, &mut self.step);
        cx.trace(&Record::StopRequested);
        let flow = match self.machine.interrupt(&mut cx) {
            Ok(()) => {
                let ending = Ending::Interrupted;
                cx.trace(&Record::Ended { plan: ComponentId(0), ending });
                Flow::Ended(ending)
            }
            Err(fault) => Flow::Fatal(fault),
        };
        self.conclude(flow, env, sink)
    }

    /// Turns a level's flow into the run's state.
    fn conclude<E, S>(&mut self, flow: Flow, env: &mut E, sink: &mut S) -> Wake
    where
        E: Environment + ?Sized,
        S: Sink,
    {
        let ending = match flow {
            Flow::Running(wake) => return Wake::At(wake),
            Flow::Ended(ending) => ending,
            Flow::Fatal(fault) => {
                env.emergency_stop();
                let ending = Ending::Error(fault);
                let plan = ComponentId(0);
                sink.record(self.last, &Record::Faulted { component: plan, fault });
                sink.record(self.last, &Record::Ended { plan, ending });
                ending
            }
        };
        self.state = State::Ended(ending);
        Wake::Ended(ending)
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
