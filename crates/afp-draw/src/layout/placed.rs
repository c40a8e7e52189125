//! A layout in which some nodes have given places: they stay, and the others go around them.
//!
//! The others keep the places of the automatic layout relative to placed neighbours, or take the
//! nearest free places. Edges are then routed through the remaining gaps.

use super::super::router::{self, Bounds, Connector, Point};
use super::{LaidOut, Link, Node, Rows, arranged, bounds, connectors};

/// Distance between two boxes, unless the automatic layout has a shorter one.
const GAP: f64 = 48.0;

/// Minimum distance of a kept route from a box: less than the router's distance.
const NEAR: f64 = 6.0;

/// Minimum vertical distance between two boxes: space for an edge and for the tip of an arrow.
pub(in super::super) const ABOVE: f64 = 36.0;

/// Minimum horizontal distance between two boxes: space for an edge.
const BESIDE: f64 = 24.0;

/// Routes the edges of placed nodes. A route stays if its ends have not moved and no box is too
/// near.
pub(in super::super) fn routed(
    nodes: &[Node],
    links: &[Link],
    corners: Vec<Point>,
    known: Vec<Option<Vec<Point>>>,
) -> LaidOut {
    let (boxes, connectors) = (bounds(nodes, &corners), connectors(nodes, links, &corners));
    let near = NearBoxes::new(&boxes);
    let kept: Vec<_> = known
        .into_iter()
        .zip(&connectors)
        .map(|(route, connector)| route.filter(|route| is_still_good(route, connector, &near)))
        .collect();
    let found = router::route(&boxes, &connectors, &kept);
    LaidOut::new(nodes, corners, found.corners)
}

/// Whether a route has the ends of its edge and keeps its distance from boxes.
fn is_still_good(route: &[Point], connector: &Connector, boxes: &NearBoxes<'_>) -> bool {
    let (Some(start), Some(tip)) = (route.first(), route.last()) else { return false };
    let (left, right) = connector.arrival;
    let near = |a: f64, b: f64| (a - b).abs() < 0.01;
    let starts = near(start.0, connector.start.0) && near(start.1, connector.start.1);
    let ends =
        starts && near(tip.1, connector.tip) && left <= tip.0 + 0.01 && tip.0 <= right + 0.01;
    let last = route.len().saturating_sub(2);
    let free = |(at, pair): (usize, &[Point])| {
        boxes.passed(pair[0], pair[1]).all(|index| {
            // Its ends touch its own boxes.
            index == connector.from && at <= 1 || index == connector.to && at == last
        })
    };
    ends && route.windows(2).enumerate().all(free)
}

/// Boxes, indexed by position.
struct NearBoxes<'b> {
    boxes: &'b [Bounds],
    /// Indices from left to right, and from top to bottom.
    by_left: Vec<usize>,
    by_top: Vec<usize>,
    /// Maximum width and height.
    greatest: Point,
}

