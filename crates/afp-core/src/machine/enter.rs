//! Entering an element: its supervisors start, all due supervisors are polled (the look), then the
//! element starts.

use super::sweep::{Found, Moment, Occasion, What};
use super::{Edge, Flow, Stepping, Stop};
use crate::clock::Clock;
use crate::component::Environment;
use crate::fault::Fault;
use crate::rt::{Aside, ElementKind, ElementRow, Plan, Run, Started, Tables};
use crate::trace::Record;
use afp_types::{ElementId, SupervisorId};

impl<R: Run, P: Plan<R::Env>> Stepping<'_, '_, P, R> {
    /// Enters an element. `None` if it is now active, otherwise the edge by which it was left.
    pub(super) fn enter(&mut self, element: ElementId) -> Result<Option<Edge>, Stop> {
        let Some(row) = self.t.table().element(element) else {
            return Err(Stop::Run(Fault::INTERNAL));
        };
        if row.kind != ElementKind::Computation {
            for local in row.locals.supervisors() {
                if let Err(fault) = self.start_supervisor(local) {
                    return self.error_edge(element, row, fault).map(Some);
                }
            }
            if let Some(found) = self.look(element, row) {
                return self.diverted(element, row, found).map(Some);
            }
        }
        self.start_element(element, row)
    }

    /// Starts a supervisor; it is due immediately.
    pub(super) fn start_supervisor(&mut self, supervisor: SupervisorId) -> Result<(), Fault> {
        self.due_now(supervisor);
        let id = self.supervisor_id(supervisor);
        self.cx.place.component = id;
        let result = self.cx.call(id, |cx| self.level.plan.start_supervisor(supervisor, cx));
        match result {
            Ok(()) => self.cx.trace(&Record::Started { component: id }),
            Err(fault) => self.cx.failed(id, fault),
        }
        result
    }

    /// Makes a supervisor due; its releases count from now.
    pub(super) fn due_now(&mut self, supervisor: SupervisorId) {
        let slot = self.slot(supervisor.0).unwrap_or(usize::MAX);
        if let Some(slot) = self.level.slots.as_mut().get_mut(slot) {
            slot.next = self.cx.now;
        }
    }

    /// Polls before the start: due global supervisors first, then the element's own.
    pub(super) fn look(&mut self, element: ElementId, row: &ElementRow) -> Option<Found> {
        let moment = Moment { element, occasion: Occasion::Look };
        // Includes the time of everything that ran since the last poll of a supervisor.
        self.cx.step.clock = self.cx.clock.now(self.cx.now);
        for global in [true, false] {
            for &row in self.t.table().sweep(row) {
                let Some(row) = self.t.table().supervisor(row) else { continue };
                let supervisor = row.instance;
                if self.t.table().is_global(supervisor) != global {
                    continue;
                }
                if let Err(what) = self.poll_if_due(row, moment) {
                    return Some(Found { supervisor, what });
                }
            }
        }
        None
    }

    /// The look found a reason not to start, or not to return.
    pub(super) fn diverted(
        &mut self,
        element: ElementId,
        row: &ElementRow,
        found: Found,
    ) -> Result<Edge, Stop> {
        self.trace_found(element, &found)?;
        let aside = self.level.aside.get().is_some_and(|aside| aside.element == element);
        if self.suspends(row, &found) {
            return match aside {
                true => self.suspend_again(found),
                false => self.set_aside(element, found, (self.cx.now, false)),
            };
        }
        if let What::Event(event, _) | What::Leads(event, _) = found.what {
            let supervisor = self.supervisor_id(found.supervisor);
            let element = self.component(element);
            self.cx.trace(&Record::Diverted { element, supervisor, event });
        }
        if !aside {
            self.level.plan.leave(element);
        } else if let What::Fault(fault) = found.what
            && !self.t.table().is_global(found.supervisor)
        {
            return self.give_up(row, fault);
        }
        self.after_supervisor(row, found)
    }

    /// Reads the inputs and starts the element.
    pub(super) fn start_element(
        &mut self,
        element: ElementId,
        row: &ElementRow,
    ) -> Result<Option<Edge>, Stop> {
        let id = self.component(element);
        self.cx.place.component = id;
        let started = self.cx.call(id, |cx| self.level.plan.start_element(element, cx));
        self.begun(element, row, started, &Record::Started { component: id })
    }

    /// Handles the result of a start, which `record` traces for an actor.
    pub(super) fn begun(
        &mut self,
        element: ElementId,
        row: &ElementRow,
        started: Started,
        record: &Record<'_>,
    ) -> Result<Option<Edge>, Stop> {
        match started {
            Started::Running => {
                self.cx.trace(record);
                self.level.active = Some(element);
                self.level.due = self.cx.now + row.period;
                Ok(None)
            }
            Started::SubPlan(Flow::Running(due)) => {
                self.level.active = Some(element);
                self.level.due = due;
                Ok(None)
            }
            Started::SubPlan(Flow::Fatal(fault)) => Err(Stop::Run(fault)),
            Started::SubPlan(Flow::Ended(_) | Flow::Held(_)) => Err(Stop::Run(Fault::INTERNAL)),
            Started::Done(state) => self.finished(element, row, state).map(Some),
            Started::Failed(fault) => self.start_failed(element, row, fault).map(Some),
        }
    }

    /// Stops the platform, since nothing runs, and takes the element's `Error` edge.
    fn start_failed(
        &mut self,
        element: ElementId,
        row: &ElementRow,
        fault: Fault,
    ) -> Result<Edge, Stop> {
        self.level.plan.discard();
        let id = self.component(element);
        self.cx.failed(id, fault);
        if row.kind == ElementKind::Actor {
            self.cx.step.called = self.cx.place.plan;
            self.cx.env.stop(self.cx.now);
        }
        self.error_edge(element, row, fault)
    }
}
