//! A layout in which some nodes have places of their own: those stay, the others go around them.
//!
//! The others keep the places of the automatic layout relative to placed neighbours and give way
//! downwards. Edges then find their ways through the gaps that are left.

use super::super::router;
use super::{Layout, Link, Node, bounds, layout, moved_to_origin, wires};

/// Least distance between a box that gives way and the next one.
const GAP: f64 = 48.0;

/// Lays out the nodes; `fixed` has the upper left corner of those that stay where they are, in
/// pixels. The result is moved as a whole, so that nothing is left of or above the origin.
pub(in super::super) fn layout_around(
    nodes: &[Node],
    links: &[Link],
    fixed: &[Option<(f64, f64)>],
) -> Layout {
    let automatic = layout(nodes, links);
    if fixed.iter().all(Option::is_none) {
        return automatic;
    }
    let corners = places(nodes, links, fixed, &automatic.corners);
    let found = router::route(&bounds(nodes, &corners), &wires(nodes, links, &corners), &[]);
    moved_to_origin(nodes, corners, found.corners)
}

/// The corner of each node.
fn places(
    nodes: &[Node],
    links: &[Link],
    fixed: &[Option<(f64, f64)>],
    automatic: &[(f64, f64)],
) -> Vec<(f64, f64)> {
    let mut corners: Vec<_> = fixed.to_vec();
    let mut free: Vec<_> = (0..nodes.len()).filter(|node| fixed[*node].is_none()).collect();
    free.sort_by(|a, b| automatic[*a].1.total_cmp(&automatic[*b].1));
    for node in free {
        let (dx, dy) = shift(node, links, fixed, automatic);
        let mut corner = (automatic[node].0 + dx, automatic[node].1 + dy);
        while let Some(bottom) = obstacle(nodes, &corners, node, corner) {
            corner.1 = bottom + GAP;
        }
        corners[node] = Some(corner);
    }
    corners.into_iter().zip(automatic).map(|(corner, other)| corner.unwrap_or(*other)).collect()
}

/// How far the placed neighbours of a node, else all placed nodes, are from where they would be.
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

/// The lower border of a node that lies where another one would go.
fn obstacle(
    nodes: &[Node],
    corners: &[Option<(f64, f64)>],
    node: usize,
    (x, y): (f64, f64),
) -> Option<f64> {
    let own = &nodes[node];
    let meets = |other: usize| {
        let (left, top) = corners[other]?;
        let (right, bottom) = (left + nodes[other].width, top + nodes[other].height);
        let apart = x + own.width + GAP <= left
            || right + GAP <= x
            || y + own.height + GAP <= top
            || bottom + GAP <= y;
        (!apart).then_some(bottom)
    };
    (0..nodes.len()).filter_map(meets).reduce(f64::max)
}
