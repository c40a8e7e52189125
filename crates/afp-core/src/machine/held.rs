//! Events that interrupt nothing yet: they lead to `resume`, or to computations that may.
//!
//! What they write is committed as it comes. The computations run beside the active element; only
//! where their edges lead elsewhere is it interrupted, or, in the look, not started.

use super::leave::after_fault;
use super::sweep::{Moment, What};
use super::{Edge, Level, Stop, component, supervisor_id};
use crate::clock::Clock;
use crate::fault::Fault;
use crate::rt::{Cx, ElementKind, ElementRow, Plan, PlanState, Run, Started, Tables, Target};
use crate::trace::{Author, Ending, Outcome, Record};
use afp_types::{ElementId, SupervisorId};

impl<P: PlanState> Level<P> {
    /// Takes an event that is held, its outputs staged. The element goes on, or there is an edge to leave
    /// it by.
    pub(super) fn hold<R: Run>(
        &mut self,
        t: &P::Tables,
        supervisor: SupervisorId,
        (event, target): (Outcome, Target),
        moment: Moment,
        cx: &mut Cx<'_, R>,
    ) -> Result<(), What>
    where
        P: Plan<R::Env>,
    {
        let id = supervisor_id(t, cx, supervisor);
        let element = component(cx, moment.element);
        cx.trace(&Record::Event { supervisor: id, event, element });
        self.commit(Author::Component(id), cx);
        let led = self.compute_until_resumed(t, target, cx);
        cx.step.clock = cx.clock.now(cx.now);
        match led {
            Ok(None) => {
                cx.trace(&Record::Resumed { element, supervisor: id });
                Ok(())
            }
            Ok(Some(edge)) => Err(What::Leads(event, Ok(edge))),
            Err(stop) => Err(What::Leads(event, Err(stop))),
        }
    }

    /// Runs computations until one of their edges resumes, which is `None`, or leads elsewhere.
    fn compute_until_resumed<R: Run>(
        &mut self,
        t: &P::Tables,
        target: Target,
        cx: &mut Cx<'_, R>,
    ) -> Result<Option<Edge>, Stop>
    where
        P: Plan<R::Env>,
    {
        let mut edge = Edge { target: Some(target), ending: Ending::Interrupted };
        loop {
            let computation = match edge.target {
                Some(Target::Resume) => None,
                Some(Target::Element(element)) => match t.table().element(element) {
                    Some(row) if row.kind == ElementKind::Computation => Some((element, row)),
                    _ => return Ok(Some(edge)),
                },
                _ => return Ok(Some(edge)),
            };
            match cx.step.edges_left.checked_sub(1) {
                Some(left) => cx.step.edges_left = left,
                None => return Err(Stop::Run(Fault::LIVELOCK)),
            }
            let Some((element, row)) = computation else { return Ok(None) };
            edge = self.compute(t, element, row, cx)?;
        }
    }

    /// Runs one computation beside what is active.
    fn compute<R: Run>(
        &mut self,
        t: &P::Tables,
        element: ElementId,
        row: &ElementRow,
        cx: &mut Cx<'_, R>,
    ) -> Result<Edge, Stop>
    where
        P: Plan<R::Env>,
    {
        let id = component(cx, element);
        cx.place.component = id;
        match cx.call(id, |cx| self.plan.start_element(element, cx)) {
            Started::Done(state) => Ok(self.reached(t, element, row, state, cx)),
            Started::Failed(fault) => {
                self.plan.discard();
                cx.failed(id, fault);
                after_fault(row, fault)
            }
            Started::Running | Started::SubPlan(_) => Err(Stop::Run(Fault::INTERNAL)),
        }
    }
}
