//! Orders the items of each layer so that few edges cross.
//!
//! A few sweeps by mean position give a start; then single items move as long as that helps.
//! Crossings are counted in the channels, each pair of edges in its best arrangement.

use super::channel::{Segment, crossings};
use super::grid::Grid;

/// The limit of improvements, in compared pairs of edges and packed items; large plans stop here.
const BUDGET: u64 = 2_500_000;

/// The cost of one pixel of horizontal distance, in crossings.
const LENGTH: f64 = 0.0005;

/// Sweeps by mean position.
const SWEEPS: usize = 8;

/// Reorders the items of each layer and packs them side by side.
pub(super) fn improve(grid: &mut Grid) {
    let mut work = 0;
    for layer in 0..grid.layers.len() {
        pack(grid, layer);
    }
    let mut means = vec![(0.0, 0_u32); grid.items.len()];
    let mut best = (total(grid, &mut work), grid.layers.clone());
    for sweep in 0..SWEEPS {
        let count = grid.layers.len();
        for step in 0..count {
            let layer = if sweep % 2 == 0 { step } else { count - 1 - step };
            sort_by_means(grid, layer, &mut means);
        }
        let cost = total(grid, &mut work);
        if cost < best.0 {
            best = (cost, grid.layers.clone());
        }
    }
    grid.layers = best.1;
    for layer in 0..grid.layers.len() {
        pack(grid, layer);
    }
    let connected = connected(grid);
    while (0..grid.layers.len()).any(|layer| move_items(grid, layer, &connected, &mut work)) {}
}

/// Whether each item has an edge: the place of an unconnected item costs nothing.
fn connected(grid: &Grid) -> Vec<bool> {
    let mut connected = vec![false; grid.items.len()];
    for end in grid.nets.iter().flat_map(|net| net.ends) {
        connected[end.item] = true;
    }
    connected
}

/// Packs the items of a layer side by side, centred.
fn pack(grid: &mut Grid, layer: usize) {
    let items = grid.layers[layer].clone();
    let mut x = 0.0;
    let mut previous = None;
    for item in &items {
        x += previous.map_or(0.0, |previous| grid.gap(previous, *item));
        grid.items[*item].x = x;
        x += grid.items[*item].width;
        previous = Some(*item);
    }
    for item in items {
        grid.items[item].x -= x / 2.0;
    }
}

/// Sorts the items of a layer. `means` is a buffer for all items, because there may be as many
/// layers.
fn sort_by_means(grid: &mut Grid, layer: usize, means: &mut [(f64, u32)]) {
    for item in &grid.layers[layer] {
        means[*item] = (0.0, 0);
    }
    for net in grid.channels[layer].iter().chain(&grid.channels[layer + 1]) {
        let [start, end] = &grid.nets[*net].ends;
        for (own, other) in [(start, end), (end, start)] {
            let mean = &mut means[own.item];
            mean.0 += grid.x(other) - own.offset;
            mean.1 += 1;
        }
    }
    let key = |item: &usize| match means[*item] {
        (_, 0) => grid.items[*item].x,
        (sum, count) => sum / f64::from(count),
    };
    let mut order = grid.layers[layer].clone();
    order.sort_by(|a, b| key(a).total_cmp(&key(b)));
    grid.layers[layer] = order;
    pack(grid, layer);
}

fn total(grid: &Grid, work: &mut u64) -> f64 {
    (0..grid.channels.len()).map(|channel| cost(grid, channel, work)).sum()
}

fn cost(grid: &Grid, channel: usize, work: &mut u64) -> f64 {
    let segments: Vec<_> = grid.channels[channel]
        .iter()
        .map(|net| Segment { ends: grid.nets[*net].ends.map(|end| (grid.x(&end), end.above)) })
        .collect();
    let lengths = segments.iter().map(|segment| segment.range().1 - segment.range().0);
    crossings(&segments, work) + LENGTH * lengths.sum::<f64>()
}

/// Moves each connected item of a layer to its best place within the budget; returns whether the
/// order improved.
fn move_items(grid: &mut Grid, layer: usize, connected: &[bool], work: &mut u64) -> bool {
    let mut improved = false;
    for item in grid.layers[layer].clone().into_iter().filter(|item| connected[*item]) {
        improved |= move_item(grid, layer, item, work);
    }
    improved
}

/// Moves an item to the best place in its layer; returns whether it moved.
fn move_item(grid: &mut Grid, layer: usize, item: usize, work: &mut u64) -> bool {
    if *work >= BUDGET {
        return false;
    }
    let around =
        |grid: &Grid, work: &mut u64| cost(grid, layer, work) + cost(grid, layer + 1, work);
    let before = grid.layers[layer].clone();
    let mut best = (around(grid, work) - 1e-6, before.clone());
    for place in 0..before.len() {
        if *work >= BUDGET {
            break;
        }
        *work += before.len() as u64;
        let mut order: Vec<_> = before.iter().copied().filter(|each| *each != item).collect();
        order.insert(place, item);
        grid.layers[layer] = order;
        pack(grid, layer);
        let cost = around(grid, work);
        if cost < best.0 {
            best = (cost, grid.layers[layer].clone());
        }
    }
    let improved = best.1 != before;
    grid.layers[layer] = best.1;
    pack(grid, layer);
    improved
}
