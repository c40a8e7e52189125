//! Folds what is much higher than wide: its layers stand in columns side by side.
//!
//! A cut goes between two layers where few edges pass, so chains wrap like lines of a text, and what hangs together in many
//! ways stays as it is.

use super::super::arrange::WANTED;
use super::super::router::{PITCH, Point};
use super::Node;
use super::grid::Grid;

/// Height by width from which on layers are folded.
const TALL: f64 = 2.0;

/// As many edges may pass a cut.
const MOST_CUT: usize = 5;

/// Distance between two columns, without room for the edges between them.
const APART: f64 = 48.0;

/// As many columns are tried.
const MOST_COLUMNS: usize = 200;

/// From where to where a layer or several ones reach.
#[derive(Clone, Copy, Debug)]
struct Extent {
    left: f64,
    right: f64,
    top: f64,
    bottom: f64,
}

/// The corners of the nodes with the layers in columns; nothing where one column is best.
pub(super) fn fold(grid: &Grid, nodes: &[Node], corners: &[Point]) -> Option<Vec<Point>> {
    let layers = extents(grid, nodes, corners);
    let whole = layers.iter().copied().reduce(Extent::with)?;
    if whole.height() <= TALL * whole.width() {
        return None;
    }
    let cuts: Vec<usize> =
        (2..layers.len()).filter(|layer| passing(grid, *layer) <= MOST_CUT).collect();
    let far = |columns: &[Extent]| (ratio(columns) / WANTED).ln().abs();
    let tried = (2..=MOST_COLUMNS.min(cuts.len() + 1)).map(|count| starts(&layers, &cuts, count));
    let tried = tried.map(|starts| (columns(&layers, &starts), starts));
    let (columns, starts) = tried.min_by(|a, b| far(&a.0).total_cmp(&far(&b.0)))?;
    if far(&columns) >= far(&[whole]) {
        return None;
    }
    let mut left = whole.left;
    let mut shifts = Vec::with_capacity(columns.len());
    for column in &columns {
        shifts.push((left - column.left, whole.top - column.top));
        left += column.width() + between();
    }
    let moved = |(node, (x, y)): (usize, &Point)| {
        let layer = grid.items[node].layer;
        let (dx, dy) = shifts[starts.partition_point(|start| *start <= layer) - 1];
        (x + dx, y + dy)
    };
    Some(corners.iter().enumerate().map(moved).collect())
}

/// Where each layer reaches, with the dummy nodes that pass it.
fn extents(grid: &Grid, nodes: &[Node], corners: &[Point]) -> Vec<Extent> {
    let of = |item: &usize| {
        let item = &grid.items[*item];
        let (left, right) = (item.x, item.x + item.width);
        match item.node {
            Some(node) => {
                let top = corners[node].1;
                Extent { left, right, top, bottom: top + nodes[node].height }
            }
            None => Extent { left, right, top: f64::INFINITY, bottom: f64::NEG_INFINITY },
        }
    };
    grid.layers.iter().filter_map(|layer| layer.iter().map(of).reduce(Extent::with)).collect()
}

/// How many edges pass from above a layer into it or past it.
fn passing(grid: &Grid, layer: usize) -> usize {
    let ends = grid.channels[layer].iter().map(|net| grid.nets[*net].ends);
    ends.filter(|[start, end]| start.above != end.above).count()
}

/// The first layers of so many columns or fewer, about equally high.
fn starts(layers: &[Extent], cuts: &[usize], count: usize) -> Vec<usize> {
    let (top, bottom) = (layers[0].top, layers[layers.len() - 1].bottom);
    let mut starts = vec![0];
    for column in 1..count {
        let wanted = top + (bottom - top) * column as f64 / count as f64;
        let after = cuts.partition_point(|cut| layers[*cut].top < wanted);
        let around = [after.checked_sub(1), Some(after)].into_iter().flatten();
        let around = around.filter_map(|place| cuts.get(place));
        let distance = |cut: &&usize| (layers[**cut].top - wanted).abs();
        let nearest = around.min_by(|a, b| distance(a).total_cmp(&distance(b)));
        starts.extend(nearest.filter(|cut| starts.last() < Some(cut)));
    }
    starts
}

fn columns(layers: &[Extent], starts: &[usize]) -> Vec<Extent> {
    let ends = starts.iter().skip(1).copied().chain([layers.len()]);
    let column = |(start, end): (&usize, usize)| {
        let first = layers[*start];
        layers[*start..end].iter().copied().fold(first, Extent::with)
    };
    starts.iter().zip(ends).map(column).collect()
}

/// Width by height of columns side by side.
fn ratio(columns: &[Extent]) -> f64 {
    let width = columns.iter().map(|column| column.width() + between()).sum::<f64>() - between();
    let height = columns.iter().map(Extent::height).fold(0.0, f64::max);
    width.max(1.0) / height.max(1.0)
}

fn between() -> f64 {
    APART + MOST_CUT as f64 * PITCH
}

impl Extent {
    fn with(self, other: Extent) -> Extent {
        Extent {
            left: self.left.min(other.left),
            right: self.right.max(other.right),
            top: self.top.min(other.top),
            bottom: self.bottom.max(other.bottom),
        }
    }

    fn width(&self) -> f64 {
        self.right - self.left
    }

    fn height(&self) -> f64 {
        self.bottom - self.top
    }
}
