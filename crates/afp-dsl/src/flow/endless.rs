//! Plans that never end, and elements that cannot reach an ending.

use crate::flow::view::{Cause, Node, View};
use crate::flow::{FAILED, INTERRUPTED, OK, lasting};
use crate::graph::{Element, ElementId, Target, chain, resuming};
use afp_syntax::diagnostics::{Code, Diagnostic, Diagnostics};
use afp_syntax::message;

/// Warns of a plan that cannot end, notes the elements that cannot reach an ending; returns the
/// possible endings.
pub(super) fn check(view: &View<'_>, diags: &mut Diagnostics) -> [bool; 3] {
    let forth = forward(view);
    let ends = ends(view, &forth);
    if view.plan.forever {
        by_itself(view, &forth, diags);
        return ends;
    }
    if ends == [false; 3] {
        let message = message!("'{}' can never end: nothing leads to 'terminate'", view.plan.name);
        let help = message!(
            "lead a state or an event to 'terminate', or write 'plan {} forever' if it must never end",
            view.plan.name
        );
        diags.push(Diagnostic::new(Code::E0307, view.plan.span, message).help(help));
        return ends;
    }
    let back = backward(view);
    for (node, element) in view.elements() {
        // A lasting actor gets a separate message.
        if !back[node] && forth[node] && !lasting::lasts(view, node, element) {
            let message = message!("once '{}' is reached, the plan cannot end", element.name);
            diags.push(
                Diagnostic::new(Code::E0311, element.span, message)
                    .help("lead one of its states, or a state of a later element, to 'terminate'"),
            );
        }
    }
    ends
}

/// Warns of a plan that should run permanently but ends without an event.
fn by_itself(view: &View<'_>, forth: &[bool], diags: &mut Diagnostics) {
    let ending = [view.end(OK), view.end(INTERRUPTED), view.end(FAILED)];
    for edge in view.edges.iter().filter(|edge| ending.contains(&edge.to) && forth[edge.from]) {
        let Cause::State(id, state) = edge.cause else { continue };
        let element = &view.plan.elements[id.index()];
        let place = element.edges.outcomes.get(usize::from(state)).copied().flatten();
        let message = message!("'{}' ends the plan, which is declared 'forever'", element.name);
        diags.push(
            Diagnostic::new(Code::E0320, place.unwrap_or(element.span), message)
                .help("lead the state to an element, or remove 'forever' after the plan's name"),
        );
    }
}

/// The possible endings.
pub(super) fn endings(view: &View<'_>) -> [bool; 3] {
    ends(view, &forward(view))
}

fn ends(view: &View<'_>, forth: &[bool]) -> [bool; 3] {
    let mut ends = [OK, INTERRUPTED, FAILED].map(|ending| forth[view.end(ending)]);
    ends[FAILED] |= failing(view).any(|node| forth[node]);
    ends
}

/// Sub-plans that can fail without an `Error` edge, which ends the plan.
fn failing<'v>(view: &'v View<'_>) -> impl Iterator<Item = Node> + 'v {
    let fails = |element| view.summary(element).is_some_and(|inner| inner.ends[FAILED]);
    let elements = view.plan.elements.iter().enumerate();
    elements.filter(move |(_, e)| e.on_error.is_none() && fails(e)).map(|(node, _)| node)
}

fn forward(view: &View<'_>) -> Vec<bool> {
    let mut seen = vec![false; view.nodes()];
    let mut open = vec![view.start()];
    while let Some(node) = open.pop() {
        if !std::mem::replace(&mut seen[node], true) {
            open.extend(view.from(node).iter().filter(|edge| edge.possible).map(|edge| edge.to));
        }
    }
    seen
}

/// The nodes that can reach an ending.
fn backward(view: &View<'_>) -> Vec<bool> {
    let mut first = vec![0u32; view.nodes() + 1];
    // A handler that returns can reach what the suspended element can.
    let edges = || view.edges.iter().chain(&view.back).filter(|edge| edge.possible);
    for edge in edges() {
        first[edge.to + 1] += 1;
    }
    for node in 0..view.nodes() {
        first[node + 1] += first[node];
    }
    let mut next = first.clone();
    let mut into = vec![0usize; first[view.nodes()] as usize];
    for edge in edges() {
        into[next[edge.to] as usize] = edge.from;
        next[edge.to] += 1;
    }
    let mut seen = vec![false; view.nodes()];
    let mut open = vec![view.end(OK), view.end(INTERRUPTED), view.end(FAILED)];
    open.extend(failing(view));
    while let Some(node) = open.pop() {
        if !std::mem::replace(&mut seen[node], true) {
            open.extend(&into[first[node] as usize..first[node + 1] as usize]);
        }
    }
    resumed(view, &mut seen);
    seen
}

/// Adds the computations at whose `resume` an element continues that can reach an ending.
fn resumed(view: &View<'_>, seen: &mut [bool]) {
    let elements = &view.plan.elements;
    let resuming = resuming(elements.iter().map(Some));
    if !resuming.contains(&true) {
        return;
    }
    let goes_on = |(node, element): &(Node, &Element)| element.takes_time() && seen[*node];
    let goes_on: Vec<Node> = view.elements().filter(goes_on).map(|(node, _)| node).collect();
    for node in goes_on {
        for edge in view.from(node).iter().chain(view.of_globals(node)) {
            let Some(first) = u16::try_from(edge.to).ok().map(ElementId) else { continue };
            let (run, _) = chain(elements, Target::Element(first));
            for held in run.into_iter().filter(|id| resuming[id.index()]) {
                seen[held.index()] = true;
            }
        }
    }
}
