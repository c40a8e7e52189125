//! Edges of one kind to one target that merge where they meet.
//!
//! If many edges lead to one box, such as all errors to their handler, each goes only to the next
//! edge. They form a tree with one tip, so that readers need not distinguish parallel lines.

use std::collections::{BTreeMap, BTreeSet};

use super::lines::{Lines, axis_of, side_of};
use super::{Axis, Connector, PITCH, Point, TIP};
use crate::polyline::{self, distance};

/// The minimum number of edges in a bundle.
const MANY: usize = 5;

/// For each edge, given by its start, its target and its kind: its bundle.
pub(in super::super) fn bundles<'a>(
    edges: impl Iterator<Item = (usize, usize, &'a str)> + Clone,
) -> Vec<Option<usize>> {
    let mut groups: BTreeMap<(usize, &str), (usize, usize)> = BTreeMap::new();
    let apart = edges.clone().filter(|(from, to, _)| from != to);
    for (_, to, kind) in apart {
        let number = groups.len();
        groups.entry((to, kind)).or_insert((number, 0)).1 += 1;
    }
    let bundle = |(from, to, kind)| {
        let (number, count) = groups.get(&(to, kind))?;
        (from != to && *count >= MANY).then_some(*number)
    };
    edges.map(bundle).collect()
}

/// The end of an edge on another edge of its bundle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Junction {
    /// The joined edge.
    pub(super) edge: usize,
    /// The part of that edge, by its first corner.
    pub(super) part: usize,
    /// The direction in which that part continues.
    pub(super) side: usize,
    /// Whether the last part of the joining edge is on that line, too, and does not arrive from its
    /// side.
    pub(super) along: bool,
}

impl Junction {
    /// The axis of the joined line.
    pub(super) fn axis(&self) -> Axis {
        axis_of(self.side)
    }

    /// The junction without an unnecessary bend. An edge from nearly the line of the joined edge
    /// takes that line, before it or after its next corner. Such near lines could not be kept
    /// apart.
    pub(super) fn aligned(self, points: &mut Vec<Point>, joined: &[Point]) -> Junction {
        let [.., before, end] = points[..] else { return self };
        let side = side_of(before, end);
        let can_bend = points.len() > 2;
        if axis_of(side) == self.axis() {
            return Junction { along: can_bend && side == self.side, ..self };
        }
        if let [.., _, third, _, _] = points[..]
            && distance(before, end) < PITCH
            && side_of(third, before) == self.side
        {
            points.pop();
            return Junction { along: true, ..self };
        }
        let ahead = self.corner(points, joined).filter(|corner| corner.junction.along);
        ahead.map_or(self, |corner| corner.junction)
    }

    /// The corner of the joined edge near the end of an edge from its side: the earlier corner if
    /// the line continues there in the edge's direction, or else the later one.
    pub(super) fn corner(self, points: &[Point], joined: &[Point]) -> Option<Corner> {
        let [_, .., before, end] = points[..] else { return None };
        let side = side_of(before, end);
        let axis = axis_of(side);
        if self.along || axis == self.axis() || before == end {
            return None;
        }
        let near = |corner: &Point| (axis.across(*corner) - axis.across(end)).abs() < PITCH;
        let ahead = joined.get(self.part + 1).zip(joined.get(self.part + 2));
        let ahead =
            ahead.filter(|(corner, next)| near(corner) && side_of(**corner, **next) == side);
        if let Some((at, _)) = ahead {
            let junction = Junction { part: self.part + 1, side, along: true, ..self };
            return Some(Corner { at: *at, junction });
        }
        let behind = joined.get(self.part).filter(|corner| self.part > 0 && near(corner))?;
        Some(Corner { at: *behind, junction: self })
    }
}

/// A better end of an edge: a near corner of the joined edge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Corner {
    pub(super) at: Point,
    pub(super) junction: Junction,
}

/// The edges of a bundle, by the nodes of the search.
pub(super) type Tree = BTreeMap<u32, Junction>;

#[derive(Debug)]
pub(super) struct Trees {
    bundle_of: Vec<Option<usize>>,
    trees: BTreeMap<usize, Tree>,
}

impl Trees {
    pub(super) fn new(connectors: &[Connector]) -> Trees {
        let ends =
            connectors.iter().map(|connector| (connector.from, connector.to, connector.kind));
        Trees { bundle_of: bundles(ends), trees: BTreeMap::new() }
    }

    /// The length that each edge shares with another edge of its bundle; edges without corners are
    /// left out.
    pub(super) fn shared(&self, corners: &[Vec<Point>]) -> Vec<f64> {
        let mut groups: BTreeMap<usize, Vec<(usize, &[Point])>> = BTreeMap::new();
        for (edge, points) in corners.iter().enumerate().filter(|(_, points)| !points.is_empty()) {
            let Some(bundle) = self.bundle_of[edge] else { continue };
            groups.entry(bundle).or_default().push((edge, points));
        }
        let mut shared = vec![0.0; corners.len()];
        for common in groups.into_values().flat_map(polyline::common) {
            shared[common.second] = common.length;
        }
        shared
    }

    pub(super) fn holds(&self, edge: usize) -> bool {
        self.bundle_of[edge].is_some()
    }

    /// The tree that an edge can join.
    pub(super) fn of(&self, edge: usize) -> Option<&Tree> {
        self.trees.get(&self.bundle_of[edge]?).filter(|tree| !tree.is_empty())
    }

    pub(super) fn remove(&mut self, edges: &BTreeSet<usize>) {
        let bundles: BTreeSet<_> = edges.iter().filter_map(|edge| self.bundle_of[*edge]).collect();
        for bundle in bundles {
            if let Some(tree) = self.trees.get_mut(&bundle) {
                tree.retain(|_, junction| !edges.contains(&junction.edge));
            }
        }
    }

    /// Adds the corners of an edge to the tree of its bundle, without its start: another edge there
    /// would seem to come from its exit.
    pub(super) fn add(&mut self, edge: usize, corners: &[Point], lines: &Lines) {
        let Some(bundle) = self.bundle_of[edge] else { return };
        let tree = self.trees.entry(bundle).or_default();
        let Some(start) = corners.first() else { return };
        for (part, pair) in corners.windows(2).enumerate() {
            let side = side_of(pair[0], pair[1]);
            for node in lines.along(pair[0], pair[1]) {
                let (x, y) = lines.positions[node as usize];
                let leaves = part == 0 && distance((x, y), *start) < TIP;
                // At a corner, the part after it is joined.
                let turns = part + 2 < corners.len() && distance((x, y), pair[1]) < 0.05;
                if !leaves && !turns {
                    tree.entry(node).or_insert(Junction { edge, part, side, along: false });
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{MANY, bundles};

    #[test]
    fn many_edges_of_a_kind_to_one_box_are_a_bundle() {
        let mut edges = vec![(9, 0, "error"), (0, 0, "error"), (1, 0, "state")];
        edges.extend((1..MANY).map(|from| (from, 0, "error")));
        let found = bundles(edges.iter().copied());
        assert_eq!(found[..3], [Some(0), None, None], "loops and other kinds stay apart");
        assert!(found[3..].iter().all(|bundle| *bundle == Some(0)));
        edges.pop();
        assert!(bundles(edges.into_iter()).iter().all(Option::is_none), "too few");
    }
}
