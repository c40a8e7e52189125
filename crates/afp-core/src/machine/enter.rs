//! Entering an element: its supervisors start, all due supervisors are polled (the look), then the
//! element starts.

use super::sweep::{Found, Moment, What};
use super::{Edge, Flow, Stepping, Stop};
use crate::clock::Clock;
use crate::component::Environment;
use crate::fault::Fault;
use crate::rt::{ElementKind, ElementRow, Plan, Run, Started, Tables};
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
        let slot = self.slot(supervisor.0).unwrap_or(usize::MAX);
        if let Some(slot) = self.level.slots.as_mut().get_mut(slot) {
            slot.next = self.cx.now;
        }
        let id = self.supervisor_id(supervisor);
        self.cx.place.component = id;
        let result = self.cx.call(id, |cx| self.level.plan.start_supervisor(supervisor, cx));
        match result {
            Ok(()) => self.cx.trace(&Record::Started { component: id }),
            Err(fault) => self.cx.failed(id, fault),
        }
        result
    }

    /// Polls before the start: due global supervisors first, then the element's own.
    fn look(&mut self, element: ElementId, row: &ElementRow) -> Option<Found> {
        let moment = Moment { element, look: true };
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

    /// The look found a reason not to start.
    fn diverted(
        &mut self,
        element: ElementId,
        row: &ElementRow,
        found: Found,
    ) -> Result<Edge, Stop> {
        let supervisor = self.supervisor_id(found.supervisor);
        match found.what {
            What::Event(event, _) => {
                let element = self.component(element);
                self.cx.trace(&Record::Event { supervisor, event, element });
                self.cx.trace(&Record::Diverted { element, supervisor, event });
            }
            What::Leads(_, Err(Stop::Run(fault))) => return Err(Stop::Run(fault)),
            What::Leads(event, _) => {
                let element = self.component(element);
                self.cx.trace(&Record::Diverted { element, supervisor, event });
            }
            What::Fault(fault) => {
                self.level.plan.discard();
                self.cx.failed(supervisor, fault);
            }
        }
        self.after_supervisor(element, row, found)
    }

    /// Reads the inputs and starts the element.
    fn start_element(
        &mut self,
        element: ElementId,
        row: &ElementRow,
    ) -> Result<Option<Edge>, Stop> {
        let id = self.component(element);
        self.cx.place.component = id;
        match self.cx.call(id, |cx| self.level.plan.start_element(element, cx)) {
            Started::Running => {
                self.cx.trace(&Record::Started { component: id });
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
            Started::SubPlan(Flow::Ended(_)) => Err(Stop::Run(Fault::INTERNAL)),
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