impl<'b> NearBoxes<'b> {
    fn new(boxes: &'b [Bounds]) -> NearBoxes<'b> {
        let sorted = |by: fn(&Bounds) -> f64| {
            let mut all: Vec<_> = (0..boxes.len()).collect();
            all.sort_by(|one, other| by(&boxes[*one]).total_cmp(&by(&boxes[*other])));
            all
        };
        let greatest = |of: fn(&Bounds) -> f64| boxes.iter().map(of).fold(0.0, f64::max);
        NearBoxes {
            boxes,
            by_left: sorted(|each| each.left),
            by_top: sorted(|each| each.top),
            greatest: (greatest(|it| it.right - it.left), greatest(|it| it.bottom - it.top)),
        }
    }

    /// The boxes that a line from one point to another passes too closely.
    fn passed(&self, a: Point, b: Point) -> impl Iterator<Item = usize> {
        let (left, right) = (a.0.min(b.0) - NEAR, a.0.max(b.0) + NEAR);
        let (top, bottom) = (a.1.min(b.1) - NEAR, a.1.max(b.1) + NEAR);
        let (order, from, to, of): (_, _, _, fn(&Bounds) -> f64) = match right - left < bottom - top
        {
            true => (&self.by_left, left - self.greatest.0, right, |it| it.left),
            false => (&self.by_top, top - self.greatest.1, bottom, |it| it.top),
        };
        let first = order.partition_point(|index| of(&self.boxes[*index]) < from);
        let near = order[first..].iter().take_while(move |index| of(&self.boxes[**index]) < to);
        near.copied().filter(move |index| {
            let each = &self.boxes[*index];
            each.left < right && left < each.right && each.top < bottom && top < each.bottom
        })
    }
}

/// The corner of each node. `fixed` nodes stay. The others take the nearest free places to their
/// `wished` place, or to their place in the automatic layout relative to the fixed nodes.
pub(in super::super) fn places(
    nodes: &[Node],
    links: &[Link],
    fixed: &[Option<Point>],
    wished: &[Option<Point>],
) -> Vec<Point> {
    let mut corners = fixed.to_vec();
    for (node, wish) in wished.iter().enumerate() {
        let Some(wish) = wish.filter(|_| corners[node].is_none()) else { continue };
        corners[node] = Some(nodes[node].whole(nearest(nodes, &corners, node, wish, |_| BESIDE)));
    }
    if corners.iter().all(Option::is_some) {
        return corners.into_iter().flatten().collect();
    }
    // Not folded: a new node should be next to its neighbours.
    let grid = arranged(nodes, links);
    let automatic = Rows::new(&grid, nodes).corners(&grid, nodes);
    let fixed = corners.clone();
    let mut free: Vec<_> = (0..nodes.len()).filter(|node| fixed[*node].is_none()).collect();
    free.sort_by(|a, b| automatic[*a].1.total_cmp(&automatic[*b].1));
    for node in free {
        let (dx, dy) = shift(node, links, &fixed, &automatic);
        let wish = (automatic[node].0 + dx, automatic[node].1 + dy);
        // Two boxes may have the distance of the automatic layout.
        let gap = |other: usize| apart(nodes, &automatic, node, other).clamp(BESIDE, GAP);
        corners[node] = Some(nodes[node].whole(nearest(nodes, &corners, node, wish, gap)));
    }
    corners.into_iter().zip(automatic).map(|(corner, other)| corner.unwrap_or(other)).collect()
}

/// The offset between the placed neighbours of a node, or else all placed nodes, and their
/// automatic places.
fn shift(
    node: usize,
    links: &[Link],
    fixed: &[Option<(f64, f64)>],
    automatic: &[(f64, f64)],
) -> (f64, f64) {
    let ends = links.iter().flat_map(|link| [(link.from, link.to), (link.to, link.from)]);
    let near: Vec<_> = ends.filter(|(one, _)| *one == node).map(|(_, other)| other).collect();
    let shift =
        |other: usize| fixed[other].map(|(x, y)| (x - automatic[other].0, y - automatic[other].1));
    let mut shifts: Vec<_> = near.into_iter().filter_map(shift).collect();
    if shifts.is_empty() {
        shifts = (0..fixed.len()).filter_map(shift).collect();
    }
    let count = shifts.len().max(1) as f64;
    let sum = shifts.iter().fold((0.0, 0.0), |sum, one| (sum.0 + one.0, sum.1 + one.1));
    (sum.0 / count, sum.1 / count)
}

/// The free place nearest to a node's wish: straight down from it, or next to it; for the first
/// node, straight up.
fn nearest(
    nodes: &[Node],
    corners: &[Option<Point>],
    node: usize,
    wish: Point,
    gap: impl Fn(usize) -> f64,
) -> Point {
    let (width, height) = (nodes[node].width, nodes[node].height);
    let along: fn(Bounds, Point, Point) -> Point = match node {
        0 => |way, (x, _), (_, height)| (x, way.top - GAP - height),
        _ => |way, (x, _), _| (x, way.bottom + GAP),
    };
    let past: [fn(Bounds, Point, Point) -> Point; 3] = [
        along,
        |way, (_, y), _| (way.right + GAP, y),
        |way, (_, y), (width, _)| (way.left - GAP - width, y),
    ];
    let slid = past.map(|past| {
        let mut corner = wish;
        while let Some(way) = obstacle(nodes, corners, node, corner, &gap) {
            corner = past(way, corner, (width, height));
        }
        corner
    });
    let far = |at: &Point| (at.0 - wish.0).abs() + (at.1 - wish.1).abs();
    slid.into_iter().min_by(|a, b| far(a).total_cmp(&far(b))).unwrap_or(wish)
}

/// The distance of two boxes, horizontally or vertically, the larger one.
fn apart(nodes: &[Node], corners: &[Point], one: usize, other: usize) -> f64 {
    let ((x, y), (to_x, to_y)) = (corners[one], corners[other]);
    let across = (to_x - x - nodes[one].width).max(x - to_x - nodes[other].width);
    let down = (to_y - y - nodes[one].height).max(y - to_y - nodes[other].height);
    across.max(down)
}

/// The combined bounds of all nodes nearer than `gap` to a node's place.
fn obstacle(
    nodes: &[Node],
    corners: &[Option<Point>],
    node: usize,
    (x, y): Point,
    gap: impl Fn(usize) -> f64,
) -> Option<Bounds> {
    let own = &nodes[node];
    let meets = |other: usize| {
        let (left, top) = corners[other]?;
        let (right, bottom) = (left + nodes[other].width, top + nodes[other].height);
        // Sums in a different order differ in the last digits.
        let gap = gap(other) - 0.01;
        let above = gap.max(ABOVE);
        let apart = x + own.width + gap <= left
            || right + gap <= x
            || y + own.height + above <= top
            || bottom + above <= y;
        (!apart).then_some(Bounds { left, top, right, bottom })
    };
    (0..nodes.len()).filter_map(meets).reduce(Bounds::with)
}
