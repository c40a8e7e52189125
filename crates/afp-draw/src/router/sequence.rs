//! The order of parallel edges.
//!
//! Two parallel parts diverge at both ends of their common range. Each end determines an order
//! without a crossing there. If the ends disagree, one crossing remains in any order. Starting from
//! the order of the search, parts swap with their neighbours as long as this saves crossings.

use super::{Axis, PITCH, Point};

/// Parts farther apart keep their order.
pub(super) const REACH: f64 = 160.0;

/// The cost, in crossings, of swapping two parts at a distance of one pixel.
const SWAP: f64 = 0.004;

/// The extra weight for one end if the two ends disagree.
const AHEAD: f64 = 1.01;

/// The number of rounds over all parts.
const ROUNDS: usize = 8;

/// A straight part of an edge.
#[derive(Clone, Debug)]
pub(super) struct Part {
    pub(super) edge: usize,
    /// Its first corner.
    pub(super) first: usize,
    /// Its coordinate across.
    pub(super) at: f64,
    /// Its range along.
    pub(super) span: (f64, f64),
    /// Its free range across; a single place if it is fixed.
    pub(super) room: (f64, f64),
}

impl Part {
    pub(super) fn is_fixed(&self) -> bool {
        self.room.0 >= self.room.1
    }

    /// Whether it is next to another part, or nearly.
    pub(super) fn is_beside(&self, other: &Part) -> bool {
        let margin = PITCH;
        self.span.0 - margin < other.span.1 && other.span.0 - margin < self.span.1
    }
}

/// The parts in an order with few crossings.
pub(super) fn sequence(axis: Axis, parts: &[Part], corners: &[Vec<Point>]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..parts.len()).collect();
    let by_place = |a: &usize, b: &usize| {
        let (a, b) = (&parts[*a], &parts[*b]);
        a.at.total_cmp(&b.at).then((a.edge, a.first).cmp(&(b.edge, b.first)))
    };
    order.sort_by(by_place);
    let mut keys = vec![0.0; parts.len()];
    for (index, part) in order.iter().enumerate() {
        keys[*part] = index as f64;
    }
    let near = neighbours(parts, &order);
    let costs = costs(axis, parts, corners, &near);
    for _ in 0..ROUNDS {
        let mut improved = false;
        for part in &order {
            improved |= place_anew(*part, &near[*part], &costs[*part], &mut keys);
        }
        if !improved {
            break;
        }
    }
    order.sort_by(|a, b| keys[*a].total_cmp(&keys[*b]));
    order
}

/// For each part, the parts next to it within reach.
fn neighbours(parts: &[Part], order: &[usize]) -> Vec<Vec<usize>> {
    let mut near = vec![Vec::new(); parts.len()];
    for (index, one) in order.iter().enumerate() {
        let reached =
            order[index + 1..].iter().take_while(|two| parts[**two].at - parts[*one].at < REACH);
        for two in reached {
            let both_fixed = parts[*one].is_fixed() && parts[*two].is_fixed();
            if !both_fixed && parts[*one].is_beside(&parts[*two]) {
                near[*one].push(*two);
                near[*two].push(*one);
            }
        }
    }
    near
}

/// For each part and each neighbour: the additional cost of the order after it.
fn costs(axis: Axis, parts: &[Part], corners: &[Vec<Point>], near: &[Vec<usize>]) -> Vec<Vec<f64>> {
    let cost = |one: usize, two: &usize| {
        let (a, b) = (&parts[one], &parts[*two]);
        if a.room.0 >= b.room.1 {
            return -1e6;
        }
        if b.room.0 >= a.room.1 {
            return 1e6;
        }
        let (first, second) = if a.edge <= b.edge { (a, b) } else { (b, a) };
        let votes = votes(axis, first, second, corners);
        let votes = if a.edge <= b.edge { votes } else { -votes };
        // A positive vote puts `a` after `b`.
        SWAP * (b.at - a.at) - votes
    };
    (0..parts.len()).map(|one| near[one].iter().map(|two| cost(one, two)).collect()).collect()
}

/// The votes for `a` after `b`.
fn votes(axis: Axis, a: &Part, b: &Part, corners: &[Vec<Point>]) -> f64 {
    let points = &corners[a.edge];
    let onwards = axis.along(points[a.first]) < axis.along(points[a.first + 1]);
    [true, false]
        .into_iter()
        .map(|up| {
            let vote = f64::from(vote(axis, a, b, corners, up));
            if up == onwards { vote * AHEAD } else { vote }
        })
        .sum()
}

