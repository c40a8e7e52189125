//! What edges look like together: where several become one, and where one would look dashed.

use super::{DrawnEdge, Point};

/// Gaps nearer to each other than that, in pixels, look like those of a dashed line.
const CLOSE: f64 = 40.0;

/// How long each edge is one with another one in front of their target.
pub(super) fn joined(edges: &[DrawnEdge]) -> Vec<f64> {
    // From their tips, those that have most in common stand side by side.
    let backwards = |edge: &DrawnEdge| edge.points.iter().rev().copied().collect::<Vec<Point>>();
    let mut sorted: Vec<(Vec<Point>, usize)> =
        edges.iter().enumerate().map(|(index, edge)| (backwards(edge), index)).collect();
    let compare = |a: &Point, b: &Point| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1));
    sorted.sort_by(|(one, _), (two, _)| {
        let differ = one.iter().zip(two).map(|(a, b)| compare(a, b)).find(|order| order.is_ne());
        differ.unwrap_or(one.len().cmp(&two.len()))
    });
    let mut joined = vec![0.0; edges.len()];
    for pair in sorted.windows(2) {
        let [(one, first), (two, second)] = pair else { continue };
        let common = common(one, two);
        for edge in [*first, *second] {
            joined[edge] = common.max(joined[edge]);
        }
    }
    joined
}

/// How long two edges are the same from their tips on.
fn common(one: &[Point], two: &[Point]) -> f64 {
    let mut length = 0.0;
    for (own, other) in one.windows(2).zip(two.windows(2)) {
        if own[0] != other[0] {
            return 0.0;
        }
        let (along, beside) = (leg(own), leg(other));
        if along.0 != beside.0 {
            return length;
        }
        length += along.1.min(beside.1);
        if along.1 != beside.1 {
            return length;
        }
    }
    length
}

/// The direction of a straight piece, and how long it is.
fn leg(ends: &[Point]) -> ((i8, i8), f64) {
    let sign = |from: f64, to: f64| if from < to { 1 } else { -i8::from(to < from) };
    let (from, to) = (ends[0], ends[1]);
    ((sign(from.0, to.0), sign(from.1, to.1)), (from.0 - to.0).abs() + (from.1 - to.1).abs())
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
