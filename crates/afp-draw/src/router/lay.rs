//! Lays routes, one edge after the other, and moves edges that are too near to each other.

use std::collections::BTreeSet;

use super::bundle::Trees;
use super::lines::Lines;
use super::merge::{Join, merged};
use super::search::Search;
use super::spread::Spread;
use super::{BUDGET, Bounds, Connector, Crowded, LEAST, PITCH, Point, Routes};
use crate::polyline::shortened;

/// The number of times that near edges are moved.
const DETOURS: usize = 5;

/// The maximum number of edges that move at once.
const MOST_MOVED: usize = 32;

/// Edges on their lines, before those on a common line are moved apart.
pub(super) struct Laid<'a> {
    boxes: &'a [Bounds],
    connectors: &'a [Connector],
    lines: &'a Lines,
    search: Search<'a>,
    trees: Trees,
    /// The corners of each edge up to its tip, or to the joined edge.
    corners: Vec<Vec<Point>>,
    joins: Vec<Join>,
    /// Which edges are fixed.
    fixed: Vec<bool>,
    /// The other edges, each after its joined edge.
    order: Vec<usize>,
}

impl<'a> Laid<'a> {
    /// Starts with only the edges that already have corners.
    pub(super) fn new(
        boxes: &'a [Bounds],
        connectors: &'a [Connector],
        lines: &'a Lines,
        mut trees: Trees,
        corners: Vec<Vec<Point>>,
    ) -> Laid<'a> {
        // A shared line counts once.
        let shared = trees.shared(&corners);
        let own = corners.iter().zip(shared).map(|(points, shared)| shortened(points, shared));
        let search = Search::new(lines, boxes, &own.collect::<Vec<_>>());
        for (connector, points) in corners.iter().enumerate() {
            trees.add(connector, points, lines);
        }
        let joins = vec![Join::None; connectors.len()];
        let fixed = corners.iter().map(|points| !points.is_empty()).collect();
        Laid { boxes, connectors, lines, search, trees, corners, joins, fixed, order: Vec::new() }
    }

    /// Lays an edge on the cheapest path; with `full` it arrives from the side.
    fn lay(&mut self, connector: usize, full: bool) {
        let tree = self.trees.of(connector);
        let (mut points, junction) =
            self.search.route(&self.connectors[connector], self.boxes, full, tree);
        let alone = if full { Join::Nearest } else { Join::None };
        let aligned = junction.map(|on| on.aligned(&mut points, &self.corners[on.edge]));
        if let Some(on) = aligned.filter(|on| on.along) {
            self.joins[on.edge].keep_line();
        }
        self.joins[connector] = aligned.map_or(alone, Join::At);
        self.trees.add(connector, &points, self.lines);
        self.corners[connector] = points;
        self.order.push(connector);
    }

    /// Lays edges, each so that it can join earlier ones.
    pub(super) fn lay_all(&mut self, order: &[usize]) {
        for connector in order {
            let full = self.search.is_full(&self.connectors[*connector]);
            self.lay(*connector, full);
        }
    }

    /// Moves all edges apart; if that is impossible, reroutes some as long as it helps.
    pub(super) fn routes(mut self) -> Routes {
        let mut best = self.merged();
        let mut tried = vec![false; self.connectors.len()];
        for _ in 0..DETOURS {
            let detours = detours(&best.crowded, &mut tried);
            if detours.is_empty() || self.search.effort() > BUDGET {
                break;
            }
            for narrow in &detours {
                self.lead_elsewhere(narrow);
            }
            let found = self.merged();
            if squeezed(&found) < squeezed(&best) {
                best = found;
            }
        }
        Routes { effort: self.search.effort(), ..best }
    }

    /// Moves the edges apart and merges edges that arrive side by side.
    fn merged(&mut self) -> Routes {
        let apart = self.apart();
        let changed = merged(self.connectors, &apart.corners, &self.fixed, &mut self.joins);
        if changed { self.apart() } else { apart }
    }

    fn apart(&self) -> Routes {
        let mut corners = self.corners.clone();
        let Laid { boxes, connectors, fixed, joins, order, .. } = self;
        let crowded = Spread { boxes, connectors, fixed, joins, order }.apply(&mut corners);
        Routes { corners, crowded, effort: 0 }
    }

    /// Lays an edge again, away from a narrow place, with all edges that have joined it; not if
    /// these are many.
    fn lead_elsewhere(&mut self, narrow: &Crowded) {
        let mut moved = BTreeSet::from([narrow.edge]);
        let mut again = vec![narrow.edge];
        for edge in &self.order {
            let junction = self.joins[*edge].junction();
            if junction.is_some_and(|on| moved.contains(&on.edge)) && moved.insert(*edge) {
                again.push(*edge);
            }
        }
        if self.fixed[narrow.edge] || again.len() > MOST_MOVED {
            return;
        }
        self.search.avoid(narrow);
        self.trees.remove(&moved);
        self.order.retain(|edge| !moved.contains(edge));
        for edge in again {
            let full = edge == narrow.edge && narrow.arrives || self.joins[edge] == Join::Nearest;
            self.lay(edge, full);
        }
    }
}

/// The number of parts that are too near to each other.
fn squeezed(routes: &Routes) -> usize {
    routes.crowded.iter().filter(|part| part.distance < LEAST).count()
}

/// From each group of edges that are too near, one edge to reroute: first those that can join
/// another edge at their target, and no edge twice.
fn detours(crowded: &[Crowded], tried: &mut [bool]) -> Vec<Crowded> {
    let mut chosen: Vec<Crowded> = Vec::new();
    for arrives in [true, false] {
        for part in crowded.iter().filter(|part| part.distance < LEAST && part.arrives == arrives) {
            let beside = |other: &Crowded| {
                let near = (other.at - part.at).abs() < 4.0 * PITCH && other.axis == part.axis;
                near && other.span.0 < part.span.1 && part.span.0 < other.span.1
            };
            if !tried[part.edge] && !chosen.iter().any(beside) {
                tried[part.edge] = true;
                chosen.push(*part);
            }
        }
    }
    chosen
}
