//! Events that do not interrupt yet: they lead to `resume`, or to computations that may resume.
//!
//! Their writes are committed immediately. The computations run while the element stays active.
//! Only if an edge leads elsewhere is the element interrupted or, in the look, not started.

use super::leave::after_fault;
use super::sweep::{Moment, What};
use super::{Edge, Stepping, Stop};
use crate::clock::Clock;
use crate::fault::Fault;
use crate::rt::{ElementKind, ElementRow, Plan, Run, Started, Tables, Target};
use crate::trace::{Author, Ending, Outcome, Record};
use afp_types::{ElementId, SupervisorId};

impl<R: Run, P: Plan<R::Env>> Stepping<'_, '_, P, R> {
    /// Takes such an event after its outputs are staged. The element continues, or is left by an
    /// edge.
    pub(super) fn hold(
        &mut self,
        supervisor: SupervisorId,
        (event, target): (Outcome, Target),
        moment: Moment,
    ) -> Result<(), What> {
        let id = self.supervisor_id(supervisor);
        let element = self.component(moment.element);
        self.cx.trace(&Record::Event { supervisor: id, event, element });
        self.commit(Author::Component(id));
        let led = self.compute_until_resumed(target);
        self.cx.step.clock = self.cx.clock.now(self.cx.now);
        match led.transpose() {
            None => {
                self.cx.trace(&Record::Resumed { element, supervisor: id });
                Ok(())
            }
            Some(edge) => Err(What::Leads(event, edge)),
        }
    }

    /// Runs computations until an edge resumes (`None`) or leads elsewhere.
    fn compute_until_resumed(&mut self, target: Target) -> Result<Option<Edge>, Stop> {
        let mut edge = Edge { target: Some(target), ending: Ending::Interrupted };
        loop {
            let computation = match edge.target {
                Some(Target::Resume) => None,
                Some(Target::Element(element)) => match self.t.table().element(element) {
                    Some(row) if row.kind == ElementKind::Computation => Some((element, row)),
                    _ => return Ok(Some(edge)),
                },
                _ => return Ok(Some(edge)),
            };
            self.take_edge().map_err(Stop::Run)?;
            let Some((element, row)) = computation else { return Ok(None) };
            edge = self.compute(element, row)?;
        }
    }

    /// Runs one computation while the element stays active.
    fn compute(&mut self, element: ElementId, row: &ElementRow) -> Result<Edge, Stop> {
        let id = self.component(element);
        self.cx.place.component = id;
        match self.cx.call(id, |cx| self.level.plan.start_element(element, cx)) {
            Started::Done(state) => Ok(self.reached(element, row, state)),
            Started::Failed(fault) => {
                self.level.plan.discard();
                self.cx.failed(id, fault);
                after_fault(row, fault)
            }
            Started::Running | Started::SubPlan(_) => Err(Stop::Run(Fault::INTERNAL)),
        }
    }
}
