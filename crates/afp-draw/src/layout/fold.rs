//! Folds a layout that is much higher than wide: its layers become columns side by side.
//!
//! Chains wrap like lines of a text. A cut is between two layers with few edges; these edges run in
//! the gap between the columns.

use super::super::arrange::WANTED;
use super::super::router::{Bounds, PITCH, Point};
use super::Node;
use super::grid::Grid;

/// Layouts with at least this height by width are folded.
const TALL: f64 = 2.0;

/// Drawings up to this height fit on a screen without folding.
const SCREEN: f64 = 760.0;

/// The cost of an edge across a cut, as a share of a column's height.
const EDGE: f64 = 0.05;

/// Distance between two columns, without space for the edges across the cut.
const APART: f64 = 48.0;

/// The maximum number of columns.
const MOST_COLUMNS: usize = 200;

/// A possible start of a column.
#[derive(Clone, Copy, Debug)]
struct Cut {
    /// The first layer of a column.
    layer: usize,
    /// The number of edges from above it into it or past it.
    passing: usize,
}

/// The corners of the nodes with the layers in columns; `None` if one column is best.
pub(super) fn fold(grid: &Grid, nodes: &[Node], corners: &[Point]) -> Option<Vec<Point>> {
    let layers = extents(grid, nodes, corners);
    let whole = layers.iter().copied().reduce(Bounds::with)?;
    if whole.height() <= SCREEN.max(TALL * whole.width()) {
        return None;
    }
    let cuts: Vec<Cut> =
        (2..layers.len()).map(|layer| Cut { layer, passing: passing(grid, layer) }).collect();
    let far = |columns: &[Column]| (ratio(columns) / WANTED).ln().abs();
    let tried = (2..=MOST_COLUMNS.min(cuts.len() + 1)).map(|count| chosen(&layers, &cuts, count));
    let columns =
        tried.map(|cuts| columns(&layers, &cuts)).min_by(|a, b| far(a).total_cmp(&far(b)))?;
    let one = Column { first: 0, extent: whole, gap: 0.0 };
    if far(&columns) >= far(&[one]) {
        return None;
    }
    let mut left = whole.left;
    let mut shifts = Vec::with_capacity(columns.len());
    for Column { extent, gap, .. } in &columns {
        left += gap;
        shifts.push((left - extent.left, whole.top - extent.top));
        left += extent.width();
    }
    let moved = |(node, (x, y)): (usize, &Point)| {
        let layer = grid.items[node].layer;
        let (dx, dy) = shifts[columns.partition_point(|column| column.first <= layer) - 1];
        nodes[node].whole((x + dx, y + dy))
    };
    Some(corners.iter().enumerate().map(moved).collect())
}

/// The extent of each layer, including its dummy nodes.
fn extents(grid: &Grid, nodes: &[Node], corners: &[Point]) -> Vec<Bounds> {
    let of = |item: &usize| {
        let item = &grid.items[*item];
        let (left, right) = (item.x, item.x + item.width);
        match item.node {
            Some(node) => {
                let top = corners[node].1;
                Bounds { left, right, top, bottom: top + nodes[node].height }
            }
            None => Bounds { left, right, top: f64::INFINITY, bottom: f64::NEG_INFINITY },
        }
    };
    grid.layers.iter().filter_map(|layer| layer.iter().map(of).reduce(Bounds::with)).collect()
}

/// The number of edges from above a layer into it or past it.
fn passing(grid: &Grid, layer: usize) -> usize {
    let ends = grid.channels[layer].iter().map(|net| grid.nets[*net].ends);
    ends.filter(|[start, end]| start.above != end.above).count()
}

/// The starts of at most this number of columns after the first, with about equal heights.
fn chosen(layers: &[Bounds], cuts: &[Cut], count: usize) -> Vec<Cut> {
    let (top, bottom) = (layers[0].top, layers[layers.len() - 1].bottom);
    let height = (bottom - top) / count as f64;
    let mut chosen: Vec<Cut> = Vec::new();
    for column in 1..count {
        let wanted = top + height * column as f64;
        let around = cuts.partition_point(|cut| layers[cut.layer].top < wanted - height / 2.0)
            ..cuts.partition_point(|cut| layers[cut.layer].top < wanted + height / 2.0);
        let cost = |cut: &&Cut| {
            let distance = (layers[cut.layer].top - wanted).abs() / height;
            distance + cut.passing as f64 * EDGE
        };
        let best = cuts[around].iter().min_by(|a, b| cost(a).total_cmp(&cost(b)));
        let last = chosen.last().map_or(0, |cut| cut.layer);
        chosen.extend(best.filter(|cut| cut.layer > last));
    }
    chosen
}

/// The layers of a column.
#[derive(Clone, Copy, Debug)]
struct Column {
    /// The first of its layers.
    first: usize,
    extent: Bounds,
    /// The space before it.
    gap: f64,
}

fn columns(layers: &[Bounds], cuts: &[Cut]) -> Vec<Column> {
    let starts = [Cut { layer: 0, passing: 0 }].into_iter().chain(cuts.iter().copied());
    let ends = cuts.iter().map(|cut| cut.layer).chain([layers.len()]);
    let column = |(start, end): (Cut, usize)| {
        let first = layers[start.layer];
        let extent = layers[start.layer..end].iter().copied().fold(first, Bounds::with);
        let gap = APART + start.passing as f64 * PITCH;
        Column { first: start.layer, extent, gap: if start.layer == 0 { 0.0 } else { gap } }
    };
    starts.zip(ends).map(column).collect()
}

/// Width by height of columns side by side.
fn ratio(columns: &[Column]) -> f64 {
    let width: f64 = columns.iter().map(|column| column.gap + column.extent.width()).sum();
    let height = columns.iter().map(|column| column.extent.height()).fold(0.0, f64::max);
    width.max(1.0) / height.max(1.0)
}
