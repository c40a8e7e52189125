//! The space between two layers, and the crossings of its edges.

/// A net with known places of its ends.
#[derive(Clone, Copy, Debug)]
pub(super) struct Segment {
    /// Abscissa of each end, and whether it is above the channel.
    pub(super) ends: [(f64, bool); 2],
}

/// Vertical lines within this distance look like one line.
pub(super) const TOUCHING: f64 = 5.0;

/// The cost of two vertical lines on top of each other, in crossings.
const OVERLAP: f64 = 50.0;

impl Segment {
    /// Left and right end of the horizontal part.
    pub(super) fn range(&self) -> (f64, f64) {
        let [(a, _), (b, _)] = self.ends;
        if a < b { (a, b) } else { (b, a) }
    }

    /// The cost if the horizontal part of `self` is above that of `below`.
    fn cost_above(&self, below: &Segment) -> f64 {
        let mut cost = 0.0;
        let downward = self.ends.iter().filter(|(_, above)| !above);
        for (x, _) in downward {
            cost += crossing(*x, below.range());
            let upward = below.ends.iter().filter(|(_, above)| *above);
            cost +=
                upward.filter(|(other, _)| (x - other).abs() < TOUCHING).count() as f64 * OVERLAP;
        }
        let upward = below.ends.iter().filter(|(_, above)| *above);
        cost + upward.map(|(x, _)| crossing(*x, self.range())).sum::<f64>()
    }
}

fn crossing(x: f64, (left, right): (f64, f64)) -> f64 {
    if left < x && x < right { 1.0 } else { 0.0 }
}

/// The minimum number of crossings of all pairs, each pair in its best arrangement.
pub(super) fn crossings(segments: &[Segment], work: &mut u64) -> f64 {
    let mut sum = 0.0;
    for (place, segment) in segments.iter().enumerate() {
        for other in &segments[..place] {
            let (one, two) = (segment.range(), other.range());
            *work += 1;
            if one.0 <= two.1 && two.0 <= one.1 {
                sum += segment.cost_above(other).min(other.cost_above(segment));
            }
        }
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::{Segment, crossings};

    fn down(from: f64, to: f64) -> Segment {
        Segment { ends: [(from, true), (to, false)] }
    }

    #[test]
    fn parallel_wires_are_nested_without_crossing() {
        let segments = [down(0.0, 100.0), down(20.0, 120.0), down(40.0, 140.0)];
        assert_eq!(crossings(&segments, &mut 0), 0.0);
    }

    #[test]
    fn wires_that_swap_sides_cross_or_touch() {
        assert_eq!(crossings(&[down(0.0, 100.0), down(100.0, 0.0)], &mut 0), 50.0);
        assert_eq!(crossings(&[down(0.0, 100.0), down(90.0, 10.0)], &mut 0), 1.0);
    }
}
