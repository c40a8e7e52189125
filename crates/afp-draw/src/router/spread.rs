//! Moves edges on a common line apart.
//!
//! First the vertical parts of all edges get their abscissas, then the horizontal parts their
//! ordinates. This happens twice, because moves across change the ranges along. Each part stays
//! between its neighbouring boxes, in its place of the [`sequence`](super::sequence), [`PITCH`]
//! away from its neighbours or, in a narrow gap, as far as possible.

use std::collections::BTreeMap;

use super::bundle::Junction;
use super::merge::Join;
use super::sequence::{Part, REACH, sequence};
use super::tree::Maxima;
use super::{Axis, Bounds, Connector, Crowded, PITCH, Point, TIP, without_straight_corners};

/// The number of attempts in a narrow gap, and the factor of the distance for each.
const ATTEMPTS: usize = 14;
const TIGHTER: f64 = 0.8;

/// The number of rounds over both axes.
const ROUNDS: usize = 2;

/// The distance by which other edges may push an edge nearer to a box.
const NEARER: f64 = 4.0;

/// The distance beyond its ends at which a part keeps others away.
const MARGIN: f64 = 4.0;

/// Edges with parts to move.
pub(super) struct Spread<'a> {
    pub(super) boxes: &'a [Bounds],
    pub(super) connectors: &'a [Connector],
    /// Which edges are fixed.
    pub(super) fixed: &'a [bool],
    /// The behaviour of edges before their target.
    pub(super) joins: &'a [Join],
    /// The edges that are not fixed, each after the edges that it ends on.
    pub(super) order: &'a [usize],
}

