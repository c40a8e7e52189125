//! The places of boxes: a layered layout, around boxes with given places.
//!
//! It follows Sugiyama's scheme in stages, one per file. Elements get layers ([`layers`]). Edges
//! get dummy nodes in every layer that they pass ([`grid`]), which reserve space. Each layer gets
//! an order with few crossings ([`order`]), items get abscissas ([`place`]) and layers get
//! ordinates ([`rows`]).
//!
//! Edges leave boxes below (states) or on the right (events) and arrive from above; edges back up
//! run next to the boxes. The [`router`](super::router) finds the routes of edges, and boxes give
//! way if a route has too little space. The layout is deterministic. If some boxes have given
//! places ([`placed`]), the others go around them.

mod channel;
mod fold;
mod grid;
mod layers;
mod order;
mod place;
mod placed;
mod rows;

use grid::Grid;
pub(super) use placed::{ABOVE, places, routed};
use rows::Rows;

use super::router::{self, Bounds, Connector, Heading, Point};
use super::sketch::Rect;

/// A box with all its parts; edges keep away from it.
#[derive(Clone, Debug)]
pub(super) struct Node {
    /// Width in pixels, without space for edges that leave on the right.
    pub(super) width: f64,
    /// Height in pixels.
    pub(super) height: f64,
    /// The range on the upper border where edges may arrive, from the left edge.
    pub(super) entry: (f64, f64),
    /// The corner of its position, from the upper left corner.
    pub(super) anchor: Point,
}

impl Node {
    /// The nearest corner for which the node's position is whole.
    fn whole(&self, (x, y): Point) -> Point {
        let (dx, dy) = self.anchor;
        ((x + dx).round() - dx, (y + dy).round() - dy)
    }
}

/// An edge from a place on one box to the upper border of another box, or of the same box.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Link {
    /// The start, an index into the nodes.
    pub(super) from: usize,
    /// The target.
    pub(super) to: usize,
    /// The place on `from`.
    pub(super) exit: Exit,
    /// Edges of one kind may merge before their target.
    pub(super) kind: &'static str,
}

/// Where an edge leaves its box, from the box's upper left corner.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Exit {
    /// Downwards.
    Below(f64, f64),
    Right(f64, f64),
}

/// The result: places in pixels. Without given places, the uppermost box touches the upper axis and
/// the leftmost box touches the left axis.
#[derive(Clone, Debug, Default)]
pub(super) struct LaidOut {
    /// The upper left corner of each node.
    pub(super) corners: Vec<Point>,
    /// The corners of each link's polyline, start and tip included.
    pub(super) routes: Vec<Vec<Point>>,
    pub(super) bounds: Rect,
}

/// The maximum number of times that boxes give way to edges.
const ROUNDS: usize = 4;

/// The nodes in layers, each at its best place from left to right.
fn arranged(nodes: &[Node], links: &[Link]) -> Grid {
    let layers = layers::assign(nodes.len(), links);
    let mut grid = Grid::new(nodes, links, &layers);
    order::improve(&mut grid);
    place::place(&mut grid);
    grid
}

/// The abscissa of each link's target direction in the fully automatic layout.
pub(super) fn towards(nodes: &[Node], links: &[Link]) -> Vec<f64> {
    if links.is_empty() {
        return Vec::new();
    }
    let grid = arranged(nodes, links);
    let first =
        |chain: &Vec<usize>| chain.first().map_or(0.0, |net| grid.x(&grid.nets[*net].ends[1]));
    grid.chains.iter().map(first).collect()
}

/// Lays out the nodes. `links` of a node are in their order, and node 0 comes first.
pub(super) fn layout(nodes: &[Node], links: &[Link]) -> LaidOut {
    if nodes.is_empty() {
        return LaidOut::default();
    }
    let grid = arranged(nodes, links);
    let rows = Rows::new(&grid, nodes);
    if let Some(corners) = fold::fold(&grid, nodes, &rows.corners(&grid, nodes)) {
        let found =
            router::route(&bounds(nodes, &corners), &connectors(nodes, links, &corners), &[]);
        return LaidOut::new(nodes, corners, found.corners);
    }
    unfolded(nodes, links, grid, rows)
}

