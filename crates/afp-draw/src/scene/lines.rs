//! What edges look like together: where several become one, and where one would look dashed.

use std::collections::BTreeMap;

use super::{DrawnEdge, Point};

/// Gaps nearer to each other than that, in pixels, look like those of a dashed line.
const CLOSE: f64 = 40.0;

/// How long each edge is one with others in front of their target.
pub(super) fn joined(edges: &[DrawnEdge]) -> Vec<f64> {
    let arrival = |edge: &DrawnEdge| {
        let [.., turn, tip] = edge.points[..] else { return None };
        Some(((tip.0.round() as i64, tip.1.round() as i64), tip.1 - turn.1))
    };
    let mut at: BTreeMap<_, Vec<f64>> = BTreeMap::new();
    for (tip, length) in edges.iter().filter_map(arrival) {
        at.entry(tip).or_default().push(length);
    }
    for lengths in at.values_mut() {
        lengths.sort_by(|a, b| b.total_cmp(a));
    }
    // With whom it has most in common: the longest of the others.
    let longest = |tip, own: f64| at[&tip].get(1).map_or(0.0, |second| second.min(own));
    edges.iter().map(|edge| arrival(edge).map_or(0.0, |(tip, own)| longest(tip, own))).collect()
}

/// How often each edge is crossed twice in a short distance. One that lies above those that cross it has no gaps.
pub(super) fn dashes(edges: &[DrawnEdge]) -> Vec<usize> {
    let mut dashes = vec![0; edges.len()];
    let (upright, level) = (segments(edges, true), segments(edges, false));
    for (along, across) in [(&upright, &level), (&level, &upright)] {
        for line in along {
            let first = across.partition_point(|other| other.at <= line.from);
            let passed = across[first..].iter().take_while(|other| other.at < line.to);
            let crossed = passed.filter(|other| {
                other.edge != line.edge && other.from < line.at && line.at < other.to
            });
            let places: Vec<f64> = crossed.map(|other| other.at).collect();
            dashes[line.edge] += places.windows(2).filter(|pair| pair[1] - pair[0] < CLOSE).count();
        }
    }
    dashes
}

/// A straight piece of an edge.
struct Segment {
    edge: usize,
    /// The coordinate that its points have in common.
    at: f64,
    from: f64,
    to: f64,
}

/// The upright or the level pieces, by where they are.
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
