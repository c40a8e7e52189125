//! The endings that a plan can reach in its first step.

use super::decided::{self, Known};
use super::ending_of;
use crate::flow::strong;
use crate::flow::view::{Cause, Edge, View};

/// `quick` are the edges that take no time. The plan's global supervisors start and are polled in
/// the same step, so their events count. Computations take known decisions.
pub(super) fn endings(view: &View<'_>, quick: &[Edge]) -> [bool; 2] {
    let first = strong::first(view.nodes(), quick.iter().map(|edge| edge.from));
    let mut entered: Vec<Option<Known>> = vec![None; view.nodes()];
    entered[view.start()] = Some(decided::at_start(view));
    let mut open = vec![view.start()];
    let mut ends = [false, false];
    while let Some(node) = open.pop() {
        if let Some(ending) = ending_of(view, node) {
            ends[ending] = true;
        }
        let known = entered[node].clone().unwrap_or_default();
        // Quick edges are grouped by their origin, in the order of nodes.
        let own = quick[first[node] as usize..first[node + 1] as usize].iter();
        let events = view
            .of_globals(node)
            .filter(|edge| matches!(edge.cause, Cause::Event(..) | Cause::On(_, _, Some(_))));
        for edge in own.chain(events).filter(|edge| !decided::excludes(view, edge.cause, &known)) {
            let mut then = known.clone();
            decided::after(view, edge.cause, &mut then);
            if joins(&mut entered[edge.to], then) {
                open.push(edge.to);
            }
        }
    }
    ends
}

/// Intersects the known values of a node with those of another path. Returns whether this changes
/// them, or is the first path.
fn joins(entered: &mut Option<Known>, then: Known) -> bool {
    let Some(known) = entered else {
        *entered = Some(then);
        return true;
    };
    let before = known.len();
    known.retain(|entry, value| then.get(entry) == Some(value));
    known.len() < before
}
