//! Assigns abscissas to the items of each layer.
//!
//! Every net pulls its two ends together. For each layer, the places with the minimum squared pull
//! under the given order and gaps are computed exactly (pooling adjacent violators), in several
//! rounds. In later rounds the dummy nodes of one edge are pulled to one line, and at the end they
//! are put on it if neighbours leave space.

use super::grid::{Grid, LINE, Terminal};

/// The number of rounds: first free, then with the dummy nodes of an edge on a line.
const ROUNDS: usize = 30;
const ROUNDS_IN_LINE: usize = 30;

/// How strongly a dummy node is pulled to the line of its edge.
const IN_LINE: f64 = 12.0;

/// A bend of fewer pixels looks like an error.
const JOG: f64 = 2.0 * LINE;

/// The relative weight of an arrival's pull to the middle of its box.
const TO_MIDDLE: f64 = 0.08;

/// Computes the abscissas; the leftmost item ends at 0.
pub(super) fn place(grid: &mut Grid) {
    let count = grid.layers.len();
    let mut wishes = vec![(0.0, 0.0); grid.items.len()];
    let pulls: Vec<_> = (0..count).map(|layer| pulls(grid, layer)).collect();
    for round in 0..ROUNDS + ROUNDS_IN_LINE {
        let lines = if round < ROUNDS { vec![None; grid.items.len()] } else { lines(grid) };
        for step in 0..count {
            let layer = if round % 2 == 0 { step } else { count - 1 - step };
            place_layer(grid, layer, &pulls[layer], &lines, &mut wishes);
        }
    }
    for _ in 0..3 {
        straighten(grid);
        for item in 0..grid.items.len() {
            nudge(grid, item);
        }
    }
    straighten(grid);
    let left = grid.items.iter().map(|item| item.x).fold(f64::INFINITY, f64::min);
    for item in &mut grid.items {
        item.x -= left;
    }
}

/// For each dummy node, the mean of its edge's dummy nodes.
fn lines(grid: &Grid) -> Vec<Option<f64>> {
    let mut lines = vec![None; grid.items.len()];
    for chain in &grid.chains {
        let dummies = grid.dummies(chain);
        let sum: f64 = dummies.iter().map(|dummy| grid.items[*dummy].x).sum();
        for dummy in &dummies {
            lines[*dummy] = Some(sum / dummies.len() as f64);
        }
    }
    lines
}

/// A net's pull on one of its ends.
struct Pull {
    own: Terminal,
    other: Terminal,
    weight: f64,
}

fn pulls(grid: &Grid, layer: usize) -> Vec<Pull> {
    let mut pulls = Vec::new();
    for (channel, above) in [(layer, false), (layer + 1, true)] {
        for net in &grid.channels[channel] {
            let [start, end] = grid.nets[*net].ends;
            let weight = weight(grid, &start, &end);
            let both = [(start, end), (end, start)].into_iter();
            let own = both.filter(|(own, _)| own.above == above);
            pulls.extend(own.map(|(own, other)| Pull { own, other, weight }));
        }
    }
    pulls
}

/// Places the items of a layer. `wishes` is a buffer for all items, because there may be as many
/// layers.
fn place_layer(
    grid: &mut Grid,
    layer: usize,
    pulls: &[Pull],
    lines: &[Option<f64>],
    wishes: &mut [(f64, f64)],
) {
    for item in &grid.layers[layer] {
        wishes[*item] = lines[*item].map_or((0.0, 0.0), |x| (IN_LINE * x, IN_LINE));
    }
    for Pull { own, other, weight } in pulls {
        let there = grid.items[other.item].x;
        let wish = &mut wishes[own.item];
        let mut add = |weight: f64, x: f64| {
            wish.0 += weight * x;
            wish.1 += weight;
        };
        add(*weight, there + offset(grid, other, own) - offset(grid, own, other));
        if own.arrival.or(other.arrival).is_some() {
            add(TO_MIDDLE * weight, there + other.offset - own.offset);
        }
    }
    let order = grid.layers[layer].clone();
    let mut shift = 0.0;
    let mut shifts = Vec::with_capacity(order.len());
    let mut wanted = Vec::with_capacity(order.len());
    for (index, item) in order.iter().enumerate() {
        if let Some(previous) = index.checked_sub(1).map(|place| order[place]) {
            shift += grid.items[previous].width + grid.gap(previous, *item);
        }
        let (sum, weight) = wishes[*item];
        let wish = if weight > 0.0 { sum / weight } else { grid.items[*item].x };
        shifts.push(shift);
        wanted.push((wish - shift, weight.max(1e-3)));
    }
    for (place, value) in non_decreasing(&wanted).into_iter().enumerate() {
        grid.items[order[place]].x = value + shifts[place];
    }
}

/// The strength of a net's pull.
fn weight(grid: &Grid, start: &Terminal, end: &Terminal) -> f64 {
    if start.above == end.above {
        return 0.2;
    }
    match (grid.items[start.item].node, grid.items[end.item].node) {
        (None, None) => 8.0,
        (Some(_), Some(_)) => 3.0,
        _ => 1.0,
    }
}

/// The offset of a terminal; for an arrival, the offset with the straightest edge.
fn offset(grid: &Grid, terminal: &Terminal, other: &Terminal) -> f64 {
    match terminal.arrival {
        None => terminal.offset,
        Some((left, right)) => {
            let wish = grid.x(other) - grid.items[terminal.item].x;
            wish.max(left).min(right)
        }
    }
}