impl Spread<'_> {
    /// Moves the parts; returns the places with too little space.
    pub(super) fn apply(&self, corners: &mut [Vec<Point>]) -> Vec<Crowded> {
        let mut crowded = Vec::new();
        for _ in 0..ROUNDS {
            crowded.clear();
            for axis in [Axis::Upright, Axis::Level] {
                let parts = that_matter(self.parts(axis, corners));
                let order = sequence(axis, &parts, corners);
                let (positions, narrow) = positions(&parts, &order);
                crowded.extend(narrow.iter().map(|(part, distance)| {
                    let Part { edge, first, span, .. } = parts[*part];
                    let arrives = self.arrives(edge, first, &corners[edge]);
                    Crowded { edge, axis, at: positions[*part], span, distance: *distance, arrives }
                }));
                for (part, position) in parts.iter().zip(&positions) {
                    self.put(axis, corners, (part.edge, part.first), *position);
                }
                if axis == Axis::Upright {
                    self.join(corners);
                }
                self.attach(corners);
            }
        }
        let junctions = self.settle(corners);
        complete(corners, &junctions);
        for (points, _) in corners.iter_mut().zip(self.fixed).filter(|(_, fixed)| !**fixed) {
            *points = without_straight_corners(std::mem::take(points));
        }
        crowded
    }

    /// Moves a part of an edge, given by its first corner, to a coordinate across.
    fn put(&self, axis: Axis, corners: &mut [Vec<Point>], (edge, first): (usize, usize), at: f64) {
        if self.fixed[edge] {
            return;
        }
        for corner in &mut corners[edge][first..first + 2] {
            match axis {
                Axis::Upright => corner.0 = at,
                Axis::Level => corner.1 = at,
            }
        }
    }

    /// Leads edges into those that they join, or into the nearest edge from above at their target.
    fn join(&self, corners: &mut [Vec<Point>]) {
        let arrives_at = |points: &[Point]| points.last().map(|tip| tip.0);
        let ends = |edge: usize| self.joins[edge] == Join::None;
        let trunks: Vec<(usize, f64)> = (0..corners.len())
            .filter(|edge| ends(*edge))
            .filter_map(|edge| Some((self.connectors[edge].to, arrives_at(&corners[edge])?)))
            .collect();
        let joining = |edge: &usize| matches!(self.joins[*edge], Join::Nearest | Join::Edge(_));
        for edge in (0..corners.len()).filter(joining) {
            let [.., before, turn, _] = corners[edge][..] else { continue };
            let own = trunks.iter().filter(|(to, _)| *to == self.connectors[edge].to);
            let distance = |x: f64| (x - before.0).abs();
            let nearest =
                || own.map(|(_, x)| *x).min_by(|a, b| distance(*a).total_cmp(&distance(*b)));
            let nearest = match self.joins[edge] {
                Join::Edge(trunk) if ends(trunk) => arrives_at(&corners[trunk]),
                _ => nearest(),
            };
            let last = corners[edge].len() - 2;
            self.put(Axis::Upright, corners, (edge, last), nearest.unwrap_or(turn.0));
        }
    }

    /// Moves the ends of joining edges to the new places of the joined edges.
    fn attach(&self, corners: &mut [Vec<Point>]) {
        for (edge, on) in self.junctions() {
            attach(corners, edge, on);
        }
    }

    /// Moves an end near a corner of the joined edge to that corner if the boxes leave space: a
    /// small shift would look like an error. Returns the new ends.
    fn settle(&self, corners: &mut [Vec<Point>]) -> Vec<(usize, Junction)> {
        let mut junctions: Vec<_> = self.junctions().collect();
        for (edge, on) in &mut junctions {
            attach(corners, *edge, *on);
            let Some(found) = on.corner(&corners[*edge], &corners[on.edge]) else { continue };
            let last = corners[*edge].len() - 2;
            let [from, to] = [corners[*edge][last], corners[*edge][last + 1]];
            let axis = Axis::of(from, to);
            let room = between(axis, self.boxes, axis.across(to), span(axis, from, to));
            let at = axis.across(found.at);
            if room.0 <= at && at <= room.1 {
                self.put(axis, corners, (*edge, last), at);
                *on = found.junction;
            }
        }
        junctions
    }

    /// The edges that end on others, with their junctions.
    fn junctions(&self) -> impl Iterator<Item = (usize, Junction)> {
        self.order.iter().filter_map(|edge| Some((*edge, self.joins[*edge].junction()?)))
    }

    /// Whether a part, given by its first corner, ends at the target.
    fn arrives(&self, edge: usize, first: usize, points: &[Point]) -> bool {
        first + 2 == points.len() && self.joins[edge].junction().is_none()
    }

    /// The ranges of parts that others continue, including the continuations.
    fn longer(&self, corners: &[Vec<Point>]) -> BTreeMap<(usize, usize), (f64, f64)> {
        let mut longer: BTreeMap<(usize, usize), (f64, f64)> = BTreeMap::new();
        let junctions: Vec<_> = self.junctions().filter(|(_, on)| on.along).collect();
        for (edge, on) in junctions.into_iter().rev() {
            let of = |edge: usize, first: usize| {
                span(on.axis(), corners[edge][first], corners[edge][first + 1])
            };
            let last = corners[edge].len() - 2;
            let own = longer.get(&(edge, last)).copied().unwrap_or_else(|| of(edge, last));
            let joined = longer.entry((on.edge, on.part)).or_insert_with(|| of(on.edge, on.part));
            *joined = (joined.0.min(own.0), joined.1.max(own.1));
        }
        longer
    }

    /// The free range of the last part of an edge that ends on another one.
    fn reach(&self, on: Junction, corners: &[Vec<Point>]) -> (f64, f64) {
        let points = &corners[on.edge];
        let ends = [points[on.part], points[on.part + 1]].map(|end| on.axis().along(end));
        let tip = if self.arrives(on.edge, on.part, points) { TIP } else { 0.0 };
        let exit = if on.part == 0 { TIP } else { 0.0 };
        let inset = if ends[0] < ends[1] { [exit, -tip] } else { [-exit, tip] };
        let (one, two) = (ends[0] + inset[0], ends[1] + inset[1]);
        (one.min(two), one.max(two))
    }

    /// The straight parts of all edges along an axis.
    fn parts(&self, axis: Axis, corners: &[Vec<Point>]) -> Vec<Part> {
        let mut parts = Vec::new();
        let longer = self.longer(corners);
        for (edge, points) in corners.iter().enumerate() {
            for (first, pair) in points.windows(2).enumerate() {
                let [a, b] = pair else { continue };
                let arrives = self.arrives(edge, first, points);
                let last = first + 2 == points.len();
                let joins = self.joins[edge].junction().filter(|_| last);
                let follows =
                    joins.is_some_and(|on| on.along) || arrives && self.joins[edge] != Join::None;
                if Axis::of(*a, *b) != axis || follows {
                    continue;
                }
                let at = axis.across(*a);
                let known = longer.get(&(edge, first)).copied();
                let span = known.unwrap_or_else(|| span(axis, *a, *b));
                let mut room = (at, at);
                if first > 0 && !self.fixed[edge] {
                    room = between(axis, self.boxes, at, span);
                    if arrives {
                        let (left, right) = self.connectors[edge].arrival;
                        room = (room.0.max(left), room.1.min(right));
                    }
                    if let Some(on) = joins {
                        let (from, to) = self.reach(on, corners);
                        room = (room.0.max(from), room.1.min(to));
                    }
                    room = (room.0.min(at), room.1.max(at));
                }
                parts.push(Part { edge, first, at, span, room });
            }
        }
        parts
    }
}

