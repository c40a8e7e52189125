//! A hold of the outermost plan by a debugger.
//!
//! The active element is suspended, or the plan holds between two elements. Meanwhile only the
//! global supervisors of the outermost plan are polled, and only events that end the plan are
//! taken.

use super::sweep::{Found, Moment, Occasion, ends};
use super::{Edge, Machine, Stepping, Stop};
use crate::component::Environment;
use crate::fault::Fault;
use crate::rt::{
    Aside, Cx, ElementKind, Flow, Hold, Kept, Plan, PlanState, Run, Stops, SupervisorRow, Tables,
    Target,
};
use crate::trace::{ComponentId, Ending, Record};
use afp_types::{Duration, ElementId, Events, Instant};
use core::mem::take;

/// The period of [`Environment::hold`].
const PERIOD: Duration = Duration::from_millis(10);

impl<P: PlanState> Machine<P> {
    /// Suspends the active element at the beginning of a step, and holds.
    pub(crate) fn hold<R: Run>(&mut self, cx: &mut Cx<'_, R>) -> Flow
    where
        P: Plan<R::Env>,
    {
        self.stepping(cx).hold_active()
    }

    /// Performs all due work of a held plan.
    pub(crate) fn step_held<R: Run>(&mut self, cx: &mut Cx<'_, R>) -> Flow
    where
        P: Plan<R::Env>,
    {
        self.stepping(cx).step_held()
    }

    /// Continues after a hold.
    pub(crate) fn release<R: Run>(&mut self, cx: &mut Cx<'_, R>) -> Flow
    where
        P: Plan<R::Env>,
    {
        self.stepping(cx).release()
    }

    /// Interrupts and drops the element that is held, if any.
    ///
    /// # Errors
    /// A failed interrupt ends the whole run.
    pub(crate) fn abandon_held<R: Run>(&mut self, cx: &mut Cx<'_, R>) -> Result<(), Fault>
    where
        P: Plan<R::Env>,
    {
        self.stepping(cx).abandon_held()
    }
}

impl<R: Run, P: Plan<R::Env>> Stepping<'_, '_, P, R> {
    fn hold_active(&mut self) -> Flow {
        let Some(element) = self.level.active else { return Flow::Fatal(Fault::INTERNAL) };
        let Some(row) = self.t.table().element(element) else {
            return Flow::Fatal(Fault::INTERNAL);
        };
        match self.suspend_element(element) {
            Ok(Kept::Broken(fault)) => return Flow::Fatal(fault),
            Ok(Kept::Yes | Kept::No) => {}
            Err(fault) => {
                let edge = self.not_suspended(element, row, fault);
                self.cx.step.stops = Stops::Next;
                return self.follow(edge);
            }
        }
        self.begin_hold(element, None)
    }

    /// Holds before an edge is followed to an element, if the plan must stop there.
    #[inline]
    pub(super) fn held_before(&mut self, edge: Edge) -> Option<Flow> {
        if !P::HOLDS || self.cx.step.stops == Stops::Never || self.cx.place.plan != ComponentId(0) {
            return None;
        }
        self.seldom().stop_before(edge)
    }

    #[cold]
    fn stop_before(&mut self, edge: Edge) -> Option<Flow> {
        let target = edge.target?;
        let element = self.entered_by(target)?;
        if self.cx.step.stops == Stops::AfterNext {
            self.cx.step.stops = Stops::Next;
            return None;
        }
        Some(self.begin_hold(element, Some((target, edge.ending))))
    }

    /// The element that an edge enters or returns to; computations take no time.
    fn entered_by(&self, target: Target) -> Option<ElementId> {
        let element = match target {
            Target::Element(element) | Target::Suspend(element) => element,
            Target::Return => self.level.aside.get()?.element,
            Target::Terminate | Target::Fail(_) | Target::Ignore | Target::Resume => return None,
        };
        let row = self.t.table().element(element)?;
        (row.kind != ElementKind::Computation).then_some(element)
    }

    fn begin_hold(&mut self, element: ElementId, pending: Option<(Target, Ending)>) -> Flow {
        let started = pending.is_none() && !self.level.restarts;
        let id = self.component(element);
        self.cx.trace(&Record::Held { element: id, started });
        self.cx.step.stops = Stops::Never;
        let now = self.cx.now;
        self.cx.step.hold = Some(Hold { since: now, next: now, pending });
        self.step_held()
    }

    fn step_held(&mut self) -> Flow {
        let Some(element) = self.held_element() else { return Flow::Fatal(Fault::INTERNAL) };
        let Some(row) = self.t.table().element(element) else {
            return Flow::Fatal(Fault::INTERNAL);
        };
        let next = self.stand();
        let mut wake = next;
        let moment = Moment { element, occasion: Occasion::Hold };
        for &row in self.t.table().sweep(row) {
            let Some(row) = self.t.table().supervisor(row) else { continue };
            if !self.t.table().is_global(row.instance) {
                continue;
            }
            match self.poll_if_due(row, moment) {
                Ok(next) => wake = wake.min(next),
                Err(what) => {
                    return self.end_held(element, Found { supervisor: row.instance, what });
                }
            }
        }
        Flow::Held(wake)
    }

    /// Keeps the robot stationary; returns when it must be called again.
    fn stand(&mut self) -> Instant {
        let now = self.cx.now;
        let Some(hold) = &mut self.cx.step.hold else { return now };
        if hold.next <= now {
            hold.next = now + PERIOD;
            self.cx.step.called = self.cx.place.plan;
            self.cx.env.hold(now);
        }
        hold.next
    }

    /// The element that was suspended, or that is entered on release.
    fn held_element(&self) -> Option<ElementId> {
        match self.cx.step.hold?.pending {
            None => self.level.active,
            Some((target, _)) => self.entered_by(target),
        }
    }

    /// A global supervisor ends the plan while it is held.
    fn end_held(&mut self, element: ElementId, found: Found) -> Flow {
        let Some(row) = self.t.table().element(element) else {
            return Flow::Fatal(Fault::INTERNAL);
        };
        let edge = self.trace_found(element, &found).and_then(|()| {
            self.abandon_held().map_err(Stop::Run)?;
            self.after_supervisor(row, found)
        });
        self.follow(edge)
    }

    fn abandon_held(&mut self) -> Result<(), Fault> {
        if !P::HOLDS {
            return Ok(());
        }
        let Some(_) = self.cx.step.hold.take() else { return Ok(()) };
        let Some(element) = self.level.active.take() else { return Ok(()) };
        let started = !take(&mut self.level.restarts);
        let result = if started { self.interrupt_element(element) } else { Ok(()) };
        self.level.plan.leave(element);
        result?;
        let element = self.component(element);
        self.cx.trace(&Record::Abandoned { element, started });
        Ok(())
    }

    fn release(&mut self) -> Flow {
        let Some(element) = self.held_element() else { return Flow::Fatal(Fault::INTERNAL) };
        let Some(row) = self.t.table().element(element) else {
            return Flow::Fatal(Fault::INTERNAL);
        };
        let Some(Hold { since, pending, .. }) = self.cx.step.hold.take() else {
            return Flow::Fatal(Fault::INTERNAL);
        };
        let id = self.component(element);
        self.cx.trace(&Record::Released { element: id });
        match pending {
            Some((target, ending)) => self.follow(Ok(Edge { target: Some(target), ending })),
            None => match self.resume_active(element, row, self.cx.now - since).transpose() {
                None => Flow::Running(self.wake()),
                Some(edge) => self.follow(edge),
            },
        }
    }

    /// The events that are taken while the plan is held.
    pub(super) fn wanted_in_hold(&self, row: &SupervisorRow) -> Events {
        let table = self.t.table();
        let bits = (0..row.events.len.min(64))
            .filter(|event| table.edge(row.events, *event).is_some_and(ends))
            .fold(0, |bits, event| bits | 1 << event);
        Events::from_bits(bits)
    }
}
