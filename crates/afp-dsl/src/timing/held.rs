//! Cost of a supervisor without an interruption: its poll, and the computations between an event
//! and `resume`.

use std::collections::BTreeMap;

use crate::flow;
use crate::flow::view::{Edge, View};
use crate::graph::{Component, Element, ElementId, SupervisorId, Target, chain};

use super::cost::Cost;

/// One poll of a supervisor with its longest chain.
pub(super) fn poll(view: &View<'_>, id: SupervisorId) -> Cost {
    let targets = view.plan.targets(id);
    let chains = targets.fold(Cost::ZERO, |most, target| most.or(&held(view, target)));
    Cost::budget(view.template(view.supervisor(id))).and(&chains)
}

pub(super) fn locals(view: &View<'_>, element: &Element) -> Cost {
    sum(view, element.supervisors.iter().copied())
}

pub(super) fn sum(view: &View<'_>, supervisors: impl Iterator<Item = SupervisorId>) -> Cost {
    supervisors.fold(Cost::ZERO, |sum, id| sum.and(&poll(view, id)))
}

/// Whether an edge of a supervisor can interrupt the active element.
pub(super) fn interrupts(view: &View<'_>, target: Target) -> bool {
    chain(&view.plan.elements, target).1
}

/// All computations of a chain, as often as they may run; zero if an edge cannot resume.
fn held(view: &View<'_>, target: Target) -> Cost {
    let (run, _) = chain(&view.plan.elements, target);
    if !run.iter().any(|id| view.resumes(id.index())) {
        return Cost::ZERO;
    }
    let mut edges = within(view, &run);
    let times = flow::unwind(view, flow::components(run.len(), &edges), &mut edges, u64::MAX);
    run.iter().zip(times).fold(Cost::ZERO, |sum, (id, times)| {
        let Component::Computation(template) = view.plan.elements[id.index()].component else {
            return sum;
        };
        sum.and(&match times {
            Some(times) => Cost::budget(view.model.template(template)).times(times),
            None => Cost::unknown("computations may run many times before 'resume'"),
        })
    })
}

/// The edges between the computations of a chain, numbered in its order.
fn within(view: &View<'_>, run: &[ElementId]) -> Vec<Edge> {
    let places: BTreeMap<ElementId, usize> = run.iter().copied().zip(0..).collect();
    let mut edges = Vec::new();
    for (from, id) in run.iter().enumerate() {
        let edge = |edge: &Edge| {
            let to = ElementId(u16::try_from(edge.to).ok()?);
            Some(Edge { from, to: *places.get(&to)?, ..*edge })
        };
        edges.extend(view.from(id.index()).iter().filter_map(edge));
    }
    edges
}