/// Moves the end of an edge to the new place of its joined edge.
fn attach(corners: &mut [Vec<Point>], edge: usize, on: Junction) {
    let (joined, axis) = (corners[on.edge][on.part], on.axis());
    let [.., before, end] = &mut corners[edge][..] else { return };
    let place = |corner: &mut Point| match axis {
        Axis::Upright => corner.0 = joined.0,
        Axis::Level => corner.1 = joined.1,
    };
    place(end);
    if on.along {
        place(before);
    }
}

/// Extends joined edges to their target.
fn complete(corners: &mut [Vec<Point>], junctions: &[(usize, Junction)]) {
    for (edge, on) in junctions {
        let rest = corners[on.edge][on.part + 1..].to_vec();
        corners[*edge].extend(rest);
    }
}

/// The range of a straight part along the axis.
fn span(axis: Axis, a: Point, b: Point) -> (f64, f64) {
    let (one, two) = (axis.along(a), axis.along(b));
    (one.min(two), one.max(two))
}

/// The movable parts and the fixed parts beside them.
fn that_matter(parts: Vec<Part>) -> Vec<Part> {
    if parts.iter().filter(|part| part.is_fixed()).count() * 4 < parts.len() * 3 {
        return parts;
    }
    let movable: Vec<_> = parts.iter().filter(|part| !part.is_fixed()).cloned().collect();
    let matters = |part: &Part| {
        let near = |other: &Part| (other.at - part.at).abs() < REACH && part.is_beside(other);
        !part.is_fixed() || movable.iter().any(near)
    };
    parts.into_iter().filter(matters).collect()
}

/// The space between the boxes next to a part.
fn between(axis: Axis, boxes: &[Bounds], at: f64, span: (f64, f64)) -> (f64, f64) {
    let mut room = (f64::NEG_INFINITY, f64::INFINITY);
    for each in boxes {
        let (across, along) = each.grown(-NEARER).ranges(axis);
        if along.0 < span.1 - 0.01 && span.0 + 0.01 < along.1 {
            if across.1 <= at + 0.01 {
                room.0 = room.0.max(across.1);
            } else if at - 0.01 <= across.0 {
                room.1 = room.1.min(across.0);
            }
        }
    }
    room
}

/// The places of the parts in the given order, and the parts with too little space, with their
/// distance.
fn positions(parts: &[Part], order: &[usize]) -> (Vec<f64>, Vec<(usize, f64)>) {
    let ranks = Ranks::new(parts);
    let wishes = wishes(parts, order);
    let mut distance = vec![PITCH; parts.len()];
    let mut narrow = vec![false; parts.len()];
    for _ in 0..ATTEMPTS {
        let least = ranks.pushed(order, &distance, |part, pushed| match parts[part].is_fixed() {
            true => parts[part].at,
            false => pushed.max(parts[part].room.0),
        });
        let most = most(parts, order, &ranks, &distance);
        let mut fits = true;
        for part in order {
            if least[*part] > most[*part] + 1e-6 {
                (fits, narrow[*part]) = (false, true);
                distance[*part] *= TIGHTER;
            }
        }
        if fits {
            break;
        }
    }
    let most = most(parts, order, &ranks, &distance);
    let within = |part: usize, pushed: f64| {
        let Part { room, .. } = parts[part];
        pushed.max(wishes[part]).min(most[part]).max(room.0).min(room.1)
    };
    let positions = ranks.pushed(order, &distance, within);
    let narrow = order.iter().filter(|part| narrow[**part]);
    (positions, narrow.map(|part| (*part, distance[*part])).collect())
}

