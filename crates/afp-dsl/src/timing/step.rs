//! What entering an element may cost: everything that is entered behind it in the same step.

use crate::flow::view::{Cause, Edge, Node, View, takes_time};
use crate::flow::{self, strong};
use crate::graph::Component;

use super::cost::Cost;
use super::level::{Level, locals};

/// For each node the cost of entering it: its supervisors are started and asked, it is started, and
/// so on along every edge that takes no time.
pub(super) fn entering(view: &View<'_>, levels: &[Level]) -> Vec<Cost> {
    let reached = view.edges.iter().filter(|edge| view.reached[edge.from]);
    let edges: Vec<Edge> = reached.filter(|edge| flow::is_quick(view, edge)).copied().collect();
    let first = strong::first(view.nodes(), edges.iter().map(|edge| edge.from));
    let component = flow::components(view.nodes(), &edges);
    let times = flow::unwind(view, component.clone(), &mut edges.clone(), u64::MAX);
    let behind = |node: Node| first[node] as usize..first[node + 1] as usize;
    let to = |edge: usize| component[edges[edge].to] as usize;
    let diverts = |edge: usize| matches!(edges[edge].cause, Cause::Event(..));
    let mut members: Vec<Vec<Node>> = Vec::new();
    for (node, component) in component.iter().enumerate() {
        let component = *component as usize;
        members.resize(members.len().max(component + 1), Vec::new());
        members[component].push(node);
    }
    // A component's number is less than those of the components that lead to it.
    let mut costs: Vec<Cost> = Vec::with_capacity(members.len());
    for (number, nodes) in members.iter().enumerate() {
        let all = || nodes.iter().flat_map(|node| behind(*node));
        let is_cycle = all().any(|edge| to(edge) == number);
        let outer = || all().filter(|edge| to(*edge) != number);
        let most = |edges: &mut dyn Iterator<Item = usize>| {
            edges.fold(Cost::ZERO, |most, edge| most.or(&costs[to(edge)]))
        };
        let cost = match nodes.as_slice() {
            // Who is diverted by the look does not start.
            [node] if !is_cycle => {
                let start = itself(view, levels, *node);
                let started = start.and(&most(&mut outer().filter(|edge| !diverts(*edge))));
                let diverted = most(&mut outer().filter(|edge| diverts(*edge)));
                look(view, *node).and(&started.or(&diverted))
            }
            nodes => turns(view, levels, nodes, &times).and(&most(&mut outer())),
        };
        costs.push(cost);
    }
    component.iter().map(|component| costs[*component as usize].clone()).collect()
}

/// What the elements of a cycle may cost in one step, which may enter each of them so many times.
fn turns(view: &View<'_>, levels: &[Level], nodes: &[Node], times: &[Option<u64>]) -> Cost {
    nodes.iter().fold(Cost::ZERO, |sum, node| {
        let once = look(view, *node).and(&itself(view, levels, *node));
        sum.and(&match times[*node] {
            Some(times) => once.times(times),
            None => {
                let name = view.node_name(*node);
                Cost::unknown(format!("'{name}' may be entered many times in one step"))
            }
        })
    })
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
