//! Where boxes go: a layered layout, around boxes that have places already.
//!
//! The classic scheme of Sugiyama in stages, each in a file of its own: elements get layers
//! ([`layers`]), edges get dummy nodes in every layer they pass ([`grid`]), which keep room free
//! for them, each layer gets an order with few crossings ([`order`]), items get abscissas
//! ([`place`]) and layers ordinates ([`rows`]). Edges leave boxes below (states) or on the right
//! (events) and arrive from above; what leads back up climbs beside the boxes. The routes of edges
//! are found by the [`router`](super::router), and where they find too little room, boxes give
//! way. Everything is deterministic. Where some boxes stand already ([`placed`]), the others go
//! around them.

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

/// A box with everything attached to it; edges keep away from it.
#[derive(Clone, Debug)]
pub(super) struct Node {
    /// Width in pixels, without room for the ways of edges that leave on the right.
    pub(super) width: f64,
    /// Height in pixels.
    pub(super) height: f64,
    /// Where edges may arrive on the upper border, from the left edge.
    pub(super) entry: (f64, f64),
    /// The corner that has its position, from the upper left corner.
    pub(super) anchor: Point,
}

impl Node {
    /// The corner nearest to one at which the position of the node is whole.
    fn whole(&self, (x, y): Point) -> Point {
        let (dx, dy) = self.anchor;
        ((x + dx).round() - dx, (y + dy).round() - dy)
    }
}

/// An edge from a place on one box to the upper border of another (or of the same).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Link {
    /// Where it starts, an index into the nodes.
    pub(super) from: usize,
    /// Where it leads.
    pub(super) to: usize,
    /// The place on `from`.
    pub(super) exit: Exit,
    /// Edges of one kind may become one in front of their target.
    pub(super) kind: &'static str,
}

/// Where an edge leaves its box, from the box's upper left corner.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Exit {
    /// Downwards.
    Below(f64, f64),
    Right(f64, f64),
}

/// The result: places in pixels. Where nothing has a place of its own, the uppermost box touches
/// the upper and the leftmost one the left axis.
#[derive(Clone, Debug, Default)]
pub(super) struct LaidOut {
    /// The upper left corner of each node.
    pub(super) corners: Vec<Point>,
    /// The corners of each link's polyline, start and tip included.
    pub(super) routes: Vec<Vec<Point>>,
    /// What everything takes.
    pub(super) bounds: Rect,
}

/// How often boxes give way to edges.
const ROUNDS: usize = 4;

/// The nodes in layers, each where it is best from left to right.
fn arranged(nodes: &[Node], links: &[Link]) -> Grid {
    let layers = layers::assign(nodes.len(), links);
    let mut grid = Grid::new(nodes, links, &layers);
    order::improve(&mut grid);
    place::place(&mut grid);
    grid
}

/// The abscissa that each link goes towards from its node, where all places are left to the layout.
pub(super) fn towards(nodes: &[Node], links: &[Link]) -> Vec<f64> {
    if links.is_empty() {
        return Vec::new();
    }
    let grid = arranged(nodes, links);
    let first =
        |chain: &Vec<usize>| chain.first().map_or(0.0, |net| grid.x(&grid.nets[*net].ends[1]));
    grid.chains.iter().map(first).collect()
}

/// Lays out the nodes; `links` out of a node count in their order, and node 0 comes first.
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

/// The layers one below the other, with as much room as the edges need; where they do not get it, the best of what was tried:
/// routes change when boxes give way, and may be worse then.
fn unfolded(nodes: &[Node], links: &[Link], mut grid: Grid, mut rows: Rows) -> LaidOut {
    let mut effort = 0;
    let mut best: Option<(f64, LaidOut)> = None;
    for _ in 0..ROUNDS {
        let corners = rows.corners(&grid, nodes);
        let (boxes, connectors) = (bounds(nodes, &corners), connectors(nodes, links, &corners));
        let found = router::route(&boxes, &connectors, &[]);
        effort += found.effort;
        // A box at which too many edges arrive cannot give way.
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

    /// The least time of two for boxes, each of the first ones with an edge to the next.
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

    /// Each layer took as long as all items, and each line as all boxes.
    #[test]
    fn many_layers_take_about_as_long_as_they_are_many() {
        // 32 times as many took over 200 times as long. The machine may be busy while one of the two is drawn.
        let times = || (chain(150, 149), chain(4800, 4799));
        let mut tried = (0..4).map(|_| times());
        assert!(tried.any(|(short, long)| long < short * 110), "{:?}", times());
    }

    /// Each of them was tried in each place, and all were packed anew each time.
    #[test]
    fn boxes_without_edges_are_many_in_little_time() {
        let times = || (chain(100, 2), chain(800, 2));
        let mut tried = (0..4).map(|_| times());
        assert!(tried.any(|(few, many)| many < few * 150), "{:?}", times());
    }
}
