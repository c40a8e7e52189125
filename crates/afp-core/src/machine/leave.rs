//! Leaving an element that finished, failed or is interrupted, and following edges.

use super::{Edge, Flow, Stepping, Stop};
use crate::fault::Fault;
use crate::rt::{Aside, ElementKind, ElementRow, Plan, Polled, Run, Tables, Target};
use crate::trace::{Author, Ending, Outcome, Record};
use afp_types::ElementId;
use core::mem::take;

impl<R: Run, P: Plan<R::Env>> Stepping<'_, '_, P, R> {
    /// The active element has finished or failed.
    pub(super) fn left(&mut self, element: ElementId, row: &ElementRow, polled: Polled) -> Flow {
        let edge = match polled {
            Polled::Done(state) => self.finished(element, row, state),
            Polled::Forced(state) => match self.interrupt_element(element) {
                Ok(()) => self.finished(element, row, state),
                Err(fault) => Err(Stop::Run(fault)),
            },
            Polled::Failed(fault) | Polled::EndedInError(fault) => {
                let id = self.component(element);
                self.cx.failed(id, fault);
                if matches!(polled, Polled::EndedInError(_)) {
                    // The sub-plan has interrupted its active element.
                    self.level.active = None;
                }
                self.level.plan.discard();
                match self.interrupt_active() {
                    Ok(()) => self.error_edge(element, row, fault),
                    Err(fault) => Err(Stop::Run(fault)),
                }
            }
            Polled::SubPlan(Flow::Fatal(fault)) => Err(Stop::Run(fault)),
            Polled::Pending | Polled::SubPlan(_) => Err(Stop::Run(Fault::INTERNAL)),
        };
        self.follow(edge)
    }

    /// Counts an edge of the step.
    ///
    /// # Errors
    /// The step's limit of edges is reached.
    pub(super) fn take_edge(&mut self) -> Result<(), Fault> {
        self.cx.step.edges_left = self.cx.step.edges_left.checked_sub(1).ok_or(Fault::LIVELOCK)?;
        Ok(())
    }

    /// Follows edges until an element is active or the plan ends.
    pub(super) fn follow(&mut self, mut edge: Result<Edge, Stop>) -> Flow {
        loop {
            let taken = match edge {
                Ok(edge) => edge,
                Err(Stop::Plan(ending)) => return self.end(ending),
                Err(Stop::Run(fault)) => return Flow::Fatal(fault),
            };
            if let Err(fault) = self.take_edge() {
                return Flow::Fatal(fault);
            }
            if let Some(held) = self.held_before(taken) {
                return held;
            }
            let entered = match taken.target {
                Some(Target::Element(element)) => match self.abandon_before(element) {
                    Ok(()) => self.enter(element),
                    Err(fault) => return Flow::Fatal(fault),
                },
                Some(Target::Suspend(handler)) if P::Aside::USED => self.enter(handler),
                Some(Target::Return) => self.give_back(),
                Some(Target::Terminate) => return self.end(taken.ending),
                Some(Target::Fail(reason)) => {
                    let reason = self.t.table().reasons.get(reason.index());
                    return self.fail(reason.copied().unwrap_or(Fault::INTERNAL));
                }
                Some(Target::Ignore | Target::Resume | Target::Suspend(_)) | None => {
                    return Flow::Fatal(Fault::INTERNAL);
                }
            };
            match entered.transpose() {
                None => return Flow::Running(self.wake()),
                Some(next) => edge = next,
            }
        }
    }

    /// The plan ends by an edge to `fail`.
    fn fail(&mut self, fault: Fault) -> Flow {
        self.cx.note_failure(self.cx.place.plan, fault);
        self.end(Ending::Error(fault))
    }

    /// An element reached a state; its outputs are staged.
    pub(super) fn finished(
        &mut self,
        element: ElementId,
        row: &ElementRow,
        state: u16,
    ) -> Result<Edge, Stop> {
        self.level.active = None;
        let edge = self.reached(element, row, state);
        self.level.plan.leave(element);
        Ok(edge)
    }

    /// Commits the outputs of the state and returns its edge.
    pub(super) fn reached(&mut self, element: ElementId, row: &ElementRow, state: u16) -> Edge {
        let id = self.component(element);
        self.cx.trace(&Record::Finished { element: id, state: Outcome::Declared(state) });
        self.commit(Author::Component(id));
        Edge { target: self.t.table().edge(row.states, state), ending: Ending::Ok }
    }

    /// The `Error` edge of a failed element; if unconnected, the plan ends.
    pub(super) fn error_edge(
        &mut self,
        element: ElementId,
        row: &ElementRow,
        fault: Fault,
    ) -> Result<Edge, Stop> {
        self.level.plan.leave(element);
        after_fault(row, fault)
    }

    /// Interrupts and drops the active element, if any.
    pub(super) fn interrupt_active(&mut self) -> Result<(), Fault> {
        let Some(element) = self.level.active.take() else { return Ok(()) };
        if P::HOLDS && take(&mut self.level.restarts) {
            // It is interrupted already.
            self.level.plan.leave(element);
            return Ok(());
        }
        let result = self.interrupt_element(element);
        if result.is_ok() {
            let element = self.component(element);
            self.cx.trace(&Record::Interrupted { element });
        }
        self.level.plan.leave(element);
        result
    }

    /// Interrupts an element; traces a failure.
    pub(super) fn interrupt_element(&mut self, element: ElementId) -> Result<(), Fault> {
        let id = self.component(element);
        self.cx.place.component = id;
        let result = self.cx.call(id, |cx| self.level.plan.interrupt_element(element, cx));
        if let Err(fault) = result
            && self.t.table().element(element).is_some_and(|row| row.kind == ElementKind::Actor)
        {
            self.cx.failed(id, fault);
        }
        result
    }
}

/// The `Error` edge of an element; if unconnected, the plan ends.
pub(super) fn after_fault(row: &ElementRow, fault: Fault) -> Result<Edge, Stop> {
    match row.on_error {
        None => Err(Stop::Plan(Ending::Error(fault))),
        target => Ok(Edge { target, ending: Ending::Ok }),
    }
}
