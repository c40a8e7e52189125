//! What a supervisor may cost without interrupting anything: its poll, and the computations between an
//! event of it and `resume`.

use crate::flow;
use crate::flow::view::View;
use crate::graph::{Component, ElementId, SupervisorId, Target, chain};

use super::cost::Cost;

/// One poll of a supervisor with the longest of its chains.
pub(super) fn poll(view: &View<'_>, id: SupervisorId) -> Cost {
    let targets = view.plan.targets(id);
    let chains = targets.fold(Cost::ZERO, |most, target| most.or(&held(view, target)));
    Cost::budget(view.model.template(view.supervisor(id).template)).and(&chains)
}

/// Whether an edge of a supervisor can interrupt what it watches.
pub(super) fn interrupts(view: &View<'_>, target: Target) -> bool {
    chain(&view.plan.elements, target).1
}

/// All computations of a chain, as often as they may run; nothing where an edge cannot resume.
fn held(view: &View<'_>, target: Target) -> Cost {
    let (run, _) = chain(&view.plan.elements, target);
    if !run.iter().any(|id| view.resumes(id.index())) {
        return Cost::ZERO;
    }
    let once =
        run.iter().fold(Cost::ZERO, |sum, id| match view.plan.elements[id.index()].component {
            Component::Computation(template) => {
                sum.and(&Cost::budget(view.model.template(template)))
            }
            Component::Actor(_) | Component::SubPlan(_) => sum,
        });
    if !run.iter().any(|id| comes_again(view, *id)) {
        return once;
    }
    let limits = run.iter().filter_map(|id| flow::count_limit(view, id.index()));
    match limits.min() {
        Some(limit) => once.times(limit.saturating_add(1)),
        None => Cost::unknown("computations may run many times before 'resume'"),
    }
}

/// Whether a computation can lead to itself through computations alone.
fn comes_again(view: &View<'_>, id: ElementId) -> bool {
    let element = &view.plan.elements[id.index()];
    let mut targets = element.states.iter().flatten().chain(&element.on_error);
    targets.any(|target| chain(&view.plan.elements, *target).0.contains(&id))
}
