//! The scheduler of one level: a plan or a sub-plan.
//!
//! ```text
//!            start ---> enter(first element)
//!
//!   step:    sweep the supervisors in their fixed order
//!              an event is taken   -> interrupt, commit, follow
//!              ... that may resume -> commit, compute; go on, or interrupt and follow
//!            else poll the active element, if due
//!              it reached a state  -> commit, follow
//!              it failed           -> interrupt, follow its `Error` edge
//!
//!   follow:  take edges until an element is active or the plan ends
//!   enter:   start its supervisors, look, read its inputs, start it
//! ```
//!
//! A sub-plan is an element whose poll is the step of a machine of its own. The recursion polls
//! outer plans first and interrupts innermost first.

mod at;
mod enter;
mod held;
mod leave;
mod sweep;

use crate::fault::Fault;
use crate::rt::{
    Committer, Cx, ElementRow, Flow, Plan, PlanState, Polled, Run, Slot, Tables, Target,
};
use crate::trace::{Author, ComponentId, Ending, Record, Sink};
use afp_types::{Duration, ElementId, Instant, SupervisorId};
use at::StepAt;
use sweep::Seen;

/// A plan, its rows and the state of its scheduling.
pub struct Machine<P: PlanState> {
    tables: P::Tables,
    level: Level<P>,
}

/// All of a machine but the rows, so that those can be read meanwhile.
struct Level<P: PlanState> {
    plan: P,
    slots: P::Slots,
    active: Option<ElementId>,
    due: Instant,
}

/// An edge about to be followed.
#[derive(Clone, Copy)]
struct Edge {
    target: Option<Target>,
    /// How the plan ends if the edge leads to `terminate`.
    ending: Ending,
}

/// How following an edge may end short of an active element.
#[derive(Clone, Copy)]
enum Stop {
    /// The plan ends.
    Plan(Ending),
    /// The run ends.
    Run(Fault),
}

impl<P: PlanState> Machine<P> {
    /// A machine that has not started.
    pub fn new(plan: P) -> Self {
        let (tables, slots) = (plan.tables(), plan.slots());
        Machine { tables, level: Level { plan, slots, active: None, due: Instant::MAX } }
    }

    /// A copy that goes on from here by itself; `None` where a component cannot be copied.
    pub fn try_clone(&self) -> Option<Self> {
        let Level { plan, slots, active, due } = &self.level;
        let plan = plan.try_clone()?;
        let tables = plan.tables();
        Some(Machine {
            tables,
            level: Level { plan, slots: slots.clone(), active: *active, due: *due },
        })
    }

    /// The plan.
    pub fn plan(&self) -> &P {
        &self.level.plan
    }

    /// The plan itself.
    pub fn into_plan(self) -> P {
        self.level.plan
    }

    /// The plan, to set its entries before the start.
    pub fn plan_mut(&mut self) -> &mut P {
        &mut self.level.plan
    }

    /// The active element, by position; `None` before the start and after the end.
    pub fn active(&self) -> Option<ElementId> {
        self.level.active
    }