/// The required order at an end of the parts: 1 for `a` after `b`, -1 for `b` after `a`, 0 for no
/// preference.
fn vote(axis: Axis, a: &Part, b: &Part, corners: &[Vec<Point>], up: bool) -> i8 {
    let right = divergence(Walk::new(axis, a, corners, up), Walk::new(axis, b, corners, up));
    // For an upward or rightward direction, the right side is after.
    let after = matches!((axis, up), (Axis::Upright, false) | (Axis::Level, true));
    if after { right } else { -right }
}

/// 1 if the first walk turns away to the right of the other, -1 if to the left.
fn divergence(mut one: Walk, mut two: Walk) -> i8 {
    loop {
        let ahead = one.ahead_of(&two);
        let turns = (one.turn(), two.turn());
        if ahead < -0.01 {
            return turns.0;
        }
        if ahead > 0.01 {
            return -turns.1;
        }
        if turns.0 != turns.1 || turns.0 == 0 {
            return (turns.0 - turns.1).signum();
        }
        if !one.go_on() || !two.go_on() {
            return 0;
        }
    }
}

/// A walk along the corners of an edge.
struct Walk<'a> {
    points: &'a [Point],
    /// The next corner.
    to: usize,
    /// Whether it goes towards later corners.
    onwards: bool,
    /// The direction, one of the four.
    direction: (f64, f64),
}

impl<'a> Walk<'a> {
    /// From inside of a part towards greater or smaller coordinates along its axis.
    fn new(axis: Axis, part: &Part, corners: &'a [Vec<Point>], up: bool) -> Walk<'a> {
        let points = corners[part.edge].as_slice();
        let (start, end) = (points[part.first], points[part.first + 1]);
        let onwards = (axis.along(start) < axis.along(end)) == up;
        let to = if onwards { part.first + 1 } else { part.first };
        let sign = if up { 1.0 } else { -1.0 };
        let direction = if axis == Axis::Upright { (0.0, sign) } else { (sign, 0.0) };
        Walk { points, to, onwards, direction }
    }

    /// The additional distance of its next corner compared to the other walk, in its direction.
    fn ahead_of(&self, other: &Walk) -> f64 {
        let (own, its) = (self.points[self.to], other.points[other.to]);
        (own.0 - its.0) * self.direction.0 + (own.1 - its.1) * self.direction.1
    }

    fn following(&self) -> Option<usize> {
        let next = if self.onwards { self.to.checked_add(1) } else { self.to.checked_sub(1) };
        next.filter(|next| *next < self.points.len())
    }

    /// 1 for a turn to the right at the next corner, -1 for one to the left, 0 at the end.
    fn turn(&self) -> i8 {
        let Some(next) = self.following() else { return 0 };
        let (here, there) = (self.points[self.to], self.points[next]);
        let (dx, dy) = (there.0 - here.0, there.1 - here.1);
        let cross = self.direction.0 * dy - self.direction.1 * dx;
        // Ordinates grow downwards.
        if cross > 0.0 { 1 } else { -1 }
    }

    fn go_on(&mut self) -> bool {
        let Some(next) = self.following() else { return false };
        let (here, there) = (self.points[self.to], self.points[next]);
        let (dx, dy) = (there.0 - here.0, there.1 - here.1);
        self.direction = if dx.abs() > dy.abs() { (dx.signum(), 0.0) } else { (0.0, dy.signum()) };
        self.to = next;
        true
    }
}

/// Moves a part to its best place among its neighbours; returns whether it moved.
fn place_anew(part: usize, near: &[usize], costs: &[f64], keys: &mut [f64]) -> bool {
    if near.is_empty() {
        return false;
    }
    let mut sorted: Vec<(f64, f64)> =
        near.iter().zip(costs).map(|(other, cost)| (keys[*other], *cost)).collect();
    sorted.sort_by(|a, b| a.0.total_cmp(&b.0));
    // The place before all of them is free; each place after one has that one's cost.
    let (mut cost, mut best, mut now) = (0.0, (0.0, 0), (0.0, 0));
    for (index, (key, more)) in sorted.iter().enumerate() {
        cost += more;
        if cost < best.0 - 1e-6 {
            best = (cost, index + 1);
        }
        if *key < keys[part] {
            now = (cost, index + 1);
        }
    }
    if best.0 > now.0 - 1e-6 {
        return false;
    }
    let before = best.1.checked_sub(1).map(|index| sorted[index].0);
    let after = sorted.get(best.1).map(|next| next.0);
    keys[part] = match (before, after) {
        (Some(before), Some(after)) => before.midpoint(after),
        (Some(before), None) => before + 1.0,
        (None, Some(after)) => after - 1.0,
        (None, None) => keys[part],
    };
    true
}
