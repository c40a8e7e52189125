//! The response of every supervisor, and the bound of its interruption.

use crate::flow::view::View;
use crate::graph::{Supervisor, SupervisorId};

use super::before::{Before, before};
use super::contribution::Outside;
use super::cost::Cost;
use super::held::{interrupts, poll};
use super::level::Levels;
use super::{Interruption, Response, SupervisorTiming, Trust};
use afp_types::Duration;

/// Values for every supervisor of the main plan.
pub(super) struct Bounds<'a> {
    pub longest_step: &'a Cost,
    /// An entry whose external writes can lengthen steps.
    pub open: Option<&'a str>,
    /// Delay of the target in noticing a release.
    pub tick: u64,
}

/// One row for each supervisor that can run, the main plan's first.
pub(super) fn rows(
    views: &[View<'_>],
    levels: &Levels,
    outside: &Outside,
    bounds: &Bounds<'_>,
) -> Vec<SupervisorTiming> {
    let mut rows = Vec::new();
    for (index, view) in views.iter().enumerate().rev() {
        let Some(outer) = &outside.before[index] else { continue };
        let before = before(view, levels, index);
        for (at, supervisor) in view.plan.supervisors.iter().enumerate() {
            let Ok(id) = u16::try_from(at).map(SupervisorId) else { continue };
            if supervisor.owner.is_some_and(|owner| !view.reached[owner.index()]) {
                continue;
            }
            let response = response(view, id, outer, &before[at], bounds);
            let interruption = interruption(view, levels, index, id, &response);
            let interruption = interruption.map(|bound| bound.unless_written(bounds.open));
            rows.push(SupervisorTiming {
                plan: view.plan.name.clone(),
                path: view.supervisor_path(id),
                timing: supervisor.timing,
                response,
                interruption,
                span: supervisor.span,
            });
        }
    }
    rows
}

fn response(
    view: &View<'_>,
    id: SupervisorId,
    outer: &Cost,
    before: &Before,
    bounds: &Bounds<'_>,
) -> Result<Response, String> {
    let own = poll(view, id).known()?;
    let (tick, step) = (bounds.tick, bounds.longest_step.known()?);
    let polls = outer.and(&before.polls).known()?;
    Ok(Response { tick, step, before: polls, entered: before.entered.known()?, own })
}

impl Interruption {
    /// Reduces the trust to assumed if external writes of an entry can lengthen steps.
    fn unless_written(mut self, entry: Option<&str>) -> Interruption {
        if let (Some(entry), Trust::Proved) = (entry, self.trust) {
            self.trust = Trust::Assumed;
            self.reason = format!("if nobody outside writes '{entry}', in which a loop counts");
        }
        self
    }
}

/// `None` if the supervisor interrupts nothing.
fn interruption(
    view: &View<'_>,
    levels: &Levels,
    index: usize,
    id: SupervisorId,
    response: &Result<Response, String>,
) -> Option<Interruption> {
    let supervisor = view.supervisor(id);
    if !view.plan.targets(id).any(|target| interrupts(view, target)) {
        return None;
    }
    let (interrupt, stop) = interrupted(view, levels, index, supervisor);
    let stop = match stop.known() {
        Ok(stop) => stop,
        Err(reason) => {
            return Some(Interruption { trust: Trust::Unknown, terms: Vec::new(), reason });
        }
    };
    let [period, deadline] =
        [supervisor.timing.period, supervisor.timing.deadline].map(Duration::as_nanos);
    let period = ("period", period);
    let assumed = |reason: String| Interruption {
        trust: Trust::Assumed,
        terms: vec![period, ("deadline", deadline), ("stop", stop)],
        reason,
    };
    let (response, interrupt) = match (response, interrupt.known()) {
        (Ok(response), Ok(interrupt)) => (response.total(), interrupt),
        (Err(reason), _) => return Some(assumed(reason.clone())),
        (_, Err(reason)) => return Some(assumed(reason)),
    };
    // Budgets are estimates, so a bound without slack proves nothing.
    if response >= deadline {
        let longer = if response == deadline { "as long as" } else { "longer than" };
        return Some(assumed(format!("the response may be {longer} the deadline")));
    }
    let terms = vec![period, ("response", response), ("interrupt", interrupt), ("stop", stop)];
    Some(Interruption { trust: Trust::Proved, terms, reason: String::new() })
}

/// Costs of interrupting the watched elements, and until their standstill.
fn interrupted(
    view: &View<'_>,
    levels: &Levels,
    index: usize,
    supervisor: &Supervisor,
) -> (Cost, Cost) {
    let Some(owner) = supervisor.owner else {
        let level = &levels.all[index];
        return (level.interrupt.clone(), level.stop.clone());
    };
    levels.interrupting(view, &view.plan.elements[owner.index()])
}