/// The maximum coordinate of each part.
fn most(parts: &[Part], order: &[usize], ranks: &Ranks, distance: &[f64]) -> Vec<f64> {
    let backwards: Vec<_> = order.iter().rev().copied().collect();
    let mirrored =
        ranks.pushed(&backwards, distance, |part, pushed| match parts[part].is_fixed() {
            true => -parts[part].at,
            false => pushed.max(-parts[part].room.1),
        });
    mirrored.into_iter().map(|position| -position).collect()
}

/// The preferred places of the parts: those of the search, with the parts of one line around it.
fn wishes(parts: &[Part], order: &[usize]) -> Vec<f64> {
    let mut wishes: Vec<_> = parts.iter().map(|part| part.at).collect();
    let mut by_line: Vec<(usize, usize)> = order.iter().copied().enumerate().collect();
    by_line.sort_by(|a, b| parts[a.1].at.total_cmp(&parts[b.1].at).then(a.0.cmp(&b.0)));
    for line in by_line.chunk_by(|a, b| (parts[a.1].at - parts[b.1].at).abs() < 0.5) {
        let line: Vec<_> = line.iter().map(|(_, part)| *part).collect();
        if let [_, _, ..] = line[..] {
            let (before, after) = (depths(parts, &line, false), depths(parts, &line, true));
            for (index, part) in line.iter().enumerate() {
                let shift = f64::from(before[index]) - f64::from(after[index]);
                wishes[*part] += shift / 2.0 * PITCH;
            }
        }
    }
    wishes
}

/// The number of a line's parts before or after each part, side by side.
fn depths(parts: &[Part], line: &[usize], backwards: bool) -> Vec<u32> {
    let mut depths = vec![0; line.len()];
    for step in 0..line.len() {
        let index = |step: usize| if backwards { line.len() - 1 - step } else { step };
        let own = index(step);
        let beside = (0..step).map(index);
        let beside = beside.filter(|other| overlap(&parts[line[own]], &parts[line[*other]]));
        depths[own] = beside.map(|other| depths[other] + 1).max().unwrap_or(0);
    }
    depths
}

fn overlap(a: &Part, b: &Part) -> bool {
    a.span.0 - MARGIN < b.span.1 + MARGIN && b.span.0 - MARGIN < a.span.1 + MARGIN
}

/// The ranges of the parts along the axis as ranks.
struct Ranks {
    count: usize,
    ranges: Vec<(usize, usize)>,
}

impl Ranks {
    fn new(parts: &[Part]) -> Ranks {
        let spans: Vec<_> =
            parts.iter().map(|part| (part.span.0 - MARGIN, part.span.1 + MARGIN)).collect();
        let mut ends: Vec<f64> = spans.iter().flat_map(|(from, to)| [*from, *to]).collect();
        ends.sort_by(f64::total_cmp);
        ends.dedup();
        let rank = |end: f64| ends.partition_point(|other| *other < end);
        // Nothing changes between two neighbouring ends, so a range is a set of intervals.
        let range = |(from, to): &(f64, f64)| (rank(*from), rank(*to).max(rank(*from) + 1) - 1);
        Ranks { count: ends.len(), ranges: spans.iter().map(range).collect() }
    }

    /// Places the parts in order: `place` gets the pressure of earlier parts on a part.
    fn pushed(
        &self,
        order: &[usize],
        distance: &[f64],
        position: impl Fn(usize, f64) -> f64,
    ) -> Vec<f64> {
        let mut skyline = Maxima::new(self.count);
        let mut positions = vec![0.0; order.len()];
        for part in order {
            let ((first, last), half) = (self.ranges[*part], distance[*part] / 2.0);
            let found = position(*part, skyline.greatest(first, last) + half);
            positions[*part] = found;
            skyline.raise(first, last, found + half);
        }
        positions
    }
}
