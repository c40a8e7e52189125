//! Setting the active element aside for a handler, and giving it up.

use super::leave::after_fault;
use super::sweep::{Found, What};
use super::{Edge, Stepping, Stop};
use crate::fault::Fault;
use crate::rt::{Aside, ElementKind, ElementRow, Kept, Plan, Run, SetAside, Tables, Target};
use crate::trace::Record;
use afp_types::{Duration, ElementId, Instant};
use core::mem::take;

impl<R: Run, P: Plan<R::Env>> Stepping<'_, '_, P, R> {
    /// Whether a finding sets the element aside. A handler is never set aside by its own plan.
    pub(super) fn suspends(&self, row: &ElementRow, found: &Found) -> bool {
        let target = match found.what {
            What::Event(_, target) => Some(target),
            What::Leads(_, Ok(edge)) => edge.target,
            What::Leads(_, Err(_)) | What::Fault(_) => None,
        };
        P::Aside::USED && !row.handler && matches!(target, Some(Target::Suspend(_)))
    }

    /// Suspends the active element for an event, and sets it aside. `away` is the time since an
    /// earlier suspension that still holds. If the element cannot be suspended, it is interrupted
    /// and takes its `Error` edge.
    pub(super) fn suspend_active(
        &mut self,
        element: ElementId,
        row: &ElementRow,
        found: Found,
        away: Option<Duration>,
    ) -> Result<Edge, Stop> {
        if away.is_none() {
            match self.suspend_element(element) {
                Ok(Kept::Broken(fault)) => return Err(Stop::Run(fault)),
                Ok(Kept::Yes | Kept::No) => {}
                Err(fault) => return self.not_suspended(element, row, fault),
            }
        }
        self.level.active = None;
        let started = !(P::HOLDS && take(&mut self.level.restarts));
        let since = self.cx.now - away.unwrap_or(Duration::ZERO);
        self.set_aside(element, found, (since, started))
    }

    /// An element cannot be suspended: it is interrupted and takes its `Error` edge.
    pub(super) fn not_suspended(
        &mut self,
        element: ElementId,
        row: &ElementRow,
        fault: Fault,
    ) -> Result<Edge, Stop> {
        self.level.plan.discard();
        let id = self.component(element);
        self.cx.failed(id, fault);
        self.interrupt_active().map_err(Stop::Run)?;
        after_fault(row, fault)
    }

    /// Commits the event's outputs and sets an element aside, suspended since `since` or not
    /// started.
    pub(super) fn set_aside(
        &mut self,
        element: ElementId,
        found: Found,
        (since, started): (Instant, bool),
    ) -> Result<Edge, Stop> {
        let supervisor = self.supervisor_id(found.supervisor);
        let by = (!self.t.table().is_global(found.supervisor)).then_some(found.supervisor);
        let edge = self.edge_of(found)?;
        let silent = self.cx.now;
        self.level.aside.set(Some(SetAside { element, started, by, since, silent }));
        let element = self.component(element);
        self.cx.trace(&Record::Suspended { element, supervisor, started });
        Ok(edge)
    }

    /// An event in the look of a return: the element stays set aside, and a handler follows.
    pub(super) fn suspend_again(&mut self, found: Found) -> Result<Edge, Stop> {
        let by = (!self.t.table().is_global(found.supervisor)).then_some(found.supervisor);
        let edge = self.edge_of(found)?;
        let silent = self.cx.now;
        let aside = self.level.aside.get().map(|aside| SetAside { by, silent, ..aside });
        self.level.aside.set(aside);
        Ok(edge)
    }

    /// Suspends an element. In a hold, an actor that cannot be suspended is interrupted, and starts
    /// again on return.
    pub(super) fn suspend_element(&mut self, element: ElementId) -> Result<Kept, Fault> {
        let id = self.component(element);
        self.cx.place.component = id;
        let kept = self.cx.call(id, |cx| self.level.plan.suspend_element(element, cx))?;
        match kept {
            Kept::No if P::HOLDS => {}
            Kept::No => return Err(Fault::INTERNAL),
            Kept::Yes | Kept::Broken(_) => return Ok(kept),
        }
        // Before the call: no actor is interrupted twice.
        self.level.restarts = true;
        match self.interrupt_element(element) {
            Ok(()) => {
                self.cx.trace(&Record::Interrupted { element: id });
                Ok(Kept::No)
            }
            Err(fault) => Ok(Kept::Broken(fault)),
        }
    }

    /// Suspends the active element of a sub-plan that is set aside.
    ///
    /// # Errors
    /// The fault of the innermost actor, which is stored.
    pub(super) fn suspend_level(&mut self) -> Result<Kept, Fault> {
        let element = self.level.active.ok_or(Fault::INTERNAL)?;
        let result = self.suspend_element(element);
        if let Err(fault) = result {
            if self.t.table().element(element).is_some_and(|row| row.kind == ElementKind::Actor) {
                let id = self.component(element);
                self.cx.note_failure(id, fault);
            }
            // The outer plan fails for the same reason.
            self.cx.step.passed_on = true;
        }
        result.map(|kept| match kept {
            Kept::Broken(_) => kept,
            Kept::Yes | Kept::No => Kept::Yes,
        })
    }

    /// Gives up the element that is set aside before another element than a computation is entered.
    pub(super) fn abandon_before(&mut self, element: ElementId) -> Result<(), Fault> {
        match self.t.table().element(element) {
            Some(row) if row.kind == ElementKind::Computation => Ok(()),
            _ => self.abandon(),
        }
    }

    /// Interrupts and drops the element that is set aside, if any.
    ///
    /// # Errors
    /// A failed interrupt ends the whole run.
    pub(super) fn abandon(&mut self) -> Result<(), Fault> {
        let Some(aside) = self.level.aside.get() else { return Ok(()) };
        self.level.aside.set(None);
        let result = match aside.started {
            true => self.interrupt_element(aside.element),
            false => Ok(()),
        };
        self.level.plan.leave(aside.element);
        result?;
        let element = self.component(aside.element);
        self.cx.trace(&Record::Abandoned { element, started: aside.started });
        Ok(())
    }
}
