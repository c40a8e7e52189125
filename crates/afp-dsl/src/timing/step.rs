//! Costs of entering an element, with everything entered after it in the same step.

use crate::flow::view::{Cause, Edge, Node, View};
use crate::flow::{self, strong};
use crate::graph::Component;

use super::cost::Cost;
use super::held::locals;
use super::level::Level;

/// For each node the cost of entering it: its supervisors are started and polled, it is started,
/// and so on along every edge that takes no time.
pub(super) fn entering(view: &View<'_>, levels: &[Level]) -> Vec<Cost> {
    let once =
        |node| Once { look: locals_of(view, node).times(2), itself: itself(view, levels, node) };
    costs(view, once, |edge| flow::is_quick(view, edge))
}

/// For each node the part of that before the next look, which begins with the global supervisors:
/// computations, and starts of the entered elements' supervisors.
pub(super) fn until_look(view: &View<'_>) -> Vec<Cost> {
    let is_watched = |node| view.element(node).is_some_and(|it| !it.supervisors.is_empty());
    let is_computation = |node| view.element(node).is_some_and(|element| !element.takes_time());
    let once = |node| Once {
        look: locals_of(view, node),
        itself: if is_computation(node) { itself(view, &[], node) } else { Cost::ZERO },
    };
    costs(view, once, |edge| match edge.cause {
        Cause::State(..) => is_computation(edge.from),
        // The start of a supervisor may fail.
        Cause::Error(_) => is_computation(edge.from) || is_watched(edge.from),
        _ => false,
    })
}

/// Costs of entering one node.
struct Once {
    look: Cost,
    /// Its own start.
    itself: Cost,
}

/// For each node the cost of entering it and its successors along immediate edges.
fn costs(
    view: &View<'_>,
    once: impl Fn(Node) -> Once,
    follows: impl Fn(&Edge) -> bool,
) -> Vec<Cost> {
    let reached = view.edges.iter().filter(|edge| view.reached[edge.from]);
    // A handler takes time, so an event does not return in the step of its start.
    let back = view.back.iter().filter(|edge| !matches!(edge.cause, Cause::Event(..)));
    let mut edges: Vec<Edge> = reached.chain(back).filter(|edge| follows(edge)).copied().collect();
    edges.sort_by_key(|edge| edge.from);
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
    // A component's number is less than those of its predecessors.
    let mut costs: Vec<Cost> = Vec::with_capacity(members.len());
    for (number, nodes) in members.iter().enumerate() {
        let all = || nodes.iter().flat_map(|node| behind(*node));
        let is_cycle = all().any(|edge| to(edge) == number);
        let outer = || all().filter(|edge| to(*edge) != number);
        let most = |edges: &mut dyn Iterator<Item = usize>| {
            edges.fold(Cost::ZERO, |most, edge| most.or(&costs[to(edge)]))
        };
        let cost = match nodes.as_slice() {
            // An element diverted by the look does not start.
            [node] if !is_cycle => {
                let once = once(*node);
                let started = once.itself.and(&most(&mut outer().filter(|edge| !diverts(*edge))));
                let diverted = most(&mut outer().filter(|edge| diverts(*edge)));
                once.look.and(&started.or(&diverted))
            }
            nodes => turns(view, &once, nodes, &times).and(&most(&mut outer())),
        };
        costs.push(cost);
    }
    component.iter().map(|component| costs[*component as usize].clone()).collect()
}

/// Costs of a cycle's elements in one step, with the maximum number of entries of each.
fn turns(
    view: &View<'_>,
    once: &impl Fn(Node) -> Once,
    nodes: &[Node],
    times: &[Option<u64>],
) -> Cost {
    nodes.iter().fold(Cost::ZERO, |sum, node| {
        let Once { look, itself } = once(*node);
        let once = look.and(&itself);
        sum.and(&match times[*node] {
            Some(times) => once.times(times),
            None => {
                let name = view.node_name(*node);
                Cost::unknown(format!("'{name}' may be entered many times in one step"))
            }
        })
    })
}

/// One start, or poll, of each supervisor of an entered element.
fn locals_of(view: &View<'_>, node: Node) -> Cost {
    let element = view.element(node).filter(|element| element.takes_time());
    element.map_or(Cost::ZERO, |element| locals(view, element))
}

fn itself(view: &View<'_>, levels: &[Level], node: Node) -> Cost {
    let Some(element) = view.element(node) else { return Cost::ZERO };
    match element.component {
        Component::Actor(id) | Component::Computation(id) => Cost::budget(view.model.template(id)),
        Component::SubPlan(id) => {
            let level = &levels[id.index()];
            let returns = view.asides.iter().any(|aside| aside.element == node);
            if returns { level.entering.or(&level.again) } else { level.entering.clone() }
        }
    }
}
