//! Number of edges of a step before and after a loop of computations.
//!
//! The search follows certain edges of computations. An earlier loop counts with all its edges, if
//! known. A later loop counts with one edge in and one out, since the sum is reported there.

use std::collections::BTreeMap;

use super::is_sure;
use crate::flow::view::{Cause, Edge, Node, View};
use crate::graph::{Component, ElementId, Plan, PlanId, SupervisorId, Target};

/// The longest paths of a plan.
pub(super) struct Ways {
    /// Number of edges to a node from outside of its component; `None` if unreachable.
    to: Vec<Option<i64>>,
    /// Number of edges after a component.
    on: Vec<i64>,
}

impl Ways {
    /// The paths of a plan with these components of certain edges, each with its own number of
    /// edges. A component's number is less than those of its predecessors.
    pub fn of(view: &View<'_>, component: &[u32], taken_in: &BTreeMap<u32, i64>) -> Ways {
        let count = component.iter().map(|number| *number as usize + 1).max().unwrap_or(0);
        let mut ways = Ways { to: vec![None; view.nodes()], on: vec![0; count] };
        let mut before_all = vec![0; count];
        let (before, behind) = around(view);
        let of = |node: Node| component[node] as usize;
        ways.to[view.start()] = Some(before);
        before_all[of(view.start())] = before;
        for node in (0..3).map(|ending| view.end(ending)) {
            ways.on[of(node)] = behind;
        }
        let leaves = |node: &Node| {
            [Target::Resume, Target::Return].iter().any(|to| view.has_edge_to(*node, *to))
        };
        for node in (0..view.nodes()).filter(leaves) {
            ways.on[of(node)] = 1;
        }
        let taken = view.edges.iter().filter(|edge| is_taken(view, edge));
        let taken = taken.filter(|edge| of(edge.from) != of(edge.to));
        let (mut sure, others): (Vec<&Edge>, Vec<&Edge>) =
            taken.partition(|edge| is_sure(view, edge.cause));
        for edge in others {
            ways.to[edge.to] = ways.to[edge.to].max(Some(1));
            before_all[of(edge.to)] = before_all[of(edge.to)].max(1);
        }
        sure.sort_unstable_by_key(|edge| of(edge.from));
        for edge in &sure {
            let on = 1 + ways.on[of(edge.to)];
            let known = &mut ways.on[of(edge.from)];
            *known = on.max(*known);
        }
        for edge in sure.iter().rev() {
            let inside = taken_in.get(&component[edge.from]).copied().unwrap_or(0);
            let to = (1 + before_all[of(edge.from)]).saturating_add(inside);
            ways.to[edge.to] = ways.to[edge.to].max(Some(to));
            before_all[of(edge.to)] = before_all[of(edge.to)].max(to);
        }
        ways
    }

    /// Maximum number of edges from the start of a plan, or the edge before, to its endings.
    pub fn to_end(&self, view: &View<'_>) -> i64 {
        let ends = (0..3).filter_map(|ending| self.to[view.end(ending)]);
        ends.max().unwrap_or(0) - self.to[view.start()].unwrap_or(0)
    }

    /// Number of edges to a loop and after it; each of its nodes has its distance to the counter.
    pub fn through(&self, component: u32, nodes: impl Iterator<Item = (Node, usize)>) -> i64 {
        let to = nodes.filter_map(|(node, more)| Some(self.to[node]? + i64::try_from(more).ok()?));
        let on = self.on.get(component as usize).copied().unwrap_or(0);
        to.max().unwrap_or(0).saturating_add(on)
    }
}

fn is_taken(view: &View<'_>, edge: &Edge) -> bool {
    view.reached[edge.from] && edge.possible && !matches!(edge.cause, Cause::Active(_))
}

/// Number of edges of its users before and after a plan in the same step: one each, or none.
fn around(view: &View<'_>) -> (i64, i64) {
    let plans = &view.model.plans;
    let own = plans.iter().position(|plan| plan.is_some_and(|it| std::ptr::eq(it, view.plan)));
    let own =
        own.and_then(|own| u16::try_from(own).ok()).map(|own| Component::SubPlan(PlanId(own)));
    let (mut before, mut behind) = (0, 0);
    for plan in plans.iter().flatten() {
        let elements = (0..).map(ElementId).zip(&plan.elements);
        for (id, element) in elements.filter(|(_, element)| Some(element.component) == own) {
            before = before.max(i64::from(leads_to(plan, id)));
            behind = behind.max(i64::from(element.states.iter().flatten().next().is_some()));
        }
    }
    (before, behind)
}

fn leads_to(plan: &Plan, id: ElementId) -> bool {
    let target = Target::Element(id);
    let supervisors = (0..=u16::MAX).map(SupervisorId).take(plan.supervisors.len());
    let mut elements = plan.elements.iter();
    elements.any(|it| it.states.contains(&Some(target)) || it.on_error == Some(target))
        || supervisors.flat_map(|id| plan.targets(id)).any(|it| it == target)
}