    /// Starts afresh: initial values, global supervisors, first element.
    pub fn start<R: Run>(&mut self, cx: &mut Cx<'_, R>) -> Flow
    where
        P: Plan<R::Env>,
    {
        self.level.start(&self.tables, cx)
    }

    /// Does everything that is due.
    #[inline]
    pub fn step<R: Run>(&mut self, cx: &mut Cx<'_, R>) -> Flow
    where
        P: Plan<R::Env>,
    {
        self.level.step(&self.tables, cx)
    }

    /// Interrupts whatever is active, innermost first, and drops all components.
    ///
    /// # Errors
    /// The fault of an `interrupt`: the whole run must end.
    pub fn interrupt<R: Run>(&mut self, cx: &mut Cx<'_, R>) -> Result<(), Fault>
    where
        P: Plan<R::Env>,
    {
        let result = self.level.interrupt_active(&self.tables, cx);
        self.level.plan.end();
        result
    }

    /// Commits what is staged from outside.
    pub(crate) fn commit<R: Run>(&mut self, author: Author, cx: &mut Cx<'_, R>) {
        self.level.commit(author, cx);
    }
}

impl<P: PlanState + Clone> Clone for Machine<P> {
    fn clone(&self) -> Self {
        let Level { plan, slots, active, due } = &self.level;
        let level = Level { plan: plan.clone(), slots: slots.clone(), active: *active, due: *due };
        Machine { tables: self.level.plan.tables(), level }
    }
}

impl<P: PlanState> Level<P> {
    fn start<R: Run>(&mut self, t: &P::Tables, cx: &mut Cx<'_, R>) -> Flow
    where
        P: Plan<R::Env>,
    {
        self.active = None;
        self.due = Instant::MAX;
        if let Err(why) = self.plan.initialise() {
            // The values are the plan's own, whoever was called before.
            cx.step.called = cx.place.plan;
            let fault = cx.note(why);
            // A sub-plan's fault is traced by the plan that uses it, as any that ends it.
            match cx.place.plan {
                plan @ ComponentId(0) => cx.failed(plan, fault),
                sub_plan => drop(cx.note_failure(sub_plan, fault)),
            }
            return self.end(Ending::Error(fault), cx);
        }
        self.trace_entries(t, cx);
        for supervisor in (0..t.table().globals).map(SupervisorId) {
            if let Err(fault) = self.start_supervisor(t, supervisor, cx) {
                return self.end(Ending::Error(fault), cx);
            }
        }
        match self.enter(t, t.table().start, cx) {
            Ok(None) => Flow::Running(self.wake(t)),
            Ok(Some(edge)) => self.follow(t, edge, cx),
            Err(stop) => self.stop(stop, cx),
        }
    }

    #[inline]
    fn step<R: Run>(&mut self, t: &P::Tables, cx: &mut Cx<'_, R>) -> Flow
    where
        P: Plan<R::Env>,
    {
        let Some(element) = self.active else { return Flow::Fatal(Fault::INTERNAL) };
        P::at_element(element, StepAt { level: self, t, cx })
    }

    /// A step while an element is active.
    #[inline(always)]
    fn step_element<R: Run>(
        &mut self,
        t: &P::Tables,
        element: ElementId,
        cx: &mut Cx<'_, R>,
    ) -> Flow
    where
        P: Plan<R::Env>,
    {
        let Some(row) = t.table().element(element) else { return Flow::Fatal(Fault::INTERNAL) };
        let wake = match self.sweep(t, element, row, cx) {
            Seen::Nothing(wake) => wake,
            Seen::Something(found) => return self.interrupted(t, element, row, found, cx),
        };
        if self.due > cx.now {
            return Flow::Running(wake.min(self.due));
        }
        let id = component(cx, element);
        cx.place.component = id;
        match cx.call(id, |cx| self.plan.poll_element(element, cx)) {
            Polled::Pending => {
                self.due = next_on_grid(self.due, row, cx.now);
                Flow::Running(wake.min(self.due))
            }
            Polled::SubPlan(Flow::Running(due)) => {
                self.due = due;
                Flow::Running(wake.min(due))
            }
            polled => self.left(t, element, row, polled, cx),
        }
    }

    fn stop<R: Run>(&mut self, stop: Stop, cx: &mut Cx<'_, R>) -> Flow
    where
        P: Plan<R::Env>,
    {
        match stop {
            Stop::Plan(ending) => self.end(ending, cx),
            Stop::Run(fault) => Flow::Fatal(fault),
        }
    }

    fn end<R: Run>(&mut self, ending: Ending, cx: &mut Cx<'_, R>) -> Flow
    where
        P: Plan<R::Env>,
    {
        self.active = None;
        self.plan.discard();
        self.plan.end();
        cx.step.passed_on = matches!(ending, Ending::Error(_));
        if R::Sink::ENABLED {
            cx.sink.record(cx.now, &Record::Ended { plan: cx.place.plan, ending });
        }
        Flow::Ended(ending)
    }

    #[inline]
    fn commit<R: Run>(&mut self, author: Author, cx: &mut Cx<'_, R>) {
        cx.step.commits = cx.step.commits.wrapping_add(1);
        self.plan.commit(&mut Committer {
            sink: &mut *cx.sink,
            at: cx.now,
            author,
            entries: cx.place.entries,
            number: cx.step.commits,
        });
    }

    fn trace_entries<R: Run>(&mut self, t: &P::Tables, cx: &mut Cx<'_, R>) {
        if !R::Sink::ENABLED {
            return;
        }
        let mut committer = Committer {
            sink: &mut *cx.sink,
            at: cx.now,
            author: Author::Component(cx.place.plan),
            entries: cx.place.entries,
            number: cx.step.commits,
        };
        for entry in 0..t.table().entries {
            match self.plan.entry(entry) {
                afp_types::ValueRef::Unset => {}
                value => committer.wrote(entry, afp_types::ValueRef::Unset, value),
            }
        }
    }

    /// The next instant at which anything of this level is due.
    fn wake(&self, t: &P::Tables) -> Instant {
        let row = self.active.and_then(|element| t.table().element(element));
        let sweep = row.map_or(&[][..], |row| t.table().sweep(row));
        let slots = sweep.iter().filter_map(|id| self.slots.as_ref().get(slot(t, *id)?));
        slots.map(|slot: &Slot| slot.next).fold(self.due, Instant::min)
    }
}

/// The slot of a row of a supervisor.
fn slot(t: &impl Tables, row: u16) -> Option<usize> {
    t.table().supervisor(row).map(|row| usize::from(row.slot))
}

/// The id of an element.
#[inline]
fn component<R: Run>(cx: &Cx<'_, R>, element: ElementId) -> ComponentId {
    ComponentId(cx.place.components.saturating_add(u32::from(element.0)))
}

/// The id of a supervisor.
#[inline]
fn supervisor_id<R: Run>(t: &impl Tables, cx: &Cx<'_, R>, supervisor: SupervisorId) -> ComponentId {
    let elements = t.table().elements.len() as u32;
    let number = elements.saturating_add(u32::from(supervisor.0));
    ComponentId(cx.place.components.saturating_add(number))
}

/// The next poll of an actor, on the grid of its period; polls that passed are skipped.
#[inline]
fn next_on_grid(due: Instant, row: &ElementRow, now: Instant) -> Instant {
    let next = due + row.period;
    if next > now { next } else { skip(due, row, now) }
}

#[cold]
fn skip(due: Instant, row: &ElementRow, now: Instant) -> Instant {
    let period = row.period.max(Duration::from_nanos(1));
    due + period * ((now - due).periods(period) + 1)
}