/// The non-decreasing sequence nearest to the wanted values by weighted squares.
fn non_decreasing(wanted: &[(f64, f64)]) -> Vec<f64> {
    // Each block has its mean, its weight and its length.
    let mut blocks: Vec<(f64, f64, usize)> = Vec::new();
    for (value, weight) in wanted {
        let mut block = (*value, *weight, 1);
        while let Some((mean, weight, length)) = blocks.pop_if(|last| last.0 > block.0) {
            let sum = weight + block.1;
            block = ((mean * weight + block.0 * block.1) / sum, sum, length + block.2);
        }
        blocks.push(block);
    }
    blocks.into_iter().flat_map(|(mean, _, length)| std::iter::repeat_n(mean, length)).collect()
}

/// Gives the dummy nodes of each edge one abscissa if neighbours leave space.
fn straighten(grid: &mut Grid) {
    for chain in grid.chains.clone() {
        let ends = |net: &usize| grid.nets[*net].ends;
        let dummies = grid.dummies(&chain);
        let (Some(first), Some(last)) = (chain.first(), chain.last()) else { continue };
        let start = straight_end(grid, ends(first)[0], ends(first)[1]);
        let tip = straight_end(grid, ends(last)[1], ends(last)[0]);
        align(grid, &dummies, start.or(tip));
    }
}

/// The place of a dummy node with a straight net to the end of the edge.
fn straight_end(grid: &Grid, end: Terminal, dummy: Terminal) -> Option<f64> {
    let there = grid.items[end.item].x + offset(grid, &end, &dummy);
    (end.above != dummy.above && (there - grid.x(&dummy)).abs() < 8.0 * LINE).then_some(there)
}

/// Puts a row of dummy nodes on one line, near `wish`, or else near their mean; breaks it if
/// necessary.
fn align(grid: &mut Grid, dummies: &[usize], wish: Option<f64>) {
    let mut rest = dummies;
    while !rest.is_empty() {
        let mut bounds = (f64::NEG_INFINITY, f64::INFINITY);
        let mut length = 0;
        for dummy in rest {
            let (left, right) = room(grid, *dummy);
            let next = (bounds.0.max(left), bounds.1.min(right));
            if next.0 > next.1 {
                break;
            }
            bounds = next;
            length += 1;
        }
        if length == 0 {
            // Its neighbours leave no space, if only by rounding: it stays.
            rest = &rest[1..];
            continue;
        }
        let (run, after) = rest.split_at(length);
        let mean = run.iter().map(|dummy| grid.items[*dummy].x).sum::<f64>() / run.len() as f64;
        let x = wish.unwrap_or(mean).max(bounds.0).min(bounds.1);
        for dummy in run {
            grid.items[*dummy].x = x;
        }
        rest = after;
    }
}

/// Moves a node a little if this makes more of its edges straight.
fn nudge(grid: &mut Grid, item: usize) {
    if grid.items[item].node.is_none() {
        return;
    }
    let (left, right) = room(grid, item);
    let bends = bends(grid, item);
    let jogs = |shift: f64| {
        let rest = bends.iter().map(|bend| (bend - shift).abs());
        rest.filter(|bend| (0.5..JOG).contains(bend)).count()
    };
    let x = grid.items[item].x;
    let shifts = bends.iter().copied().filter(|bend| bend.abs() < JOG);
    let shifts = shifts.filter(|bend| left <= x + bend && x + bend <= right);
    let best = shifts.min_by_key(|shift| jogs(*shift)).filter(|best| jogs(*best) < jogs(0.0));
    grid.items[item].x += best.unwrap_or(0.0);
}

/// The distances of a node to the places where each of its edges is straight.
fn bends(grid: &Grid, item: usize) -> Vec<f64> {
    let layer = grid.items[item].layer;
    let nets = grid.channels[layer].iter().chain(&grid.channels[layer + 1]);
    let ends = nets.map(|net| grid.nets[*net].ends).filter(|[start, end]| start.above != end.above);
    let pairs = ends.flat_map(|[start, end]| [(start, end), (end, start)]);
    let own = pairs.filter(|(own, _)| own.item == item);
    let bend = |(own, other): (Terminal, Terminal)| {
        let x = |end: &Terminal| grid.items[end.item].x;
        x(&other) + offset(grid, &other, &own) - x(&own) - offset(grid, &own, &other)
    };
    own.map(bend).collect()
}

/// The free space of an item between its neighbours.
fn room(grid: &Grid, item: usize) -> (f64, f64) {
    let order = &grid.layers[grid.items[item].layer];
    let Some(index) = order.iter().position(|each| *each == item) else {
        return (f64::NEG_INFINITY, f64::INFINITY);
    };
    let left = index.checked_sub(1).map(|index| order[index]);
    let left =
        left.map(|other| grid.items[other].x + grid.items[other].width + grid.gap(other, item));
    let width = grid.items[item].width;
    let right = order.get(index + 1);
    let right = right.map(|other| grid.items[*other].x - grid.gap(item, *other) - width);
    (left.unwrap_or(f64::NEG_INFINITY), right.unwrap_or(f64::INFINITY))
}

#[cfg(test)]
mod tests {
    use super::non_decreasing;

    #[test]
    fn violators_are_pooled_by_weight() {
        assert_eq!(non_decreasing(&[(1.0, 1.0), (2.0, 1.0)]), [1.0, 2.0]);
        assert_eq!(non_decreasing(&[(3.0, 1.0), (0.0, 2.0), (5.0, 1.0)]), [1.0, 1.0, 5.0]);
        assert_eq!(non_decreasing(&[(3.0, 1.0), (2.0, 1.0), (1.0, 1.0)]), [2.0, 2.0, 2.0]);
    }
}
