//! The lines that edges may take, and where these cross.
//!
//! Through each corner of a box, each exit and each arrival goes one upright and one level line, as
//! far as no box is in the way. Between two crossings of lines there is nothing to decide, so the
//! crossings are the nodes of the search.

use super::{Axis, Bounds, Point, Wire};

/// No neighbour.
pub(super) const NONE: u32 = u32::MAX;

/// Part of a line that is free of boxes.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Line {
    /// Its coordinate across.
    at: f64,
    from: f64,
    to: f64,
}

/// The graph that is searched.
#[derive(Debug, Default)]
pub(super) struct Lines {
    /// Where the nodes are, those of one upright line after another, each from top to bottom.
    pub(super) positions: Vec<Point>,
    /// The nodes next to each node: above, below, left, right.
    pub(super) next: Vec<[u32; 4]>,
    /// The first node of each upright line; one more at the end.
    starts: Vec<usize>,
    /// The abscissa of each upright line.
    abscissas: Vec<f64>,
}

impl Lines {
    /// The lines between boxes for some of the edges.
    pub(super) fn new(boxes: &[Bounds], wires: &[Wire], searched: &[usize]) -> Lines {
        let mut anchors: Vec<Point> = Vec::with_capacity(4 * boxes.len() + 2 * searched.len());
        for each in boxes {
            let corner = |x| [(x, each.top), (x, each.bottom)];
            anchors.extend(corner(each.left).into_iter().chain(corner(each.right)));
        }
        for wire in searched {
            anchors.extend([wires[*wire].escape(boxes), wires[*wire].gate()]);
        }
        anchors.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
        anchors.dedup();
        let ends = extent(boxes);
        let reach = |axis| free_lines(boxes, &anchors, ends, axis);
        crossings(&reach(Axis::Upright), &reach(Axis::Level))
    }

    /// The node nearest to a place on its upright line.
    pub(super) fn node(&self, (x, y): Point) -> Option<u32> {
        let first = self.abscissas.partition_point(|at| *at < x - 0.01);
        let lines =
            (first..self.abscissas.len()).take_while(|line| self.abscissas[*line] < x + 0.01);
        let on_line = |line: usize| {
            let nodes = self.starts[line]..self.starts[line + 1];
            nodes.into_iter().find(|node| (self.positions[*node].1 - y).abs() < 0.01)
        };
        lines.filter_map(on_line).next().and_then(|node| u32::try_from(node).ok())
    }
}

/// A little more than all boxes take, so that edges can go around them.
fn extent(boxes: &[Bounds]) -> Bounds {
    let none = Bounds { left: 0.0, top: 0.0, right: 0.0, bottom: 0.0 };
    let all = boxes.iter().copied().reduce(|a, b| Bounds {
        left: a.left.min(b.left),
        top: a.top.min(b.top),
        right: a.right.max(b.right),
        bottom: a.bottom.max(b.bottom),
    });
    all.unwrap_or(none)
}

/// The line of an axis through each anchor that lies in no box.
fn free_lines(boxes: &[Bounds], anchors: &[Point], ends: Bounds, axis: Axis) -> Vec<Line> {
    let mut lines: Vec<Line> = Vec::with_capacity(anchors.len());
    let (_, limits) = ends.ranges(axis);
    for anchor in anchors {
        let (at, along) = (axis.across(*anchor), axis.along(*anchor));
        let known = |line: &Line| line.at == at && line.from <= along && along <= line.to;
        // Upright lines are met in the order of their abscissas, level ones are not.
        if axis == Axis::Upright && lines.iter().rev().take_while(|line| line.at == at).any(known) {
            continue;
        }
        let (mut from, mut to) = limits;
        let mut inside = false;
        for each in boxes {
            let (across, (start, end)) = each.ranges(axis);
            if across.0 < at && at < across.1 {
                if end <= along {
                    from = from.max(end);
                } else if along <= start {
                    to = to.min(start);
                } else {
                    inside = true;
                    break;
                }
            }
        }
        if !inside {
            lines.push(Line { at, from: from.min(along), to: to.max(along) });
        }
    }
    lines.sort_by(|a, b| a.at.total_cmp(&b.at).then(a.from.total_cmp(&b.from)));
    lines.dedup();
    lines
}

fn crossings(upright: &[Line], level: &[Line]) -> Lines {
    let mut lines = Lines::default();
    let mut last_on: Vec<u32> = vec![NONE; level.len()];
    for line in upright {
        lines.starts.push(lines.positions.len());
        lines.abscissas.push(line.at);
        let first = level.partition_point(|other| other.at < line.from);
        let mut above = NONE;
        for (index, other) in level.iter().enumerate().skip(first) {
            if other.at > line.to {
                break;
            }
            if line.at < other.from || other.to < line.at {
                continue;
            }
            let node = u32::try_from(lines.positions.len()).unwrap_or(NONE);
            let left = std::mem::replace(&mut last_on[index], node);
            // Two lines at one height that touch have one node each; the second one is not needed.
            lines.positions.push((line.at, other.at));
            lines.next.push([above, NONE, left, NONE]);
            link(&mut lines.next, above, 1, node);
            link(&mut lines.next, left, 3, node);
            above = node;
        }
    }
    lines.starts.push(lines.positions.len());
    lines
}

fn link(next: &mut [[u32; 4]], node: u32, side: usize, to: u32) {
    if let Some(sides) = next.get_mut(node as usize) {
        sides[side] = to;
    }
}
