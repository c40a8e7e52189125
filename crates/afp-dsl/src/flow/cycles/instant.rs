//! Which endings of a plan can come in the very step that starts it.

use super::ending_of;
use crate::flow::view::{Cause, Edge, View};

/// `quick` are the edges that take no time. The plan's own global supervisors are started and asked
/// in the same step, so here their events count.
pub(super) fn endings(view: &View<'_>, quick: &[Edge]) -> [bool; 2] {
    let mut first = vec![0usize; view.nodes() + 1];
    quick.iter().for_each(|edge| first[edge.from + 1] += 1);
    for node in 0..view.nodes() {
        first[node + 1] += first[node];
    }
    let mut seen = vec![false; view.nodes()];
    let mut open = vec![view.start()];
    let mut ends = [false, false];
    while let Some(node) = open.pop() {
        if std::mem::replace(&mut seen[node], true) {
            continue;
        }
        if let Some(ending) = ending_of(view, node) {
            ends[ending] = true;
        }
        // Quick edges are grouped by their origin, in the order of the nodes.
        open.extend(quick[first[node]..first[node + 1]].iter().map(|edge| edge.to));
        let events = view
            .of_globals(node)
            .filter(|edge| matches!(edge.cause, Cause::Event(..) | Cause::On(_, _, Some(_))));
        open.extend(events.map(|edge| edge.to));
    }
    ends
}
