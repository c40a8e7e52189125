//! What entering an element may cost: everything that is entered behind it in the same step.

use crate::flow::view::{Cause, Node, View, takes_time};
use crate::flow::{self, strong};
use crate::graph::Component;

use super::cost::Cost;
use super::level::{Level, locals};

/// For each node the cost of entering it: its supervisors are started and asked, it is started, and
/// so on along every edge that takes no time.
pub(super) fn entering(view: &View<'_>, levels: &[Level]) -> Vec<Cost> {
    let mut first = Vec::with_capacity(view.nodes() + 1);
    let mut targets: Vec<u32> = Vec::new();
    let mut diverts: Vec<bool> = Vec::new();
    for node in 0..view.nodes() {
        first.push(targets.len() as u32);
        if view.reached[node] {
            let quick = view.from(node).iter().filter(|edge| flow::is_quick(view, edge));
            for edge in quick {
                targets.push(edge.to as u32);
                diverts.push(matches!(edge.cause, Cause::Event(..)));
            }
        }
    }
    first.push(targets.len() as u32);
    let component = strong::components(&first, &targets);
    let behind = |node: Node| first[node] as usize..first[node + 1] as usize;
    let to = |edge: usize| component[targets[edge] as usize] as usize;
    let mut members: Vec<Vec<Node>> = Vec::new();
    for (node, component) in component.iter().enumerate() {
        let component = *component as usize;
        members.resize(members.len().max(component + 1), Vec::new());
        members[component].push(node);
    }
    // A component's number is less than those of the components that lead to it.
    let mut costs: Vec<Cost> = Vec::with_capacity(members.len());
    for (number, nodes) in members.iter().enumerate() {
        let edges = || nodes.iter().flat_map(|node| behind(*node));
        let inner = edges().filter(|edge| to(*edge) == number).count();
        let outer = || edges().filter(|edge| to(*edge) != number);
        let most = |edges: &mut dyn Iterator<Item = usize>| {
            edges.fold(Cost::ZERO, |most, edge| most.or(&costs[to(edge)]))
        };
        let looks = nodes.iter().fold(Cost::ZERO, |sum, node| sum.and(&look(view, *node)));
        let starts =
            nodes.iter().fold(Cost::ZERO, |sum, node| sum.and(&itself(view, levels, *node)));
        // Who is diverted by the look does not start.
        let cost = match inner {
            0 => {
                let started = starts.and(&most(&mut outer().filter(|edge| !diverts[*edge])));
                let diverted = most(&mut outer().filter(|edge| diverts[*edge]));
                looks.and(&started.or(&diverted))
            }
            _ => turns(view, nodes, &looks.and(&starts)).and(&most(&mut outer())),
        };
        costs.push(cost);
    }
    component.iter().map(|component| costs[*component as usize].clone()).collect()
}

/// What the elements of a cycle may cost in one step, when going round once costs `once`.
fn turns(view: &View<'_>, nodes: &[Node], once: &Cost) -> Cost {
    let limit = nodes.iter().filter_map(|node| flow::count_limit(view, *node)).min();
    let name = nodes.first().map(|node| view.node_name(*node)).unwrap_or_default();
    match limit {
        Some(limit) => once.times(limit.saturating_add(1)),
        None => Cost::unknown(format!("'{name}' may be entered many times in one step")),
    }
}

/// Starting and asking the supervisors of an element that is entered.
fn look(view: &View<'_>, node: Node) -> Cost {
    let element = view.element(node).filter(|element| takes_time(element));
    element.map_or(Cost::ZERO, |element| locals(view, element).times(2))
}

/// Starting the element itself.
fn itself(view: &View<'_>, levels: &[Level], node: Node) -> Cost {
    let Some(element) = view.element(node) else { return Cost::ZERO };
    match element.component {
        Component::Actor(id) | Component::Computation(id) => Cost::budget(view.model.template(id)),
        Component::SubPlan(id) => levels[id.index()].entering.clone(),
    }
}
