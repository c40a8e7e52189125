//! The lines for edges, and their crossings.
//!
//! Each corner of a box, each exit and each arrival has a vertical and a horizontal line, up to the
//! next boxes. Between two crossings of lines there is no choice, so the crossings are the nodes of
//! the search.

use super::{Axis, Bounds, Connector, Point};

/// No neighbour.
pub(super) const NONE: u32 = u32::MAX;

/// The sides of a node: above, below, left, right.
pub(super) const UP: usize = 0;
pub(super) const DOWN: usize = 1;
pub(super) const LEFT: usize = 2;
pub(super) const RIGHT: usize = 3;

/// The side of one point with another point above, below or next to it.
pub(super) fn side_of(from: Point, to: Point) -> usize {
    match Axis::of(from, to) {
        Axis::Upright if to.1 < from.1 => UP,
        Axis::Upright => DOWN,
        Axis::Level if to.0 < from.0 => LEFT,
        Axis::Level => RIGHT,
    }
}

pub(super) fn axis_of(side: usize) -> Axis {
    if side <= DOWN { Axis::Upright } else { Axis::Level }
}

/// Part of a line that is free of boxes.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Line {
    /// Its coordinate across.
    at: f64,
    from: f64,
    to: f64,
}

/// The search graph.
#[derive(Debug, Default)]
pub(super) struct Lines {
    /// The positions of the nodes: one vertical line after another, each from top to bottom.
    pub(super) positions: Vec<Point>,
    /// The nodes next to each node, by side.
    pub(super) next: Vec<[u32; 4]>,
}

impl Lines {
    /// The lines between boxes for some edges, which may join others along their corners; `None` if
    /// there are more than `most` crossings.
    pub(super) fn new(
        boxes: &[Bounds],
        connectors: &[Connector],
        searched: &[usize],
        joined: impl Iterator<Item = Point>,
        most: u32,
    ) -> Option<Lines> {
        let mut anchors: Vec<Point> = Vec::with_capacity(4 * boxes.len() + 2 * searched.len());
        for each in boxes {
            let corner = |x| [(x, each.top), (x, each.bottom)];
            anchors.extend(corner(each.left).into_iter().chain(corner(each.right)));
        }
        for connector in searched {
            anchors.extend([connectors[*connector].escape(boxes), connectors[*connector].gate()]);
        }
        anchors.extend(joined);
        anchors.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
        anchors.dedup();
        let ends = extent(boxes);
        let reach = |axis| free_lines(boxes, &anchors, ends, axis);
        crossings(&reach(Axis::Upright), &reach(Axis::Level), most)
    }

    /// The nodes between two places on one line, in the order of their positions.
    pub(super) fn along(&self, a: Point, b: Point) -> impl Iterator<Item = u32> {
        let (start, end) = if (a.0, a.1) < (b.0, b.1) { (a, b) } else { (b, a) };
        let side = side_of(start, end);
        let holds = move |node: &u32| {
            let at = self.positions.get(*node as usize);
            at.is_some_and(|at| at.0 <= end.0 + 0.01 && at.1 <= end.1 + 0.01)
        };
        let next = move |node: &u32| Some(self.next[*node as usize][side]).filter(holds);
        std::iter::successors(self.node(start).filter(holds), next)
    }

    /// The node nearest to a place on its vertical line.
    pub(super) fn node(&self, (x, y): Point) -> Option<u32> {
        // Nodes are sorted from left to right, then from top to bottom.
        let mut first = self.positions.partition_point(|at| at.0 < x - 0.01);
        loop {
            let rest = self.positions.get(first..)?;
            let here = rest.first()?.0;
            if here >= x + 0.01 {
                return None;
            }
            let end = rest.partition_point(|at| at.0 <= here);
            let index = rest[..end].partition_point(|at| at.1 <= y - 0.01);
            if rest[..end].get(index).is_some_and(|at| at.1 < y + 0.01) {
                return u32::try_from(first + index).ok();
            }
            first += end;
        }
    }
}

/// A little more than the bounds of all boxes, so that edges can go around them.
fn extent(boxes: &[Bounds]) -> Bounds {
    let none = Bounds { left: 0.0, top: 0.0, right: 0.0, bottom: 0.0 };
    boxes.iter().copied().reduce(Bounds::with).unwrap_or(none)
}

