//! Entering an element: its supervisors start, all due supervisors are polled (the look), then it starts.

use super::sweep::{Found, Moment, What};
use super::{Edge, Flow, Level, Stop, component, slot, supervisor_id};
use crate::clock::Clock;
use crate::component::Environment;
use crate::fault::Fault;
use crate::rt::{Cx, ElementKind, ElementRow, Plan, PlanState, Run, Started, Tables};
use crate::trace::Record;
use afp_types::{ElementId, SupervisorId};

impl<P: PlanState> Level<P> {
    /// Enters an element. `None` when it is active now, else the edge by which it was left.
    pub(super) fn enter<R: Run>(
        &mut self,
        t: &P::Tables,
        element: ElementId,
        cx: &mut Cx<'_, R>,
    ) -> Result<Option<Edge>, Stop>
    where
        P: Plan<R::Env>,
    {
        let Some(row) = t.table().element(element) else { return Err(Stop::Run(Fault::INTERNAL)) };
        if row.kind != ElementKind::Computation {
            for local in row.locals.supervisors() {
                if let Err(fault) = self.start_supervisor(t, local, cx) {
                    return self.error_edge(element, row, fault).map(Some);
                }
            }
            if let Some(found) = self.look(t, element, row, cx) {
                return self.diverted(t, element, row, found, cx).map(Some);
            }
        }
        self.start_element(t, element, row, cx)
    }

    /// Starts a supervisor; it is due at once.
    pub(super) fn start_supervisor<R: Run>(
        &mut self,
        t: &P::Tables,
        supervisor: SupervisorId,
        cx: &mut Cx<'_, R>,
    ) -> Result<(), Fault>
    where
        P: Plan<R::Env>,
    {
        let slot = slot(t, supervisor.0).unwrap_or(usize::MAX);
        if let Some(slot) = self.slots.as_mut().get_mut(slot) {
            slot.next = cx.now;
        }
        let id = supervisor_id(t, cx, supervisor);
        cx.place.component = id;
        let result = cx.call(id, |cx| self.plan.start_supervisor(supervisor, cx));
        match result {
            Ok(()) => cx.trace(&Record::Started { component: id }),
            Err(fault) => cx.failed(id, fault),
        }
        result
    }

    /// Looks before the start: due global supervisors first, then the element's own.
    fn look<R: Run>(
        &mut self,
        t: &P::Tables,
        element: ElementId,
        row: &ElementRow,
        cx: &mut Cx<'_, R>,
    ) -> Option<Found>
    where
        P: Plan<R::Env>,
    {
        let moment = Moment { element, look: true };
        // Whatever ran since the last poll of a supervisor took its time too.
        cx.step.clock = cx.clock.now(cx.now);
        for global in [true, false] {
            for &row in t.table().sweep(row) {
                let Some(row) = t.table().supervisor(row) else { continue };
                let supervisor = row.instance;
                if t.table().is_global(supervisor) != global {
                    continue;
                }
                if let Err(what) = self.poll_if_due(t, row, moment, cx) {
                    return Some(Found { supervisor, what });
                }
            }
        }
        None
    }

    /// The look found a reason not to start.
    fn diverted<R: Run>(
        &mut self,
        t: &P::Tables,
        element: ElementId,
        row: &ElementRow,
        found: Found,
        cx: &mut Cx<'_, R>,
    ) -> Result<Edge, Stop>
    where
        P: Plan<R::Env>,
    {
        let supervisor = supervisor_id(t, cx, found.supervisor);
        match found.what {
            What::Event(event, _) => {
                let element = component(cx, element);
                cx.trace(&Record::Event { supervisor, event, element });
                cx.trace(&Record::Diverted { element, supervisor, event });
            }
            What::Leads(_, Err(Stop::Run(fault))) => return Err(Stop::Run(fault)),
            What::Leads(event, _) => {
                let element = component(cx, element);
                cx.trace(&Record::Diverted { element, supervisor, event });
            }
            What::Fault(fault) => {
                self.plan.discard();
                cx.failed(supervisor, fault);
            }
        }
        self.after_supervisor(t, element, row, found, cx)
    }

    /// Reads the inputs and starts the element itself.
    fn start_element<R: Run>(
        &mut self,
        t: &P::Tables,
        element: ElementId,
        row: &ElementRow,
        cx: &mut Cx<'_, R>,
    ) -> Result<Option<Edge>, Stop>
    where
        P: Plan<R::Env>,
    {
        let id = component(cx, element);
        cx.place.component = id;
        match cx.call(id, |cx| self.plan.start_element(element, cx)) {
            Started::Running => {
                cx.trace(&Record::Started { component: id });
                self.active = Some(element);
                self.due = cx.now + row.period;
                Ok(None)
            }
            Started::SubPlan(Flow::Running(due)) => {
                self.active = Some(element);
                self.due = due;
                Ok(None)
            }
            Started::SubPlan(Flow::Fatal(fault)) => Err(Stop::Run(fault)),
            Started::SubPlan(Flow::Ended(_)) => Err(Stop::Run(Fault::INTERNAL)),
            Started::Done(state) => self.finished(t, element, row, state, cx).map(Some),
            Started::Failed(fault) => self.start_failed(element, row, fault, cx).map(Some),
        }
    }

    /// Nothing runs: the platform stops, the element's `Error` edge is taken.
    fn start_failed<R: Run>(
        &mut self,
        element: ElementId,
        row: &ElementRow,
        fault: Fault,
        cx: &mut Cx<'_, R>,
    ) -> Result<Edge, Stop>
    where
        P: Plan<R::Env>,
    {
        self.plan.discard();
        cx.failed(component(cx, element), fault);
        if row.kind == ElementKind::Actor {
            cx.step.called = cx.place.plan;
            cx.env.stop(cx.now);
        }
        self.error_edge(element, row, fault)
    }
}
