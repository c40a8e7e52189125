//! Returning to an element that was set aside: its supervisors continue or start again, then the
//! look, then the element continues or starts.
//!
//! The elements inside a sub-plan return in the same way, outer plans first.

use super::leave::after_fault;
use super::{Edge, Flow, Stepping, Stop};
use crate::fault::Fault;
use crate::rt::{Aside, ElementKind, ElementRow, OnReturn, Plan, Run, Started, Tables};
use crate::trace::{Ending, Record};
use afp_types::{Duration, ElementId, SupervisorId};
use core::mem::take;

impl<R: Run, P: Plan<R::Env>> Stepping<'_, '_, P, R> {
    /// Follows an edge to `return`. `None` if the element is active again, otherwise the edge by
    /// which it was left.
    pub(super) fn give_back(&mut self) -> Result<Option<Edge>, Stop> {
        let Some(aside) = self.level.aside.get() else { return Err(Stop::Run(Fault::INTERNAL)) };
        let (element, now) = (aside.element, self.cx.now);
        let Some(row) = self.t.table().element(element) else {
            return Err(Stop::Run(Fault::INTERNAL));
        };
        let mut ready = if aside.started { self.pass_live(element, row) } else { Ok(()) };
        if ready.is_ok() {
            ready = self.wake_supervisors(row.locals.supervisors(), aside.by, now - aside.silent);
        }
        if let Err(fault) = ready {
            return self.give_up(row, fault).map(Some);
        }
        if let Some(found) = self.look(element, row) {
            return self.diverted(element, row, found).map(Some);
        }
        if !aside.started {
            self.level.aside.set(None);
            return self.start_element(element, row);
        }
        match self.resume_element(element, row, now - aside.since) {
            Ok(started) => {
                self.level.aside.set(None);
                self.returned(element, row, started, now - aside.since)
            }
            Err(fault) => self.give_up(row, fault).map(Some),
        }
    }

    /// The element that is set aside cannot continue: it is given up and takes its `Error` edge.
    pub(super) fn give_up(&mut self, row: &ElementRow, fault: Fault) -> Result<Edge, Stop> {
        self.abandon().map_err(Stop::Run)?;
        after_fault(row, fault)
    }

    /// Continues a sub-plan that was suspended `away` ago.
    pub(super) fn resume_level(&mut self, away: Duration) -> Flow {
        let Some(element) = self.level.active else { return Flow::Fatal(Fault::INTERNAL) };
        let Some(row) = self.t.table().element(element) else {
            return Flow::Fatal(Fault::INTERNAL);
        };
        let globals = (0..self.t.table().globals).map(SupervisorId);
        if let Err(fault) = self.wake_supervisors(globals, None, away) {
            return match self.interrupt_active() {
                Ok(()) => self.end(Ending::Error(fault)),
                Err(fault) => Flow::Fatal(fault),
            };
        }
        match self.resume_active(element, row, away).transpose() {
            None => Flow::Running(self.wake()),
            Some(edge) => self.follow(edge),
        }
    }

    /// As [`Stepping::give_back`], for the active element of a sub-plan.
    pub(super) fn resume_active(
        &mut self,
        element: ElementId,
        row: &ElementRow,
        away: Duration,
    ) -> Result<Option<Edge>, Stop> {
        let mut ready = self.pass_live(element, row);
        if ready.is_ok() {
            ready = self.wake_supervisors(row.locals.supervisors(), None, away);
        }
        if ready.is_ok()
            && let Some(found) = self.look(element, row)
        {
            return self.stopped(element, row, found, Some(away)).map(Some);
        }
        if P::HOLDS && ready.is_ok() && take(&mut self.level.restarts) {
            self.level.active = None;
            return self.start_element(element, row);
        }
        match ready.and_then(|()| self.resume_element(element, row, away)) {
            Ok(started) => {
                self.level.active = None;
                self.returned(element, row, started, away)
            }
            Err(fault) => {
                self.interrupt_active().map_err(Stop::Run)?;
                after_fault(row, fault).map(Some)
            }
        }
    }

    /// Passes the live inputs of a sub-plan.
    fn pass_live(&mut self, element: ElementId, row: &ElementRow) -> Result<(), Fault> {
        if row.kind != ElementKind::SubPlan {
            return Ok(());
        }
        let id = self.component(element);
        self.cx.place.component = id;
        let result = self.cx.call(id, |cx| self.level.plan.refresh_element(element, cx));
        result.inspect_err(|fault| self.cx.failed(id, *fault))
    }

    /// Continues supervisors that were silent for this time, or starts them again. All are due
    /// immediately.
    fn wake_supervisors(
        &mut self,
        supervisors: impl Iterator<Item = SupervisorId>,
        by: Option<SupervisorId>,
        silent: Duration,
    ) -> Result<(), Fault> {
        for supervisor in supervisors {
            if by == Some(supervisor) || !self.continues(supervisor, silent)? {
                self.start_supervisor(supervisor)?;
            }
        }
        Ok(())
    }

    /// Whether a supervisor continues.
    fn continues(&mut self, supervisor: SupervisorId, away: Duration) -> Result<bool, Fault> {
        let id = self.supervisor_id(supervisor);
        self.cx.place.component = id;
        match self.cx.call(id, |cx| self.level.plan.resume_supervisor(supervisor, away, cx)) {
            Ok(OnReturn::Continues) => {
                self.due_now(supervisor);
                self.cx.trace(&Record::Returned { component: id, away });
                Ok(true)
            }
            Ok(OnReturn::Restarts) => Ok(false),
            Err(fault) => {
                self.cx.failed(id, fault);
                Err(fault)
            }
        }
    }

    /// Calls `resume` of an element. The error is the fault of an actor, which must be interrupted.
    fn resume_element(
        &mut self,
        element: ElementId,
        row: &ElementRow,
        away: Duration,
    ) -> Result<Started, Fault> {
        let id = self.component(element);
        self.cx.place.component = id;
        match self.cx.call(id, |cx| self.level.plan.resume_element(element, away, cx)) {
            Started::Failed(fault) if row.kind == ElementKind::Actor => {
                self.cx.failed(id, fault);
                Err(fault)
            }
            started => Ok(started),
        }
    }

    /// Handles the result of `resume`.
    fn returned(
        &mut self,
        element: ElementId,
        row: &ElementRow,
        started: Started,
        away: Duration,
    ) -> Result<Option<Edge>, Stop> {
        let component = self.component(element);
        self.begun(element, row, started, &Record::Returned { component, away })
    }
}
