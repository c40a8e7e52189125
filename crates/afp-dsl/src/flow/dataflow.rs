//! A forward dataflow analysis on bit sets: which of 64 questions reach each node, if edges stop
//! some of them.
//!
//! "Can this be reached without passing that?" is asked for every entry and for every event of a
//! global supervisor. With one bit per question, a search answers 64 of them.

use crate::flow::view::{Node, View};

/// Number of questions per search.
pub(super) const WIDTH: usize = 64;

/// The bits that reach each node if `bits` begin at `start`; `stops` has the stopped bits of each
/// edge.
pub(super) fn propagate(view: &View<'_>, bits: u64, stops: &[u64]) -> Vec<u64> {
    let mut reached = vec![0u64; view.nodes()];
    let mut waiting = vec![false; view.nodes()];
    let mut open = std::collections::VecDeque::from([view.start()]);
    reached[view.start()] = bits;
    while let Some(node) = open.pop_front() {
        waiting[node] = false;
        for at in view.range(node) {
            let edge = &view.edges[at];
            if !edge.possible {
                continue;
            }
            let new = reached[node] & !stops[at] & !reached[edge.to];
            if new != 0 {
                reached[edge.to] |= new;
                if !std::mem::replace(&mut waiting[edge.to], true) {
                    open.push_back(edge.to);
                }
            }
        }
    }
    reached
}

/// A shortest path from `start` to `goal` along edges that `passes` accepts, as edge indices;
/// `None` if there is none.
pub(super) fn path(
    view: &View<'_>,
    goal: Node,
    passes: impl Fn(usize) -> bool,
) -> Option<Vec<usize>> {
    let mut came_by = vec![usize::MAX; view.nodes()];
    let mut seen = vec![false; view.nodes()];
    let mut open = std::collections::VecDeque::from([view.start()]);
    seen[view.start()] = true;
    while let Some(node) = open.pop_front() {
        if node == goal {
            break;
        }
        for at in view.range(node) {
            let edge = &view.edges[at];
            if edge.possible && passes(at) && !std::mem::replace(&mut seen[edge.to], true) {
                came_by[edge.to] = at;
                open.push_back(edge.to);
            }
        }
    }
    if !seen[goal] {
        return None;
    }
    let mut edges = Vec::new();
    let mut node = goal;
    while node != view.start() {
        edges.push(came_by[node]);
        node = view.edges[came_by[node]].from;
    }
    edges.reverse();
    Some(edges)
}
