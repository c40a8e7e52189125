//! A sub-plan as an element: its machine, its start and its step.

use afp_types::Duration;

use crate::fault::{BadValue, Fault};
use crate::machine::Machine;
use crate::rt::plan::{Committer, Cx, Flow, Polled, Started};
use crate::rt::run::Run;
use crate::rt::state::{Plan, PlanState};
use crate::rt::table::Child;
use crate::trace::{Author, Ending, Record};

impl<R: Run> Cx<'_, R> {
    /// Passes live inputs to a sub-plan before its step, as a commit of its element. `write` writes
    /// the changed inputs and returns whether there are any.
    pub fn pass_live<P: PlanState>(
        &mut self,
        child: Child,
        machine: &mut Machine<P>,
        write: impl FnOnce(&mut P, &mut Committer<'_, R::Sink>) -> bool,
    ) {
        let number = self.step.commits.wrapping_add(1);
        let mut to = Committer {
            sink: &mut *self.sink,
            at: self.now,
            author: Author::Component(self.place.component),
            entries: self.place.entries.saturating_add(child.entries),
            number,
        };
        if write(machine.plan_mut(), &mut to) {
            self.step.commits = number;
        }
    }

    /// Starts a sub-plan whose `in` entries are set.
    pub fn start_sub_plan<P: Plan<R::Env>>(
        &mut self,
        child: Child,
        machine: &mut Machine<P>,
    ) -> Flow {
        self.trace(&Record::Started { component: self.place.component });
        self.inside(child, |cx| machine.start(cx))
    }

    /// Continues a sub-plan that was suspended `away` ago.
    pub fn resume_sub_plan<P: Plan<R::Env>>(
        &mut self,
        child: Child,
        machine: &mut Machine<P>,
        away: Duration,
    ) -> Flow {
        self.trace(&Record::Returned { component: self.place.component, away });
        self.inside(child, |cx| machine.resume(away, cx))
    }
}

impl Started {
    /// Converts the result of a sub-plan's start; `stage` stages its results.
    pub fn sub_plan<R: Run>(
        flow: Flow,
        stage: impl FnOnce() -> Result<(), BadValue>,
        cx: &mut Cx<'_, R>,
    ) -> Self {
        match ended(flow, stage, cx) {
            None => Started::SubPlan(flow),
            Some(Ok(state)) => Started::Done(state),
            Some(Err(fault)) => Started::Failed(fault),
        }
    }
}

impl Polled {
    /// Converts the result of a sub-plan's step; `stage` stages its results.
    pub fn sub_plan<R: Run>(
        flow: Flow,
        stage: impl FnOnce() -> Result<(), BadValue>,
        cx: &mut Cx<'_, R>,
    ) -> Self {
        match ended(flow, stage, cx) {
            None => Polled::SubPlan(flow),
            Some(Ok(state)) => Polled::Done(state),
            Some(Err(fault)) => Polled::EndedInError(fault),
        }
    }
}

/// The state of a sub-plan that ended: `OK` is 0, `Interrupted` 1.
fn ended<R: Run>(
    flow: Flow,
    stage: impl FnOnce() -> Result<(), BadValue>,
    cx: &mut Cx<'_, R>,
) -> Option<Result<u16, Fault>> {
    match flow {
        Flow::Ended(Ending::Ok) => Some(cx.noted_outside(stage()).map(|()| 0)),
        Flow::Ended(Ending::Interrupted) => Some(cx.noted_outside(stage()).map(|()| 1)),
        Flow::Ended(Ending::Error(fault)) => Some(Err(fault)),
        Flow::Running(_) | Flow::Held(_) | Flow::Fatal(_) => None,
    }
}
