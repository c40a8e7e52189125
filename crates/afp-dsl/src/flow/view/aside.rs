//! The elements that `suspend` can set aside, and that `return` continues.

use std::collections::{BTreeMap, BTreeSet};

use super::{Cause, Edge, Node, View};

/// An element that an edge sets aside.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Aside {
    /// The edge of the event, in [`View::edges`]; computations may follow.
    pub edge: usize,
    /// The element that is active then, which is not a handler.
    pub element: Node,
    pub handler: Node,
}

/// The elements that reachable edges set aside. A handler is never set aside by its own plan.
pub(super) fn asides(view: &View<'_>) -> Vec<Aside> {
    if view.handlers.is_empty() {
        return Vec::new();
    }
    let mut found = BTreeSet::new();
    for (element, _) in view.elements().filter(|(_, element)| element.takes_time()) {
        for edge in view.range(element).chain(globals(view, element)) {
            if matches!(view.edges[edge].cause, Cause::State(..) | Cause::Error(_)) {
                continue;
            }
            let handlers = suspends(view, edge).into_iter();
            found.extend(handlers.map(|handler| Aside { edge, element, handler }));
        }
    }
    // A handler that suspends is replaced, and the suspended element stays.
    let mut open: Vec<Aside> = found.iter().copied().collect();
    let next: Vec<Aside> = open.extract_if(.., |it| view.handlers.contains(&it.element)).collect();
    let mut known: BTreeSet<Aside> = BTreeSet::new();
    while let Some(aside) = open.pop() {
        if known.insert(aside) {
            let replaced = next.iter().filter(|next| next.element == aside.handler);
            open.extend(replaced.map(|next| Aside { handler: next.handler, ..aside }));
        }
    }
    known.into_iter().collect()
}

/// The indices of global edges that are effective while an element is active.
fn globals(view: &View<'_>, node: Node) -> impl Iterator<Item = usize> {
    let own = view.range(node).filter(|at| matches!(view.edges[*at].cause, Cause::Active(_)));
    own.flat_map(|at| view.range(view.edges[at].to))
}

/// The handlers to which an event leads by `suspend`, perhaps through computations.
fn suspends(view: &View<'_>, edge: usize) -> BTreeSet<Node> {
    let (mut handlers, mut seen, mut open) = (BTreeSet::new(), BTreeSet::new(), vec![edge]);
    while let Some(at) = open.pop() {
        let edge = &view.edges[at];
        if edge.suspends {
            handlers.insert(edge.to);
        } else if is_computation(view, edge.to) && seen.insert(edge.to) {
            open.extend(view.range(edge.to));
        }
    }
    handlers
}

fn is_computation(view: &View<'_>, node: Node) -> bool {
    view.element(node).is_some_and(|element| !element.takes_time())
}

/// The edges to `return`, each to every element that may continue there.
pub(super) fn back(view: &View<'_>) -> Vec<Edge> {
    if view.returns.is_empty() {
        return Vec::new();
    }
    // The handlers that may have ended before each node.
    let mut ended: BTreeMap<Node, BTreeSet<Node>> = BTreeMap::new();
    for handler in view.handlers.iter().copied() {
        let (mut open, mut seen) = (vec![handler], BTreeSet::new());
        while let Some(node) = open.pop() {
            if !seen.insert(node) {
                continue;
            }
            ended.entry(node).or_default().insert(handler);
            let edges = view.from(node).iter().filter(|edge| edge.possible && !edge.suspends);
            open.extend(edges.map(|edge| edge.to).filter(|to| is_computation(view, *to)));
        }
    }
    let mut back = Vec::new();
    for (cause, from) in view.returns.iter().copied().filter(|(_, from)| view.reached[*from]) {
        let handlers = ended.get(&from).into_iter().flatten();
        let asides: BTreeSet<Node> =
            handlers.flat_map(|handler| view.suspended_by(*handler)).collect();
        let edge = |to| Edge { cause, from, to, possible: true, suspends: false };
        back.extend(asides.into_iter().map(edge));
    }
    back.sort_by_key(|edge| edge.from);
    back
}

impl View<'_> {
    /// The elements that may be set aside while a handler is active.
    pub fn suspended_by(&self, handler: Node) -> BTreeSet<Node> {
        let own = self.asides.iter().filter(|aside| aside.handler == handler);
        own.map(|aside| aside.element).collect()
    }

    /// Whether a state, a fault or an event of an element, or a computation after it, returns.
    pub fn can_return(&self, node: Node) -> bool {
        let (mut open, mut seen) = (vec![node], BTreeSet::new());
        while let Some(node) = open.pop() {
            if self.returns.iter().any(|(_, from)| *from == node) {
                return true;
            }
            if seen.insert(node) {
                let next = self.from(node).iter().chain(self.of_globals(node));
                let next = next.filter(|edge| edge.possible && !edge.suspends).map(|edge| edge.to);
                open.extend(next.filter(|to| is_computation(self, *to)));
            }
        }
        false
    }

    pub fn computation_returns(&self, node: Node) -> bool {
        is_computation(self, node) && self.can_return(node)
    }

    /// Whether an event of an element returns, perhaps through computations.
    pub fn event_returns(&self, node: Node) -> bool {
        let by_event = |cause: Cause| !matches!(cause, Cause::State(..) | Cause::Error(_));
        self.returns.iter().any(|(cause, from)| *from == node && by_event(*cause))
            || self
                .from(node)
                .iter()
                .any(|edge| by_event(edge.cause) && self.computation_returns(edge.to))
    }
}
