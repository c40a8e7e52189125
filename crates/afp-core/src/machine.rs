//! The scheduler of one level: a plan or a sub-plan.
//!
//! ```text
//!            start ---> enter(first element)
//!
//!   step:    sweep the supervisors in their fixed order
//!              an event is taken   -> interrupt, commit, follow
//!              ... that suspends   -> suspend, commit, set aside, follow
//!              ... that may resume -> commit, compute; go on, or interrupt and follow
//!            else poll the active element, if due
//!              it reached a state  -> commit, follow
//!              it failed           -> interrupt, follow its `Error` edge
//!
//!   follow:  take edges until an element is active or the plan ends
//!              `return`            -> wake the supervisors, look, resume the set-aside element
//!   enter:   start its supervisors, look, read its inputs, start it
//! ```
//!
//! A held plan ([`hold`]) does not step: its active element is suspended until the release.
//!
//! A sub-plan is an element whose poll is the step of its own machine. Outer plans are polled
//! first; the innermost element is interrupted first.

mod aside;
mod at;
mod enter;
mod give_back;
mod held;
mod hold;
mod leave;
mod sweep;

use crate::fault::Fault;
use crate::rt::{
    Aside, Committer, Cx, ElementRow, Flow, Kept, Plan, PlanState, Polled, Run, Slot, Tables,
    Target,
};
use crate::trace::{Author, ComponentId, Ending, Record, Sink};
use afp_types::{Duration, ElementId, Instant, SupervisorId};
use at::Stepping;
use sweep::Seen;

/// A plan, its rows and its scheduling state.
pub struct Machine<P: PlanState> {
    tables: P::Tables,
    level: Level<P>,
}

/// A machine without the rows, which are borrowed separately.
struct Level<P: PlanState> {
    plan: P,
    slots: P::Slots,
    active: Option<ElementId>,
    due: Instant,
    /// Whether the active actor was interrupted because it cannot be suspended: it starts again.
    restarts: bool,
    /// The element that is set aside while a handler is active.
    aside: P::Aside,
}

#[derive(Clone, Copy)]
struct Edge {
    target: Option<Target>,
    /// The ending if the edge leads to `terminate`.
    ending: Ending,
}

/// Reasons why following an edge ends without an active element.
#[derive(Clone, Copy)]
enum Stop {
    Plan(Ending),
    Run(Fault),
}

impl<P: PlanState> Machine<P> {
    /// A machine that has not started.
    pub fn new(plan: P) -> Self {
        let (tables, slots) = (plan.tables(), plan.slots());
        let (active, due, restarts) = (None, Instant::MAX, false);
        let aside = P::Aside::default();
        Machine { tables, level: Level { plan, slots, active, due, restarts, aside } }
    }

    /// A copy that runs independently; `None` if a component cannot be copied.
    pub fn try_clone(&self) -> Option<Self> {
        let plan = self.level.plan.try_clone()?;
        Some(Machine { tables: plan.tables(), level: self.level.with(plan) })
    }

    /// The plan.
    pub fn plan(&self) -> &P {
        &self.level.plan
    }

    /// Unwraps the plan.
    pub fn into_plan(self) -> P {
        self.level.plan
    }

    /// Access for setting entries before the start.
    pub fn plan_mut(&mut self) -> &mut P {
        &mut self.level.plan
    }

    /// Position of the active element; `None` before the start and after the end.
    pub fn active(&self) -> Option<ElementId> {
        self.level.active
    }

