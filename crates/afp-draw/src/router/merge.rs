//! Edges that merge before their target.
//!
//! An edge from the side takes the path of the next edge of its kind for its last part, so that
//! several edges to one box end in one tip. No other kind is between them, so this adds no
//! crossings.

use std::collections::BTreeSet;

use super::bundle::Junction;
use super::{Connector, PITCH, Point, TIP};

/// An edge's behaviour before its target.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Join {
    /// It has its own tip.
    None,
    /// It joins the nearest edge there: the box is too narrow for more.
    Nearest,
    Edge(usize),
    /// It ends on an edge of its bundle, before the target.
    At(Junction),
}

impl Join {
    /// The edge stays on its line, because another one comes along it from above: moved to another
    /// tip, that one could meet a box.
    pub(super) fn keep_line(&mut self) {
        if let Join::Nearest | Join::Edge(_) = self {
            *self = Join::None;
        }
    }

    /// Its end on an edge of its bundle.
    pub(super) fn junction(&self) -> Option<Junction> {
        match self {
            Join::At(junction) => Some(*junction),
            _ => None,
        }
    }
}

/// Merges edges of one kind that arrive side by side from the side with one of them, from above if
/// possible. Returns whether an edge joins that did not before.
pub(super) fn merged(
    connectors: &[Connector],
    corners: &[Vec<Point>],
    fixed: &[bool],
    joins: &mut [Join],
) -> bool {
    let mut changed = false;
    let tip = |edge: &usize| corners[*edge].last().map_or(0.0, |tip| tip.0);
    let arrives = |edge: &usize| joins[*edge] == Join::None && !corners[*edge].is_empty();
    let mut arrivals: Vec<usize> = (0..connectors.len()).filter(arrives).collect();
    arrivals
        .sort_by(|a, b| connectors[*a].to.cmp(&connectors[*b].to).then(tip(a).total_cmp(&tip(b))));
    let alike = |a: &usize, b: &usize| {
        (connectors[*a].to, connectors[*a].kind) == (connectors[*b].to, connectors[*b].kind)
    };
    let continued: BTreeSet<usize> =
        joins.iter().filter_map(Join::junction).filter(|on| on.along).map(|on| on.edge).collect();
    for run in arrivals.chunk_by(alike).filter(|run| run.len() > 1) {
        let from_side = |edge: &usize| comes_from_the_side(&corners[*edge]);
        let joins_in = |edge: &usize| !fixed[*edge] && !continued.contains(edge) && from_side(edge);
        let straight: Vec<usize> = run.iter().copied().filter(|edge| !joins_in(edge)).collect();
        let middle = [run[run.len() / 2]];
        let trunks = if straight.is_empty() { &middle[..] } else { &straight[..] };
        for edge in run.iter().filter(|edge| !trunks.contains(edge)) {
            let far = |trunk: &&usize| (tip(trunk) - tip(edge)).abs();
            let nearest = trunks.iter().min_by(|a, b| far(a).total_cmp(&far(b)));
            joins[*edge] = nearest.map_or(Join::None, |trunk| Join::Edge(*trunk));
            changed |= nearest.is_some();
        }
    }
    changed
}

/// Whether an edge only turns down at the end, in the space for its tip.
fn comes_from_the_side(points: &[Point]) -> bool {
    let [.., before, turn, tip] = points else { return false };
    (before.1 - turn.1).abs() < 0.5 && tip.1 - turn.1 <= TIP + PITCH
}
