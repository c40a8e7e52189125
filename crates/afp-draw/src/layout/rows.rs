//! The ordinates of layers, with space between two layers for the horizontal parts of edges.

use super::super::router::{Axis, Crowded, Point};
use super::Node;
use super::grid::{Grid, LINE, Net, Terminal};

/// Space above the first and below the last horizontal line of a channel; arrow tips need more.
const ABOVE: f64 = 14.0;
const BELOW: f64 = 26.0;

/// The heights of layers and of the channels between them.
#[derive(Clone, Debug)]
pub(super) struct Rows {
    /// One more than the number of layers.
    channels: Vec<f64>,
    layers: Vec<f64>,
}

impl Rows {
    /// Rows with enough space for parallel nets.
    pub(super) fn new(grid: &Grid, nodes: &[Node]) -> Rows {
        // Boxes in neighbouring layers have a distance, with or without an edge between them.
        let last = grid.channels.len().saturating_sub(1);
        let height = |(at, nets): (usize, &Vec<usize>)| match nets.is_empty() {
            true if at == 0 || at == last => 0.0,
            _ => ABOVE + BELOW + tracks(grid, nets).saturating_sub(1) as f64 * LINE,
        };
        let tallest = |layer: &Vec<usize>| {
            let boxes = layer.iter().filter_map(|item| grid.items[*item].node);
            boxes.map(|node| nodes[node].height).fold(0.0, f64::max)
        };
        Rows {
            channels: grid.channels.iter().enumerate().map(height).collect(),
            layers: grid.layers.iter().map(tallest).collect(),
        }
    }

    /// The upper left corner of each node.
    pub(super) fn corners(&self, grid: &Grid, nodes: &[Node]) -> Vec<Point> {
        let tops = self.tops();
        let corner = |item: usize| (grid.items[item].x, tops[grid.items[item].layer].0);
        nodes.iter().enumerate().map(|(item, node)| node.whole(corner(item))).collect()
    }

    /// Adds space for edges that found too little: between two layers, or in a layer to the right.
    pub(super) fn give_way(&mut self, grid: &mut Grid, narrow: &Crowded) {
        let tops = self.tops();
        match narrow.axis {
            Axis::Level => {
                let channel = tops.partition_point(|(top, _)| *top < narrow.at);
                self.channels[channel] += LINE / 2.0;
            }
            Axis::Upright => {
                let (from, to) = narrow.span;
                for (layer, (top, bottom)) in tops.iter().enumerate() {
                    if *top < to && from < *bottom {
                        push_from(grid, layer, narrow.at);
                    }
                }
            }
        }
    }

    /// The upper and lower border of each layer.
    fn tops(&self) -> Vec<(f64, f64)> {
        let mut y = 0.0;
        let mut tops = Vec::with_capacity(self.layers.len());
        for (channel, layer) in self.channels.iter().zip(&self.layers) {
            tops.push((y + channel, y + channel + layer));
            y += channel + layer;
        }
        tops
    }
}

/// Moves the nodes of a layer that begin to the right of a place, and the items between them.
fn push_from(grid: &mut Grid, layer: usize, x: f64) {
    for item in grid.layers[layer].clone() {
        let item = &mut grid.items[item];
        if item.x > x {
            item.x += LINE / 2.0;
        }
    }
}

/// The number of horizontal lines that the nets of a channel need: the maximum number side by side.
fn tracks(grid: &Grid, nets: &[usize]) -> usize {
    let mut ends = Vec::with_capacity(2 * nets.len());
    for net in nets {
        let (from, to) = range(grid, &grid.nets[*net]);
        if to - from > 0.5 {
            ends.extend([(from, true), (to, false)]);
        }
    }
    // At one place, ranges begin before others end: they touch.
    ends.sort_by(|a, b| a.0.total_cmp(&b.0).then(b.1.cmp(&a.1)));
    let (mut now, mut most) = (0, 0_usize);
    for (_, begins) in ends {
        now = if begins { now + 1 } else { now - 1 };
        most = most.max(now);
    }
    most
}

/// The horizontal range of a net; an arrival is at the place with the straightest net.
fn range(grid: &Grid, net: &Net) -> (f64, f64) {
    let [start, end] = net.ends;
    let at = |terminal: &Terminal, other: &Terminal| match terminal.arrival {
        None => grid.x(terminal),
        Some((left, right)) => {
            let x = grid.items[terminal.item].x;
            grid.x(other).max(x + left).min(x + right)
        }
    };
    let (one, two) = (at(&start, &end), at(&end, &start));
    let same_side = start.above == end.above;
    let range = (one.min(two), one.max(two));
    if same_side && range.1 - range.0 <= 0.5 { (range.0, range.0 + 1.0) } else { range }
}