    /// Starts or restarts: initial values, global supervisors, first element.
    pub fn start<R: Run>(&mut self, cx: &mut Cx<'_, R>) -> Flow
    where
        P: Plan<R::Env>,
    {
        self.stepping(cx).start()
    }

    /// Performs all due work.
    #[inline]
    pub fn step<R: Run>(&mut self, cx: &mut Cx<'_, R>) -> Flow
    where
        P: Plan<R::Env>,
    {
        self.stepping(cx).step()
    }

    /// Interrupts the active elements, innermost first, and drops all components.
    ///
    /// # Errors
    /// The fault of an `interrupt`: the whole run must end.
    pub fn interrupt<R: Run>(&mut self, cx: &mut Cx<'_, R>) -> Result<(), Fault>
    where
        P: Plan<R::Env>,
    {
        let mut stepping = self.stepping(cx);
        let result = stepping.interrupt_active().and_then(|()| stepping.abandon());
        self.level.plan.end();
        result
    }

    /// Suspends the active elements, innermost first. An actor that cannot be suspended is
    /// interrupted. Nothing is called until [`Machine::resume`] or [`Machine::interrupt`].
    ///
    /// # Errors
    /// The fault of an actor: the sub-plan must be interrupted.
    pub fn suspend<R: Run>(&mut self, cx: &mut Cx<'_, R>) -> Result<Kept, Fault>
    where
        P: Plan<R::Env>,
    {
        self.stepping(cx).suspend_level()
    }

    /// Continues after a suspension `away` ago, outer plans first.
    pub fn resume<R: Run>(&mut self, away: Duration, cx: &mut Cx<'_, R>) -> Flow
    where
        P: Plan<R::Env>,
    {
        self.stepping(cx).resume_level(away)
    }

    /// Commits writes from outside.
    pub(crate) fn commit<R: Run>(&mut self, author: Author, cx: &mut Cx<'_, R>)
    where
        P: Plan<R::Env>,
    {
        self.stepping(cx).commit(author);
    }

    #[inline(always)]
    fn stepping<'a, 'c, R: Run>(&'a mut self, cx: &'a mut Cx<'c, R>) -> Stepping<'a, 'c, P, R> {
        Stepping { level: &mut self.level, t: &self.tables, cx }
    }
}

impl<P: PlanState + Clone> Clone for Machine<P> {
    fn clone(&self) -> Self {
        let plan = self.level.plan.clone();
        Machine { tables: plan.tables(), level: self.level.with(plan) }
    }
}

impl<P: PlanState> Level<P> {
    /// The same state with a copy of the plan.
    fn with(&self, plan: P) -> Self {
        let (slots, aside) = (self.slots.clone(), self.aside.clone());
        let Level { active, due, restarts, .. } = *self;
        Level { plan, slots, active, due, restarts, aside }
    }
}

impl<'c, R: Run, P: Plan<R::Env>> Stepping<'_, 'c, P, R> {
    fn start(&mut self) -> Flow {
        self.level.active = None;
        self.level.due = Instant::MAX;
        self.level.restarts = false;
        self.level.aside.set(None);
        if let Err(why) = self.level.plan.initialise() {
            // The values belong to the plan, whichever component was called last.
            self.cx.step.called = self.cx.place.plan;
            let fault = self.cx.note(why);
            // The outer plan traces a sub-plan's fault.
            match self.cx.place.plan {
                plan @ ComponentId(0) => self.cx.failed(plan, fault),
                sub_plan => drop(self.cx.note_failure(sub_plan, fault)),
            }
            return self.end(Ending::Error(fault));
        }
        self.trace_entries();
        for supervisor in (0..self.t.table().globals).map(SupervisorId) {
            if let Err(fault) = self.start_supervisor(supervisor) {
                return self.end(Ending::Error(fault));
            }
        }
        let start = self.level.plan.begins_at().unwrap_or(self.t.table().start);
        let first = Edge { target: Some(Target::Element(start)), ending: Ending::Ok };
        if let Some(held) = self.held_before(first) {
            return held;
        }
        match self.enter(start).transpose() {
            None => Flow::Running(self.wake()),
            Some(edge) => self.follow(edge),
        }
    }

    #[inline]
    fn step(self) -> Flow {
        let Some(element) = self.level.active else { return Flow::Fatal(Fault::INTERNAL) };
        P::at_element(element, self)
    }

    /// For functions that are seldom called. The copy hides its address, so that the hot path stays
    /// in registers.
    #[inline(always)]
    fn seldom(&mut self) -> Stepping<'_, 'c, P, R> {
        Stepping { level: &mut *self.level, t: self.t, cx: &mut *self.cx }
    }

    #[inline(always)]
    fn step_element(&mut self, element: ElementId) -> Flow {
        let Some(row) = self.t.table().element(element) else {
            return Flow::Fatal(Fault::INTERNAL);
        };
        let wake = match self.sweep(element, row) {
            Seen::Nothing(wake) => wake,
            Seen::Something(found) => return self.seldom().interrupted(element, row, found),
        };
        if self.level.due > self.cx.now {
            return Flow::Running(wake.min(self.level.due));
        }
        let id = self.component(element);
        self.cx.place.component = id;
        self.cx.calls(id);
        match self.level.plan.poll_element(element, self.cx) {
            Polled::Pending => {
                self.level.due = next_on_grid(self.level.due, row, self.cx.now);
                Flow::Running(wake.min(self.level.due))
            }
            Polled::SubPlan(Flow::Running(due)) => {
                self.level.due = due;
                Flow::Running(wake.min(due))
            }
            polled => self.seldom().left(element, row, polled),
        }
    }

    fn end(&mut self, ending: Ending) -> Flow {
        self.level.active = None;
        self.level.plan.discard();
        if let Err(fault) = self.abandon() {
            return Flow::Fatal(fault);
        }
        self.level.plan.end();
        self.cx.step.passed_on = matches!(ending, Ending::Error(_));
        if R::Sink::ENABLED {
            self.cx.sink.record(self.cx.now, &Record::Ended { plan: self.cx.place.plan, ending });
        }
        Flow::Ended(ending)
    }

    #[inline]
    fn commit(&mut self, author: Author) {
        self.cx.step.commits = self.cx.step.commits.wrapping_add(1);
        self.level.plan.commit(&mut Committer {
            sink: &mut *self.cx.sink,
            at: self.cx.now,
            author,
            entries: self.cx.place.entries,
            number: self.cx.step.commits,
        });
    }

    fn trace_entries(&mut self) {
        if !R::Sink::ENABLED {
            return;
        }
        let mut committer = Committer {
            sink: &mut *self.cx.sink,
            at: self.cx.now,
            author: Author::Component(self.cx.place.plan),
            entries: self.cx.place.entries,
            number: self.cx.step.commits,
        };
        for entry in 0..self.t.table().entries {
            match self.level.plan.entry(entry) {
                afp_types::ValueRef::Unset => {}
                value => committer.wrote(entry, afp_types::ValueRef::Unset, value),
            }
        }
    }

    /// The next instant at which this level has work due.
    fn wake(&self) -> Instant {
        let row = self.level.active.and_then(|element| self.t.table().element(element));
        let sweep = row.map_or(&[][..], |row| self.t.table().sweep(row));
        let slots = sweep.iter().filter_map(|id| self.level.slots.as_ref().get(self.slot(*id)?));
        slots.map(|slot: &Slot| slot.next).fold(self.level.due, Instant::min)
    }

    /// The slot of a supervisor's row.
    fn slot(&self, row: u16) -> Option<usize> {
        self.t.table().supervisor(row).map(|row| usize::from(row.slot))
    }

    #[inline]
    fn component(&self, element: ElementId) -> ComponentId {
        ComponentId(self.cx.place.components.saturating_add(u32::from(element.0)))
    }

    #[inline]
    fn supervisor_id(&self, supervisor: SupervisorId) -> ComponentId {
        let elements = self.t.table().elements.len() as u32;
        let number = elements.saturating_add(u32::from(supervisor.0));
        ComponentId(self.cx.place.components.saturating_add(number))
    }
}

/// The next poll of an actor, on the grid of its period; missed polls are skipped.
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
