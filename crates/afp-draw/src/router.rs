//! Finds right-angled routes for edges between boxes at any places.
//!
//! Each edge takes the cheapest path over the relevant lines ([`lines`]): along the borders of
//! boxes, straight out of exits and straight into targets. The search ([`search`]) counts length,
//! bends, crossings and how full the gaps between boxes are ([`gaps`]). Edges on a common line get
//! the order with the fewest crossings ([`sequence`]) and are moved apart as far as the gap allows
//! ([`spread`]). Many edges of one kind to one box merge where they meet ([`bundle`]).
//!
//! Time and memory depend on the numbers of boxes and edges, and not on their places. Both have a
//! bound: edges with too many lines are routed in parts, and the rest gets plain routes without a
//! search. Kept routes stay exactly the same, and others go around them.

mod bundle;
mod gaps;
mod lay;
mod lines;
mod merge;
mod queue;
mod search;
mod sequence;
mod spread;
mod tree;

#[cfg(test)]
mod tests;

use super::polyline::distance;
use bundle::Trees;
pub(super) use bundle::bundles;
use lay::Laid;
use lines::Lines;

/// Edges within this distance look like one.
const LEAST: f64 = 6.0;

/// The search effort after which no edge is moved any longer, in states: about a second.
pub(super) const BUDGET: u64 = 20_000_000;

/// The search effort after which edges get plain routes: some seconds.
const MOST_EFFORT: u64 = 100_000_000;

/// The maximum number of nodes in one search, about 100 MB.
const MOST_NODES: u32 = 1 << 20;

/// A place in pixels, y downwards.
pub(super) type Point = (f64, f64);

/// Distance between parallel edges.
pub(super) const PITCH: f64 = 12.0;

/// Minimum distance between a passing edge and a box.
pub(super) const CLEAR: f64 = 11.0;

/// Space for the tip of an arrow above a box.
pub(super) const TIP: f64 = 24.0;

/// A rectangle that edges keep away from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Bounds {
    pub(super) left: f64,
    pub(super) top: f64,
    pub(super) right: f64,
    pub(super) bottom: f64,
}

/// The direction in which an edge leaves its box.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Heading {
    Down,
    Right,
}

/// An edge to route; its result is in [`Routes`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Connector {
    /// The start box, by index.
    pub(super) from: usize,
    /// The target box, by index.
    pub(super) to: usize,
    pub(super) start: Point,
    pub(super) heading: Heading,
    /// The range where it may arrive.
    pub(super) arrival: (f64, f64),
    /// The ordinate of its tip.
    pub(super) tip: f64,
    /// Edges of one kind may merge before their target.
    pub(super) kind: &'static str,
}

/// The result.
#[derive(Clone, Debug, Default)]
pub(super) struct Routes {
    /// The corners of each edge, start and tip included.
    pub(super) corners: Vec<Vec<Point>>,
    /// Places where the distance between edges is less than [`PITCH`].
    pub(super) crowded: Vec<Crowded>,
    /// The number of expanded states, which dominates the time.
    pub(super) effort: u64,
}

/// A straight part of an edge in a gap that is too narrow.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Crowded {
    pub(super) edge: usize,
    pub(super) axis: Axis,
    /// Its abscissa if vertical, or else its ordinate.
    pub(super) at: f64,
    /// Its range along the axis.
    pub(super) span: (f64, f64),
    /// The distance to its neighbours.
    pub(super) distance: f64,
    /// Whether the edge arrives here, so that the box is too narrow and not a gap.
    pub(super) arrives: bool,
}

/// The direction of a line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Axis {
    Upright,
    Level,
}

impl Bounds {
    /// The area that edges must not enter.
    fn inflated(&self) -> Bounds {
        Bounds {
            left: self.left - CLEAR,
            top: self.top - TIP,
            right: self.right + CLEAR,
            bottom: self.bottom + CLEAR,
        }
    }

    /// The bounds of both.
    pub(super) fn with(self, other: Bounds) -> Bounds {
        Bounds {
            left: self.left.min(other.left),
            top: self.top.min(other.top),
            right: self.right.max(other.right),
            bottom: self.bottom.max(other.bottom),
        }
    }

    pub(super) fn width(&self) -> f64 {
        self.right - self.left
    }

    pub(super) fn height(&self) -> f64 {
        self.bottom - self.top
    }

    /// The bounds, larger by this distance on each side.
    fn grown(&self, by: f64) -> Bounds {
        Bounds {
            left: self.left - by,
            top: self.top - by,
            right: self.right + by,
            bottom: self.bottom + by,
        }
    }

