//! Holding a running plan, for debuggers of real robots.

use afp_types::Instant;

use super::{Scheduler, State, Wake, context, guarded};
use crate::machine::Machine;
use crate::rt::{Cx, Flow, Plan, PlanState, Run, Stops};
use crate::trace::{Author, Record, Sink};

/// How far a held plan continues.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Release {
    /// Until the next hold.
    Continue,
    /// Until the outermost plan is about to enter its next element.
    Step,
}

/// The work of a step around a hold.
trait Work {
    fn run<P: Plan<R::Env>, R: Run>(self, machine: &mut Machine<P>, cx: &mut Cx<'_, R>) -> Flow;
}

struct BeginHold;
struct StepHeld;
struct EndHold(Release);

impl Work for BeginHold {
    fn run<P: Plan<R::Env>, R: Run>(self, machine: &mut Machine<P>, cx: &mut Cx<'_, R>) -> Flow {
        machine.hold(cx)
    }
}

impl Work for StepHeld {
    fn run<P: Plan<R::Env>, R: Run>(self, machine: &mut Machine<P>, cx: &mut Cx<'_, R>) -> Flow {
        machine.step_held(cx)
    }
}

impl Work for EndHold {
    fn run<P: Plan<R::Env>, R: Run>(self, machine: &mut Machine<P>, cx: &mut Cx<'_, R>) -> Flow {
        // The element of the hold itself is entered.
        let pending = cx.step.hold.is_some_and(|hold| hold.pending.is_some());
        cx.step.stops = match self.0 {
            Release::Continue => Stops::Never,
            Release::Step if pending => Stops::AfterNext,
            Release::Step => Stops::Next,
        };
        machine.release(cx)
    }
}

impl<P: PlanState> Scheduler<P> {
    /// Whether the plan can be held. A compiled plan cannot, unless its code was generated for it.
    pub const HOLDS: bool = P::HOLDS;

    /// Whether the plan is held.
    pub fn is_held(&self) -> bool {
        self.state == State::Held
    }

    /// Performs a step that holds the plan: suspends the active element, or interrupts it if it
    /// cannot be suspended. Before the start, the plan is held when it starts. A plan that is held,
    /// has ended or cannot be held ([`Scheduler::HOLDS`]) is only stepped.
    ///
    /// Until [`Scheduler::release`], steps poll only the global supervisors of the outermost plan,
    /// and only events that end the plan are taken.
    pub fn hold<R: Run>(&mut self, on: R, now: Instant) -> Wake
    where
        P: Plan<R::Env>,
    {
        match self.state {
            _ if !P::HOLDS => self.step(on, now),
            State::Running => self.step_with(on, now, BeginHold),
            State::Ready => {
                self.step.stops = Stops::Next;
                Wake::NotStarted
            }
            State::Held | State::Broken { .. } | State::Ended(_) => self.step(on, now),
        }
    }

    /// Performs a step that releases a held plan. A plan that is not held holds at its next
    /// transition, or no longer does.
    pub fn release<R: Run>(&mut self, on: R, now: Instant, how: Release) -> Wake
    where
        P: Plan<R::Env>,
    {
        if P::HOLDS && self.state == State::Held {
            return self.step_with(on, now, EndHold(how));
        }
        self.step.stops = match how {
            Release::Continue => Stops::Never,
            Release::Step => Stops::Next,
        };
        self.step(on, now)
    }

    pub(super) fn step_held<R: Run>(&mut self, on: R, now: Instant) -> Wake
    where
        P: Plan<R::Env>,
    {
        self.step_with(on, now, StepHeld)
    }

    fn step_with<R: Run>(&mut self, mut on: R, now: Instant, work: impl Work) -> Wake
    where
        P: Plan<R::Env>,
    {
        let (_, sink, clock) = on.parts();
        if now < self.last {
            guarded(&mut self.state, (sink, clock), |sink, _| {
                sink.record(self.last, &Record::ClockWentBack { asked: now });
            });
        }
        self.last = self.last.max(now);
        self.prepare(clock, self.last);
        if self.stop_requested {
            return self.stop_now(on);
        }
        let (env, sink, clock) = on.parts();
        let flow = guarded(&mut self.state, (sink, clock), |sink, clock| {
            let mut cx = context((env, sink, clock), self.last, &mut self.step);
            while let Some((entry, value)) = self.writes.pop_front() {
                self.machine.plan_mut().stage(entry, &value);
                if self.writes.is_empty() {
                    self.machine.commit(Author::Outside, &mut cx);
                }
            }
            work.run(&mut self.machine, &mut cx)
        });
        self.conclude(flow, on)
    }
}