/// The line of an axis through each anchor outside of boxes.
fn free_lines(boxes: &[Bounds], anchors: &[Point], ends: Bounds, axis: Axis) -> Vec<Line> {
    let mut anchors = anchors.to_vec();
    anchors.sort_by(|a, b| axis.across(*a).total_cmp(&axis.across(*b)));
    let mut ranges: Vec<_> = boxes.iter().map(|each| each.ranges(axis)).collect();
    ranges.sort_by(|a, b| a.0.0.total_cmp(&b.0.0));
    let widest = ranges.iter().map(|(across, _)| across.1 - across.0).fold(0.0, f64::max);
    let (_, limits) = ends.ranges(axis);
    let mut lines: Vec<Line> = Vec::with_capacity(anchors.len());
    let mut met = Met::default();
    for anchor in anchors {
        let (at, along) = (axis.across(anchor), axis.along(anchor));
        let known = |line: &Line| line.at == at && line.from <= along && along <= line.to;
        // Each horizontal line is computed again: two lines at touching boxes may share a place.
        if axis == Axis::Upright && lines.iter().rev().take_while(|line| line.at == at).any(known) {
            continue;
        }
        if met.at != Some(at) {
            met = Met::new(&ranges, widest, at);
        }
        if let Some((from, to)) = met.free(along) {
            let (from, to) = (from.max(limits.0), to.min(limits.1));
            lines.push(Line { at, from: from.min(along), to: to.max(along) });
        }
    }
    lines.sort_by(|a, b| a.at.total_cmp(&b.at).then(a.from.total_cmp(&b.from)));
    lines.dedup();
    lines
}

type Range = (f64, f64);

/// The boxes on a whole line: the start of each, in order, and the last end of it and its
/// predecessors.
#[derive(Default)]
struct Met {
    at: Option<f64>,
    boxes: Vec<Range>,
}

impl Met {
    /// From boxes sorted by their start across, none wider than `widest`.
    fn new(ranges: &[(Range, Range)], widest: f64, at: f64) -> Met {
        let first = ranges.partition_point(|(across, _)| across.0 < at - widest);
        let end = ranges.partition_point(|(across, _)| across.0 < at);
        let near = ranges.get(first..end).unwrap_or_default().iter();
        let mut boxes: Vec<_> =
            near.filter(|(across, _)| at < across.1).map(|(_, along)| *along).collect();
        boxes.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut last = f64::NEG_INFINITY;
        for (_, end) in &mut boxes {
            last = end.max(last);
            *end = last;
        }
        Met { at: Some(at), boxes }
    }

    /// The free range of the line around a place; `None` inside of a box.
    fn free(&self, along: f64) -> Option<(f64, f64)> {
        let behind = self.boxes.partition_point(|(start, _)| *start < along);
        let before = behind.checked_sub(1).map_or(f64::NEG_INFINITY, |last| self.boxes[last].1);
        let next = self.boxes.get(behind).map_or(f64::INFINITY, |(start, _)| *start);
        (before <= along).then_some((before, next))
    }
}

fn crossings(upright: &[Line], level: &[Line], most: u32) -> Option<Lines> {
    let mut lines = Lines::default();
    let mut last_on: Vec<u32> = vec![NONE; level.len()];
    for line in upright {
        let first = level.partition_point(|other| other.at < line.from);
        let mut above = NONE;
        for (index, other) in level.iter().enumerate().skip(first) {
            if other.at > line.to {
                break;
            }
            if line.at < other.from || other.to < line.at {
                continue;
            }
            let node = u32::try_from(lines.positions.len()).ok().filter(|node| *node < most)?;
            let left = std::mem::replace(&mut last_on[index], node);
            // Two touching lines at one height have one node each; the second one is not needed.
            lines.positions.push((line.at, other.at));
            lines.next.push([above, NONE, left, NONE]);
            link(&mut lines.next, above, DOWN, node);
            link(&mut lines.next, left, RIGHT, node);
            above = node;
        }
    }
    Some(lines)
}

fn link(next: &mut [[u32; 4]], node: u32, side: usize, to: u32) {
    if let Some(sides) = next.get_mut(node as usize) {
        sides[side] = to;
    }
}
