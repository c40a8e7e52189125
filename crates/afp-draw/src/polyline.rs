//! Right-angled polylines: length, direction, and the common part of two polylines before their
//! end.

/// A place in pixels, y downwards.
pub type Point = (f64, f64);

/// The distance between two points along right-angled lines.
pub(crate) fn distance(a: Point, b: Point) -> f64 {
    (a.0 - b.0).abs() + (a.1 - b.1).abs()
}

/// The unit vector along a vertical or horizontal line.
pub(crate) fn direction(from: Point, to: Point) -> Point {
    let (dx, dy) = (to.0 - from.0, to.1 - from.1);
    if dx.abs() > dy.abs() { (dx.signum(), 0.0) } else { (0.0, dy.signum()) }
}

pub(crate) fn shortened(points: &[Point], mut length: f64) -> Vec<Point> {
    let mut points = points.to_vec();
    while let [.., before, end] = points[..] {
        let last = distance(before, end);
        points.pop();
        if length < last {
            let (dx, dy) = direction(end, before);
            points.push((end.0 + dx * length, end.1 + dy * length));
            break;
        }
        length -= last;
    }
    points
}

/// Two polylines with the same end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Common {
    pub(crate) first: usize,
    pub(crate) second: usize,
    /// The length of their common part before the end.
    pub(crate) length: f64,
}

/// Numbered polylines in an order in which each has as much in common with its predecessor as with
/// any earlier one. Returns the common part of each pair of neighbours.
pub(crate) fn common(polylines: Vec<(usize, &[Point])>) -> Vec<Common> {
    let mut sorted = polylines;
    let compare = |a: &Point, b: &Point| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1));
    sorted.sort_by(|(_, one), (_, two)| {
        let pairs = one.iter().rev().zip(two.iter().rev());
        let differ = pairs.map(|(a, b)| compare(a, b)).find(|order| order.is_ne());
        differ.unwrap_or(one.len().cmp(&two.len()))
    });
    let pair = |pair: &[(usize, &[Point])]| {
        let [(first, one), (second, two)] = *pair else { return None };
        Some(Common { first, second, length: length_in_common(one, two) })
    };
    sorted.windows(2).filter_map(pair).collect()
}

/// The length of two polylines' common part before their ends.
fn length_in_common(one: &[Point], two: &[Point]) -> f64 {
    let mut length = 0.0;
    for (own, other) in one.windows(2).rev().zip(two.windows(2).rev()) {
        if own[1] != other[1] || direction(own[1], own[0]) != direction(other[1], other[0]) {
            return length;
        }
        let (own_leg, other_leg) = (distance(own[1], own[0]), distance(other[1], other[0]));
        length += own_leg.min(other_leg);
        if own_leg != other_leg {
            return length;
        }
    }
    length
}

#[cfg(test)]
mod tests {
    use super::{Common, Point, common, shortened};

    const TRUNK: [Point; 3] = [(0.0, 0.0), (0.0, 80.0), (50.0, 80.0)];
    const FROM_LEFT: [Point; 4] = [(-20.0, 30.0), (0.0, 30.0), (0.0, 80.0), (50.0, 80.0)];
    const FROM_BELOW: [Point; 3] = [(10.0, 95.0), (10.0, 80.0), (50.0, 80.0)];
    const ELSEWHERE: [Point; 2] = [(90.0, 0.0), (90.0, 40.0)];

    #[test]
    fn each_polyline_has_most_in_common_with_its_predecessor() {
        let all: [&[Point]; 4] = [&TRUNK, &ELSEWHERE, &FROM_BELOW, &FROM_LEFT];
        let found = common(all.into_iter().enumerate().collect());
        let pair = |first, second, length| Common { first, second, length };
        assert_eq!(found, [pair(0, 3, 100.0), pair(3, 2, 40.0), pair(2, 1, 0.0)]);
        assert_eq!(shortened(&FROM_LEFT, 100.0), [(-20.0, 30.0), (0.0, 30.0)]);
    }
}
