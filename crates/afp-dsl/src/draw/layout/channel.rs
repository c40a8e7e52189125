//! The space between two layers: which edge runs above which, and how many crossings that makes.

/// A net with its ends at known places.
#[derive(Clone, Copy, Debug)]
pub(super) struct Wire {
    /// Abscissa of each end, and whether it lies above the channel.
    pub(super) ends: [(f64, bool); 2],
}

/// Two vertical lines nearer than this look like one.
pub(super) const TOUCHING: f64 = 5.0;

/// What two vertical lines on top of each other cost, in crossings.
const OVERLAP: f64 = 50.0;

impl Wire {
    /// Left and right end of the horizontal part.
    pub(super) fn range(&self) -> (f64, f64) {
        let [(a, _), (b, _)] = self.ends;
        if a < b { (a, b) } else { (b, a) }
    }

    /// Whether it needs no horizontal part.
    pub(super) fn is_straight(&self) -> bool {
        let [(a, a_above), (b, b_above)] = self.ends;
        (a - b).abs() < 0.5 && a_above != b_above
    }

    /// What it costs when the horizontal part of `self` lies above that of `below`.
    fn cost_above(&self, below: &Wire) -> f64 {
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

/// The fewest crossings of all pairs, each pair arranged at its best.
pub(super) fn crossings(wires: &[Wire], work: &mut u64) -> f64 {
    let mut sum = 0.0;
    for (place, wire) in wires.iter().enumerate() {
        for other in &wires[..place] {
            let (one, two) = (wire.range(), other.range());
            *work += 1;
            if one.0 <= two.1 && two.0 <= one.1 {
                sum += wire.cost_above(other).min(other.cost_above(wire));
            }
        }
    }
    sum
}

/// The level of each wire's horizontal part, counted from 0 at the top, and how many levels there
/// are. Straight wires are on level 0 and count for none.
pub(super) fn levels(wires: &[Wire]) -> (Vec<usize>, usize) {
    let mut order: Vec<usize> =
        (0..wires.len()).filter(|wire| !wires[*wire].is_straight()).collect();
    order.sort_by(|a, b| wires[*a].range().0.total_cmp(&wires[*b].range().0));
    sort_by_insertion(&mut order, wires);
    let mut levels = vec![0; wires.len()];
    let mut count = 0;
    for (place, wire) in order.iter().enumerate() {
        let (left, right) = wires[*wire].range();
        let meets = |other: &&usize| {
            let range = wires[**other].range();
            left - 2.0 * TOUCHING <= range.1 && range.0 - 2.0 * TOUCHING <= right
        };
        let above = order[..place].iter().filter(meets).map(|other| levels[*other] + 1);
        levels[*wire] = above.max().unwrap_or(0);
        count = count.max(levels[*wire] + 1);
    }
    (levels, count)
}

/// Moves single wires up or down as long as that saves crossings.
fn sort_by_insertion(order: &mut Vec<usize>, wires: &[Wire]) {
    for _ in 0..16 {
        let mut improved = false;
        for wire in order.clone() {
            let Some(from) = order.iter().position(|each| *each == wire) else { continue };
            order.remove(from);
            let (best, saved) = best_place(order, wires, wire, from);
            order.insert(best, wire);
            improved |= saved;
        }
        if !improved {
            break;
        }
    }
}

/// The cheapest place of `wire` in `order`, and whether it is cheaper than the place `from`.
fn best_place(order: &[usize], wires: &[Wire], wire: usize, from: usize) -> (usize, bool) {
    let wire = &wires[wire];
    // Going down by one place swaps the wire with one other.
    let mut cost: f64 = order.iter().map(|other| wire.cost_above(&wires[*other])).sum();
    let mut costs = vec![cost];
    for other in order.iter().map(|other| &wires[*other]) {
        cost += other.cost_above(wire) - wire.cost_above(other);
        costs.push(cost);
    }
    let best = (0..costs.len())
        .fold(from, |best, place| if costs[place] < costs[best] - 1e-6 { place } else { best });
    (best, best != from)
}

#[cfg(test)]
mod tests {
    use super::{Wire, crossings, levels};

    fn down(from: f64, to: f64) -> Wire {
        Wire { ends: [(from, true), (to, false)] }
    }

    #[test]
    fn parallel_wires_are_nested_without_crossing() {
        let wires = [down(0.0, 100.0), down(20.0, 120.0), down(40.0, 140.0)];
        assert_eq!(crossings(&wires, &mut 0), 0.0);
        let (levels, count) = levels(&wires);
        assert_eq!((levels, count), (vec![2, 1, 0], 3));
    }

    #[test]
    fn wires_that_swap_sides_cross_or_touch() {
        assert_eq!(crossings(&[down(0.0, 100.0), down(100.0, 0.0)], &mut 0), 50.0);
        assert_eq!(crossings(&[down(0.0, 100.0), down(90.0, 10.0)], &mut 0), 1.0);
    }

    #[test]
    fn distant_wires_share_a_level() {
        let (levels, count) = levels(&[down(0.0, 50.0), down(100.0, 150.0), down(300.0, 300.0)]);
        assert_eq!((levels, count), (vec![0, 0, 0], 1));
    }

    #[test]
    fn a_wire_that_turns_back_is_outside_of_what_it_encloses() {
        let turn = Wire { ends: [(0.0, true), (200.0, true)] };
        let inner = Wire { ends: [(50.0, true), (100.0, true)] };
        let (levels, _) = levels(&[turn, inner]);
        assert!(levels[0] > levels[1]);
    }
}
