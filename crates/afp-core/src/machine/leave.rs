//! Leaving an element: it reached a state, it failed, or it is interrupted; then edges are followed.

use super::{Edge, Flow, Level, Stop, component};
use crate::fault::Fault;
use crate::rt::{Cx, ElementKind, ElementRow, Plan, PlanState, Polled, Run, Tables, Target};
use crate::trace::{Author, Ending, Outcome, Record};
use afp_types::ElementId;

impl<P: PlanState> Level<P> {
    /// The active element has finished or failed.
    pub(super) fn left<R: Run>(
        &mut self,
        t: &P::Tables,
        element: ElementId,
        row: &ElementRow,
        polled: Polled,
        cx: &mut Cx<'_, R>,
    ) -> Flow
    where
        P: Plan<R::Env>,
    {
        let edge = match polled {
            Polled::Done(state) => self.finished(t, element, row, state, cx),
            Polled::Forced(state) => match self.interrupt_element(t, element, cx) {
                Ok(()) => self.finished(t, element, row, state, cx),
                Err(fault) => Err(Stop::Run(fault)),
            },
            Polled::Failed(fault) | Polled::EndedInError(fault) => {
                cx.failed(component(cx, element), fault);
                if matches!(polled, Polled::EndedInError(_)) {
                    // It interrupted what was active inside.
                    self.active = None;
                }
                self.plan.discard();
                match self.interrupt_active(t, cx) {
                    Ok(()) => self.error_edge(element, row, fault),
                    Err(fault) => Err(Stop::Run(fault)),
                }
            }
            Polled::SubPlan(Flow::Fatal(fault)) => Err(Stop::Run(fault)),
            Polled::Pending | Polled::SubPlan(_) => Err(Stop::Run(Fault::INTERNAL)),
        };
        match edge {
            Ok(edge) => self.follow(t, edge, cx),
            Err(stop) => self.stop(stop, cx),
        }
    }

    /// Takes edges until an element is active or the plan ends.
    pub(super) fn follow<R: Run>(
        &mut self,
        t: &P::Tables,
        mut edge: Edge,
        cx: &mut Cx<'_, R>,
    ) -> Flow
    where
        P: Plan<R::Env>,
    {
        loop {
            match cx.step.edges_left.checked_sub(1) {
                Some(left) => cx.step.edges_left = left,
                None => return Flow::Fatal(Fault::LIVELOCK),
            }
            let element = match edge.target {
                Some(Target::Element(element)) => element,
                Some(Target::Terminate) => return self.end(edge.ending, cx),
                Some(Target::Fail(reason)) => {
                    let reason = t.table().reasons.get(reason.index());
                    return self.fail(reason.copied().unwrap_or(Fault::INTERNAL), cx);
                }
                Some(Target::Ignore | Target::Resume) | None => {
                    return Flow::Fatal(Fault::INTERNAL);
                }
            };
            match self.enter(t, element, cx) {
                Ok(None) => return Flow::Running(self.wake(t)),
                Ok(Some(next)) => edge = next,
                Err(stop) => return self.stop(stop, cx),
            }
        }
    }

    /// The plan fails by an edge of its own.
    fn fail<R: Run>(&mut self, fault: Fault, cx: &mut Cx<'_, R>) -> Flow
    where
        P: Plan<R::Env>,
    {
        cx.note_failure(cx.place.plan, fault);
        self.end(Ending::Error(fault), cx)
    }

    /// An element reached a state: its outputs are staged.
    pub(super) fn finished<R: Run>(
        &mut self,
        t: &P::Tables,
        element: ElementId,
        row: &ElementRow,
        state: u16,
        cx: &mut Cx<'_, R>,
    ) -> Result<Edge, Stop>
    where
        P: Plan<R::Env>,
    {
        self.active = None;
        let edge = self.reached(t, element, row, state, cx);
        self.plan.leave(element);
        Ok(edge)
    }

    /// Commits the outputs of an element that reached a state, and gives the state's edge.
    pub(super) fn reached<R: Run>(
        &mut self,
        t: &P::Tables,
        element: ElementId,
        row: &ElementRow,
        state: u16,
        cx: &mut Cx<'_, R>,
    ) -> Edge {
        let id = component(cx, element);
        cx.trace(&Record::Finished { element: id, state: Outcome::Declared(state) });
        self.commit(Author::Component(id), cx);
        Edge { target: t.table().edge(row.states, state), ending: Ending::Ok }
    }

    /// The edge of an element that failed; unconnected, the plan ends.
    pub(super) fn error_edge<E: ?Sized>(
        &mut self,
        element: ElementId,
        row: &ElementRow,
        fault: Fault,
    ) -> Result<Edge, Stop>
    where
        P: Plan<E>,
    {
        self.plan.leave(element);
        after_fault(row, fault)
    }

    /// Interrupts the active element, if there is one, and drops it.
    pub(super) fn interrupt_active<R: Run>(
        &mut self,
        t: &P::Tables,
        cx: &mut Cx<'_, R>,
    ) -> Result<(), Fault>
    where
        P: Plan<R::Env>,
    {
        let Some(element) = self.active.take() else { return Ok(()) };
        let result = self.interrupt_element(t, element, cx);
        if result.is_ok() {
            cx.trace(&Record::Interrupted { element: component(cx, element) });
        }
        self.plan.leave(element);
        result
    }

    /// Interrupts an element; an actor that cannot be is traced.
    pub(super) fn interrupt_element<R: Run>(
        &mut self,
        t: &P::Tables,
        element: ElementId,
        cx: &mut Cx<'_, R>,
    ) -> Result<(), Fault>
    where
        P: Plan<R::Env>,
    {
        let id = component(cx, element);
        cx.place.component = id;
        let result = cx.call(id, |cx| self.plan.interrupt_element(element, cx));
        if let Err(fault) = result
            && t.table().element(element).is_some_and(|row| row.kind == ElementKind::Actor)
        {
            cx.failed(id, fault);
        }
        result
    }
}

/// The `Error` edge of an element; unconnected, the plan ends.
pub(super) fn after_fault(row: &ElementRow, fault: Fault) -> Result<Edge, Stop> {
    match row.on_error {
        None => Err(Stop::Plan(Ending::Error(fault))),
        target => Ok(Edge { target, ending: Ending::Ok }),
    }
}
