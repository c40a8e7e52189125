//! The step of a level, compiled once for each element of a plan.
//!
//! For a known element its rows fold to constants and its supervisors are unrolled. This takes a
//! third less time than one step that reads the rows of the active element.

use super::{Flow, Level};
use crate::fault::Fault;
use crate::rt::{AtElement, Cx, Plan, PlanState, Run};
use afp_types::ElementId;

/// A level during a step, with its rows and context.
pub(super) struct Stepping<'a, 'c, P: PlanState, R: Run> {
    pub level: &'a mut Level<P>,
    pub t: &'a P::Tables,
    pub cx: &'a mut Cx<'c, R>,
}

impl<R: Run, P: Plan<R::Env>> AtElement for Stepping<'_, '_, P, R> {
    type Out = Flow;

    #[inline(always)]
    fn at<const ELEMENT: u16>(mut self) -> Flow {
        self.step_element(ElementId(ELEMENT))
    }

    #[inline]
    fn any(mut self, element: ElementId) -> Flow {
        self.step_element(element)
    }

    #[cold]
    fn unknown(self) -> Flow {
        Flow::Fatal(Fault::INTERNAL)
    }
}