    /// The ranges across and along an axis.
    fn ranges(&self, axis: Axis) -> ((f64, f64), (f64, f64)) {
        let (level, upright) = ((self.left, self.right), (self.top, self.bottom));
        match axis {
            Axis::Upright => (level, upright),
            Axis::Level => (upright, level),
        }
    }
}

impl Axis {
    /// The axis of a straight part between two points.
    fn of(a: Point, b: Point) -> Axis {
        if (a.0 - b.0).abs() < (a.1 - b.1).abs() { Axis::Upright } else { Axis::Level }
    }

    /// The coordinate of a straight part across this axis, and its range along it.
    fn part(self, a: Point, b: Point) -> (f64, (f64, f64)) {
        let (one, two) = (self.along(a), self.along(b));
        (self.across(a), (one.min(two), one.max(two)))
    }

    /// The coordinate of a point across a line of this axis.
    pub(super) fn across(self, (x, y): Point) -> f64 {
        if self == Axis::Upright { x } else { y }
    }

    /// The coordinate of a point along a line of this axis.
    pub(super) fn along(self, (x, y): Point) -> f64 {
        if self == Axis::Upright { y } else { x }
    }
}

impl Connector {
    /// The start of its search: directly outside of its box.
    fn escape(&self, boxes: &[Bounds]) -> Point {
        match self.heading {
            Heading::Down => (self.start.0, boxes[self.from].bottom),
            Heading::Right => (boxes[self.from].right, self.start.1),
        }
    }

    /// Its default arrival: above the middle of its range.
    fn gate(&self) -> Point {
        ((self.arrival.0 + self.arrival.1) / 2.0, self.tip - TIP)
    }
}

/// Routes all edges; the corners in `kept` stay.
pub(super) fn route(
    boxes: &[Bounds],
    connectors: &[Connector],
    kept: &[Option<Vec<Point>>],
) -> Routes {
    route_within(MOST_NODES, boxes, connectors, kept)
}

/// Like [`route`], with this maximum number of nodes at once.
fn route_within(
    most: u32,
    boxes: &[Bounds],
    connectors: &[Connector],
    kept: &[Option<Vec<Point>>],
) -> Routes {
    let boxes: Vec<_> = boxes.iter().map(Bounds::inflated).collect();
    let kept_of = |connector: usize| kept.get(connector).and_then(Option::as_deref);
    let mut order: Vec<_> =
        (0..connectors.len()).filter(|connector| kept_of(*connector).is_none()).collect();
    let corners: Vec<Vec<Point>> = (0..connectors.len())
        .map(|connector| kept_of(connector).unwrap_or_default().to_vec())
        .collect();
    if order.is_empty() {
        return Routes { corners, ..Routes::default() };
    }
    // Short edges first: long edges go around them.
    let length = |edge: usize| distance(connectors[edge].start, connectors[edge].gate());
    order.sort_by(|a, b| length(*a).total_cmp(&length(*b)));
    let mut routes = Routes { corners, ..Routes::default() };
    let mut parts = vec![order];
    while let Some(mut part) = parts.pop() {
        let searched = routes.effort <= MOST_EFFORT;
        let trees = Trees::new(connectors);
        let joined = (0..connectors.len()).filter(|connector| trees.holds(*connector));
        let joined = joined.flat_map(|connector| &routes.corners[connector]).copied();
        let lines = || Lines::new(&boxes, connectors, &part, joined, most);
        let lines = searched.then(lines).flatten();
        if searched && lines.is_none() {
            routes.effort += u64::from(most);
            if part.len() > 1 {
                parts.push(part.split_off(part.len() / 2));
                parts.push(part);
                continue;
            }
        }
        // Without lines, each edge gets a plain route.
        let lines = lines.unwrap_or_default();
        let mut laid = Laid::new(&boxes, connectors, &lines, trees, routes.corners);
        laid.lay_all(&part);
        let found = laid.routes();
        routes.corners = found.corners;
        routes.crowded.extend(found.crowded);
        routes.effort += found.effort;
    }
    routes
}

/// Drops corners on the straight line between their neighbours, and repeated corners.
pub(super) fn without_straight_corners(points: Vec<Point>) -> Vec<Point> {
    let mut kept: Vec<Point> = Vec::with_capacity(points.len());
    let near = |a: f64, b: f64| (a - b).abs() < 0.05;
    for point in points {
        if kept.last().is_some_and(|last| near(last.0, point.0) && near(last.1, point.1)) {
            continue;
        }
        if let [.., before, last] = kept[..] {
            let upright = near(before.0, last.0) && near(last.0, point.0);
            let level = near(before.1, last.1) && near(last.1, point.1);
            if upright || level {
                kept.pop();
            }
        }
        kept.push(point);
    }
    kept
}
