//! The response of every supervisor, and the bound of the interruption that it causes.

use crate::flow::view::View;
use crate::graph::{Component, Supervisor, SupervisorId};
use crate::rows::polling_order;

use super::cost::Cost;
use super::held::{interrupts, poll};
use super::level::{Levels, Outside};
use super::{Interruption, Response, SupervisorTiming, Trust};

/// One row for each supervisor that can run, the main plan's first.
pub(super) fn rows(
    views: &[View<'_>],
    levels: &Levels,
    outside: &Outside,
    longest_step: &Cost,
    tick: u64,
) -> Vec<SupervisorTiming> {
    let mut rows = Vec::new();
    for (index, view) in views.iter().enumerate().rev() {
        let Some(outer) = &outside.before[index] else { continue };
        let before = before(view);
        for (at, supervisor) in view.plan.supervisors.iter().enumerate() {
            let Ok(id) = u16::try_from(at).map(SupervisorId) else { continue };
            if supervisor.owner.is_some_and(|owner| !view.reached[owner.index()]) {
                continue;
            }
            let response = response(view, id, &outer.and(&before[at]), longest_step, tick);
            let interruption = interruption(view, levels, index, id, &response);
            rows.push(SupervisorTiming {
                plan: view.plan.name.clone(),
                path: view.supervisor_path(id),
                every: supervisor.every,
                deadline: supervisor.deadline,
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
    before: &Cost,
    longest_step: &Cost,
    tick: u64,
) -> Result<Response, String> {
    let own = poll(view, id).known()?;
    Ok(Response { tick, step: longest_step.known()?, before: before.known()?, own })
}

/// For each supervisor of a plan the most that is polled before it in one step.
fn before(view: &View<'_>) -> Vec<Cost> {
    let plan = view.plan;
    let all = (0..=u16::MAX).map(SupervisorId).take(plan.supervisors.len());
    let mut before = vec![Cost::ZERO; plan.supervisors.len()];
    let mut globals = Cost::ZERO;
    let mut locals = vec![Cost::ZERO; plan.elements.len()];
    let mut most_locals = Cost::ZERO;
    for id in polling_order(plan, all) {
        let at = id.index();
        let supervisor = &plan.supervisors[at];
        let budget = poll(view, id);
        match supervisor.owner {
            None => {
                before[at] = globals.and(&most_locals);
                globals = globals.and(&budget);
            }
            Some(owner) if view.reached[owner.index()] => {
                let own = &mut locals[owner.index()];
                before[at] = globals.and(own);
                *own = own.and(&budget);
                most_locals = most_locals.or(own);
            }
            Some(_) => {}
        }
    }
    before
}

/// `None` when the supervisor interrupts nothing.
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
    let period = ("period", supervisor.every);
    let assumed = |reason: String| Interruption {
        trust: Trust::Assumed,
        terms: vec![period, ("deadline", supervisor.deadline), ("stop", stop)],
        reason,
    };
    let (response, interrupt) = match (response, interrupt.known()) {
        (Ok(response), Ok(interrupt)) => (response.total(), interrupt),
        (Err(reason), _) => return Some(assumed(reason.clone())),
        (_, Err(reason)) => return Some(assumed(reason)),
    };
    // Budgets are declared, so a bound without any slack proves nothing.
    if response >= supervisor.deadline {
        let longer = if response == supervisor.deadline { "as long as" } else { "longer than" };
        return Some(assumed(format!("the response may be {longer} the deadline")));
    }
    let terms = vec![period, ("response", response), ("interrupt", interrupt), ("stop", stop)];
    Some(Interruption { trust: Trust::Proved, terms, reason: String::new() })
}

/// What it costs to interrupt whatever the supervisor watches, and until that stands still.
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
    match view.plan.elements[owner.index()].component {
        Component::SubPlan(id) => {
            let level = &levels.all[id.index()];
            (level.interrupt.clone(), level.stop.clone())
        }
        Component::Actor(id) | Component::Computation(id) => {
            let template = view.model.template(id);
            (Cost::budget(template), Cost::stop(template))
        }
    }
}