/// Places the layers from top to bottom with enough space for the edges. If there is not enough,
/// returns the best result: routes change when boxes give way, and may become worse.
fn unfolded(nodes: &[Node], links: &[Link], mut grid: Grid, mut rows: Rows) -> LaidOut {
    let mut effort = 0;
    let mut best: Option<(f64, LaidOut)> = None;
    for _ in 0..ROUNDS {
        let corners = rows.corners(&grid, nodes);
        let (boxes, connectors) = (bounds(nodes, &corners), connectors(nodes, links, &corners));
        let found = router::route(&boxes, &connectors, &[]);
        effort += found.effort;
        // A box with too many arriving edges cannot give way.
        let narrow = || found.crowded.iter().filter(|narrow| !narrow.arrives);
        let missing: f64 = narrow().map(|narrow| router::PITCH - narrow.distance).sum();
        for narrow in narrow() {
            rows.give_way(&mut grid, narrow);
        }
        if best.as_ref().is_none_or(|(least, _)| missing < *least) {
            best = Some((missing, LaidOut::new(nodes, corners, found.corners)));
        }
        if missing == 0.0 || effort > router::BUDGET {
            break;
        }
    }
    best.map(|(_, laid_out)| laid_out).unwrap_or_default()
}

fn bounds(nodes: &[Node], corners: &[Point]) -> Vec<Bounds> {
    let bounds = |((left, top), node): (&Point, &Node)| Bounds {
        left: *left,
        top: *top,
        right: left + node.width,
        bottom: top + node.height,
    };
    corners.iter().zip(nodes).map(bounds).collect()
}

fn connectors(nodes: &[Node], links: &[Link], corners: &[Point]) -> Vec<Connector> {
    let connector = |link: &Link| {
        let ((x, y), (to_x, to_y)) = (corners[link.from], corners[link.to]);
        let (start, heading) = match link.exit {
            Exit::Below(dx, dy) => ((x + dx, y + dy), Heading::Down),
            Exit::Right(dx, dy) => ((x + dx, y + dy), Heading::Right),
        };
        let (left, right) = nodes[link.to].entry;
        let arrival = (to_x + left, to_x + right.max(left));
        let Link { from, to, kind, .. } = *link;
        Connector { from, to, start, heading, arrival, tip: to_y, kind }
    };
    links.iter().map(connector).collect()
}

impl LaidOut {
    fn new(nodes: &[Node], corners: Vec<Point>, routes: Vec<Vec<Point>>) -> LaidOut {
        let ends = corners.iter().zip(nodes);
        let ends: Vec<_> = ends.map(|((x, y), node)| (x + node.width, y + node.height)).collect();
        let points = || corners.iter().chain(&ends).chain(routes.iter().flatten());
        let fold = |of: fn(&Point) -> f64, to: fn(f64, f64) -> f64| points().map(of).reduce(to);
        let (left, right) = (fold(|point| point.0, f64::min), fold(|point| point.0, f64::max));
        let (top, bottom) = (fold(|point| point.1, f64::min), fold(|point| point.1, f64::max));
        let (x, y) = (left.unwrap_or(0.0), top.unwrap_or(0.0));
        let (width, height) = (right.unwrap_or(x) - x, bottom.unwrap_or(y) - y);
        LaidOut { corners, routes, bounds: Rect { x, y, width, height } }
    }
}

#[cfg(test)]
mod tests {
    use std::time::{Duration, Instant};

    use super::{Exit, Link, Node, layout};

    /// The shorter of two times for a layout with edges between the first boxes.
    fn chain(count: usize, edges: usize) -> Duration {
        let nodes =
            vec![
                Node { width: 100.0, height: 60.0, entry: (20.0, 80.0), anchor: (0.0, 0.0) };
                count
            ];
        let link = |to: usize| Link { from: to - 1, to, exit: Exit::Below(50.0, 60.0), kind: "" };
        let links: Vec<_> = (1..=edges).map(link).collect();
        let run = || {
            let begin = Instant::now();
            assert_eq!(layout(&nodes, &links).routes.len(), edges);
            begin.elapsed()
        };
        (0..2).map(|_| run()).min().unwrap_or(Duration::ZERO)
    }

    /// Each layer once took as long as all items, and each line as long as all boxes.
    #[test]
    fn layers_take_linear_time() {
        // 32 times as many layers once took over 200 times as long. The machine may be busy during
        // one of the two layouts.
        let times = || (chain(150, 149), chain(4800, 4799));
        let mut tried = (0..4).map(|_| times());
        assert!(tried.any(|(short, long)| long < short * 110), "{:?}", times());
    }

    /// Each box was once tried in each place, with a new packing each time.
    #[test]
    fn many_boxes_without_edges_take_little_time() {
        let times = || (chain(100, 2), chain(800, 2));
        let mut tried = (0..4).map(|_| times());
        assert!(tried.any(|(few, many)| many < few * 150), "{:?}", times());
    }
}
