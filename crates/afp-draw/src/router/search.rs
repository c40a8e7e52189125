//! The cheapest path of one edge over the lines: A* with bends, crossings and full gaps.

use super::bundle::{Junction, Tree};
use super::gaps::Gaps;
use super::lines::{DOWN, LEFT, Lines, NONE, RIGHT, UP, axis_of};
use super::queue::Queue;
use super::{
    Axis, Bounds, Connector, Crowded, Heading, MOST_EFFORT, PITCH, Point, TIP,
    without_straight_corners,
};

/// Costs in tenths of a pixel: a bend, a crossing, each excess edge in a gap.
const BEND: u64 = 600;
const CROSSING: u64 = 250;
const TOO_MANY: u64 = 2500;

/// The number of edges that a gap counts after it was too narrow.
const MANY: u32 = 20;

/// A gap that was not yet looked up.
const UNKNOWN: u32 = NONE - 1;

/// The state of a search at a node and a direction.
#[derive(Clone, Copy, Debug)]
struct Visit {
    stamp: u32,
    cost: u64,
    /// The previous state.
    from: u32,
}

/// All paths so far, and buffers for the next search.
pub(super) struct Search<'a> {
    lines: &'a Lines,
    upright: Gaps,
    level: Gaps,
    /// The gap below and the gap to the right of each node, or [`UNKNOWN`] before its first use. If
    /// most routes are kept, few nodes are used.
    gap_of: Vec<[u32; 2]>,
    /// The number of vertical and horizontal edges through each node.
    passing: Vec<[u16; 2]>,
    /// The number of edges that arrive at each box.
    arrived: Vec<u32>,
    visits: Vec<Visit>,
    stamp: u32,
    queue: Queue,
    /// The number of expanded states of all searches.
    effort: u64,
}

/// The possible ends of a path.
struct Goal<'t> {
    left: f64,
    right: f64,
    y: f64,
    /// Whether the box is full: a further edge arrives from the side and joins the others.
    full: bool,
    /// The tree that it may join instead.
    tree: Option<&'t Tree>,
}

