//! The appearance of edges together: merged edges, and edges that would look dashed.

use super::{DrawnEdge, Point};
use crate::polyline::{self, Common};

/// Gaps within this distance, in pixels, look like a dashed line.
const CLOSE: f64 = 40.0;

/// The length that each edge shares with another one before their target.
pub(super) fn joined(edges: &[DrawnEdge]) -> Vec<f64> {
    let mut joined = vec![0.0; edges.len()];
    let routes = edges.iter().map(|edge| &edge.points[..]).enumerate().collect();
    for Common { first, second, length } in polyline::common(routes) {
        for edge in [first, second] {
            joined[edge] = length.max(joined[edge]);
        }
    }
    joined
}

/// How often each edge is crossed twice in a short distance. An edge above its crossing edges has
/// no gaps.
pub(super) fn dashes(edges: &[DrawnEdge]) -> Vec<usize> {
    let mut dashes = vec![0; edges.len()];
    let (upright, level) = (segments(edges, true), segments(edges, false));
    // The last crossing of each horizontal piece: vertical pieces come from left to right.
    let mut last = vec![f64::NEG_INFINITY; level.len()];
    for line in &upright {
        let first = level.partition_point(|other| other.at <= line.from);
        let passed = level.iter().enumerate().skip(first);
        let passed = passed.take_while(|(_, other)| other.at < line.to);
        let crossed = passed.filter(|(_, other)| {
            other.edge != line.edge && other.from < line.at && line.at < other.to
        });
        let mut above = f64::NEG_INFINITY;
        for (index, other) in crossed {
            dashes[line.edge] += usize::from(other.at - above < CLOSE);
            dashes[other.edge] += usize::from(line.at - last[index] < CLOSE);
            (above, last[index]) = (other.at, line.at);
        }
    }
    dashes
}

/// A straight piece of an edge.
struct Segment {
    edge: usize,
    /// The common coordinate of its points.
    at: f64,
    from: f64,
    to: f64,
}

/// The vertical or the horizontal pieces, by position.
fn segments(edges: &[DrawnEdge], upright: bool) -> Vec<Segment> {
    let mut found = Vec::new();
    for (edge, drawn) in edges.iter().enumerate() {
        for pair in drawn.points.windows(2) {
            let [a, b] =
                [pair[0], pair[1]].map(|(x, y): Point| if upright { (x, y) } else { (y, x) });
            if a.0 == b.0 {
                found.push(Segment { edge, at: a.0, from: a.1.min(b.1), to: a.1.max(b.1) });
            }
        }
    }
    found.sort_by(|a, b| a.at.total_cmp(&b.at));
    found
}