impl<'a> Search<'a> {
    /// Starts with the kept edges.
    pub(super) fn new(lines: &'a Lines, boxes: &[Bounds], kept: &[Vec<Point>]) -> Search<'a> {
        let nodes = lines.positions.len();
        let mut search = Search {
            lines,
            upright: Gaps::new(boxes, Axis::Upright, kept),
            level: Gaps::new(boxes, Axis::Level, kept),
            gap_of: vec![[UNKNOWN; 2]; nodes],
            passing: vec![[0; 2]; nodes],
            arrived: vec![0; boxes.len()],
            visits: vec![Visit { stamp: 0, cost: 0, from: NONE }; 4 * nodes],
            stamp: 0,
            queue: Queue::new(),
            effort: 0,
        };
        for pair in kept.iter().flat_map(|points| points.windows(2)) {
            search.pass(pair[0], pair[1]);
        }
        search
    }

    /// The corners of the best path, which is then taken; a plain path if boxes leave no gap. With
    /// `joins`, it arrives from the side, next to edges from above. It ends at the tree of its
    /// bundle.
    pub(super) fn route(
        &mut self,
        connector: &Connector,
        boxes: &[Bounds],
        joins: bool,
        tree: Option<&Tree>,
    ) -> (Vec<Point>, Option<Junction>) {
        let escape = connector.escape(boxes);
        let (left, right) = connector.arrival;
        let goal = Goal { left, right, y: connector.tip - TIP, full: joins, tree };
        let side = if connector.heading == Heading::Down { DOWN } else { RIGHT };
        // If another box covers the arrival, a search would be in vain.
        let searched = self.effort <= MOST_EFFORT;
        let start = self.lines.node(escape).filter(|_| searched && self.is_free(&goal));
        let end = start.and_then(|node| self.find(node, side, &goal));
        let junction = end.and_then(|end| self.junction(end, &goal));
        let mut points = vec![connector.start];
        match end {
            Some(end) => points.extend(self.path(end)),
            None => points.extend(plain(escape, connector)),
        }
        if junction.is_none() {
            let end = points.last().map_or(connector.start.0, |last| last.0);
            points.push((end, connector.tip));
            self.arrived[connector.to] += u32::from(!joins);
        }
        let points = without_straight_corners(points);
        self.occupy(&points);
        (points, junction)
    }

    /// Whether a path has a possible end.
    fn is_free(&self, goal: &Goal) -> bool {
        let positions = &self.lines.positions;
        let first = positions.partition_point(|(x, _)| *x < goal.left);
        let near = positions[first..].iter().take_while(|(x, _)| *x <= goal.right);
        goal.tree.is_some() || near.into_iter().any(|at| goal.holds(*at))
    }

    /// The number of expanded states so far.
    pub(super) fn effort(&self) -> u64 {
        self.effort
    }

    /// Whether the target of an edge is full.
    pub(super) fn is_full(&self, connector: &Connector) -> bool {
        f64::from(self.arrived[connector.to]) > (connector.arrival.1 - connector.arrival.0) / PITCH
    }

    /// Records an edge along these corners.
    fn occupy(&mut self, points: &[Point]) {
        for pair in points.windows(2) {
            let [a, b] = pair else { continue };
            let axis = Axis::of(*a, *b);
            let (at, span) = axis.part(*a, *b);
            let gaps = if axis == Axis::Upright { &mut self.upright } else { &mut self.level };
            gaps.take(at, span, 1);
            self.pass(*a, *b);
        }
    }

    /// Raises the cost of the gaps around a part for later edges.
    pub(super) fn avoid(&mut self, part: &Crowded) {
        let gaps = if part.axis == Axis::Upright { &mut self.upright } else { &mut self.level };
        gaps.take(part.at, part.span, MANY);
    }

    /// Counts an edge at the nodes of a straight part.
    fn pass(&mut self, a: Point, b: Point) {
        let upright = Axis::of(a, b) == Axis::Upright;
        for node in self.lines.along(a, b) {
            let passing = &mut self.passing[node as usize][usize::from(!upright)];
            *passing = passing.saturating_add(1);
        }
    }

    /// The final state of the cheapest path.
    fn find(&mut self, start: u32, side: usize, goal: &Goal) -> Option<u32> {
        self.stamp += 1;
        self.queue.clear();
        self.reach(state(start, side), 0, NONE, goal);
        while let Some((cost, at)) = self.queue.pop() {
            if cost > self.visits[at as usize].cost {
                continue;
            }
            self.effort += 1;
            let (node, side) = ((at / 4) as usize, (at % 4) as usize);
            let arrives = side == DOWN && goal.holds(self.lines.positions[node]);
            if arrives || self.junction(at, goal).is_some() {
                return Some(at);
            }
            for turned in turns(side) {
                self.reach(state(at / 4, turned), cost + BEND, at, goal);
            }
            let next = self.lines.next[node][side];
            let joins =
                || goal.full && side == DOWN && goal.holds(self.lines.positions[next as usize]);
            if next != NONE && !joins() {
                let cost = cost + self.step(node, next as usize, side);
                self.reach(state(next, side), cost, at, goal);
            }
        }
        None
    }

    /// Records a path to a state if it is the best one so far.
    fn reach(&mut self, at: u32, cost: u64, from: u32, goal: &Goal) {
        let stamp = self.stamp;
        let Some(visit) = self.visits.get_mut(at as usize) else { return };
        if visit.stamp == stamp && visit.cost <= cost {
            return;
        }
        *visit = Visit { stamp, cost, from };
        let rest = goal.rest(self.lines.positions[(at / 4) as usize], (at % 4) as usize);
        self.queue.push(cost, rest, at);
    }

    /// The gap below a node, or to the right of it.
    fn gap(&mut self, node: usize, upright: bool) -> u32 {
        let known = self.gap_of[node][usize::from(!upright)];
        if known != UNKNOWN {
            return known;
        }
        let (gaps, side) = if upright { (&self.upright, DOWN) } else { (&self.level, RIGHT) };
        let end = self.lines.positions.get(self.lines.next[node][side] as usize);
        let found = end.and_then(|end| {
            let (axis, start) = (gaps.axis(), self.lines.positions[node]);
            let middle = (axis.along(start) + axis.along(*end)) / 2.0;
            u32::try_from(gaps.at(middle, axis.across(start))).ok()
        });
        let gap = found.unwrap_or(NONE);
        self.gap_of[node][usize::from(!upright)] = gap;
        gap
    }

    fn step(&mut self, node: usize, next: usize, side: usize) -> u64 {
        let (from, to) = (self.lines.positions[node], self.lines.positions[next]);
        let upright = axis_of(side) == Axis::Upright;
        let crossed = self.passing[next][usize::from(upright)];
        let first = if side == DOWN || side == RIGHT { node } else { next };
        let gap = self.gap(first, upright);
        let gaps = if upright { &mut self.upright } else { &mut self.level };
        let excess = if gap == NONE { 0 } else { gaps.excess(gap as usize) };
        tenths((from.0 - to.0).abs() + (from.1 - to.1).abs())
            + CROSSING * u64::from(crossed)
            + TOO_MANY * u64::from(excess)
    }

    /// The place where a path has met its tree: from the side, or in the same direction if it does
    /// not come straight from its fixed exit.
    fn junction(&self, end: u32, goal: &Goal) -> Option<Junction> {
        let junction = goal.tree?.get(&(end / 4)).copied()?;
        let side = (end % 4) as usize;
        let before = self.visits[end as usize].from;
        let turned_here = before != NONE && before / 4 == end / 4;
        let along = axis_of(side) == junction.axis();
        let has_turned = || self.states(end).any(|state| state % 4 != end % 4);
        let joins = !along || side == junction.side && has_turned();
        (joins && !turned_here).then_some(junction)
    }

    /// The states of a path, from its end back.
    fn states(&self, end: u32) -> impl Iterator<Item = u32> {
        let before = |at: &u32| Some(self.visits[*at as usize].from).filter(|from| *from != NONE);
        std::iter::successors(Some(end), before)
    }

    fn path(&self, end: u32) -> Vec<Point> {
        let states = self.states(end);
        let mut points: Vec<_> = states.map(|at| self.lines.positions[(at / 4) as usize]).collect();
        points.reverse();
        points
    }
}

impl Goal<'_> {
    fn holds(&self, (x, y): Point) -> bool {
        (y - self.y).abs() < 0.01 && self.left <= x && x <= self.right
    }

    /// The lower bound of the remaining cost from a place in a direction.
    fn rest(&self, (x, y): Point, side: usize) -> u64 {
        if self.tree.is_some() {
            // The tree may be anywhere.
            return 0;
        }
        let across = (self.left - x).max(x - self.right).max(0.0);
        let below = y > self.y + 0.01;
        let bends = match side {
            DOWN if below => 4,
            DOWN if across > 0.0 => 2,
            DOWN => 0,
            UP if below && across > 0.0 => 2,
            UP => 4,
            _ if below => 3,
            _ => {
                let towards = if side == RIGHT { x <= self.right } else { x >= self.left };
                if towards { 1 } else { 3 }
            }
        };
        tenths(across + (y - self.y).abs()) + bends * BEND
    }
}

fn state(node: u32, side: usize) -> u32 {
    // There are four sides.
    node.saturating_mul(4).saturating_add(side as u32)
}

fn turns(side: usize) -> [usize; 2] {
    if side <= DOWN { [LEFT, RIGHT] } else { [UP, DOWN] }
}

/// Positions fit into 32 bits, so that no sum of lengths overflows.
fn tenths(length: f64) -> u64 {
    (length * 10.0) as u64
}

/// A plain path without a search, for overlapping boxes.
fn plain(escape: Point, connector: &Connector) -> Vec<Point> {
    let gate = connector.gate();
    match connector.heading {
        Heading::Down => vec![escape, (gate.0, escape.1), gate],
        Heading::Right => vec![escape, (escape.0, gate.1), gate],
    }
}
