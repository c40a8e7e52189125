//! Where boxes and thick arrows go: a layered layout with right-angled edges.
//!
//! The classic scheme of Sugiyama in five stages, each in a file of its own: elements get layers
//! ([`layers`]), edges get a way through every layer they pass ([`grid`]), each layer gets an order
//! with few crossings ([`order`]), items get abscissas ([`place`]), and the horizontal parts of
//! edges get lines of their own between layers ([`channel`]). Edges leave boxes below (states) or on
//! the right (events) and arrive from above; what leads back up climbs beside the boxes.
//! Everything is deterministic. Where some boxes stand already ([`placed`]), the others go around
//! them and edges find ways of their own ([`maze`]).

mod channel;
mod grid;
mod layers;
mod maze;
mod order;
mod place;
mod placed;
mod route;

use grid::Grid;
pub(super) use placed::layout_around;

/// A box with everything attached to it; edges keep away from it.
#[derive(Clone, Debug)]
pub(super) struct Node {
    /// Width in pixels, without room for the ways of edges that leave on the right.
    pub(super) width: f64,
    /// Height in pixels.
    pub(super) height: f64,
    /// Where edges may arrive on the upper border, from the left edge.
    pub(super) entry: (f64, f64),
}

/// An edge from a place on one box to the upper border of another (or of the same).
#[derive(Clone, Copy, Debug)]
pub(super) struct Link {
    /// Where it starts, an index into the nodes.
    pub(super) from: usize,
    /// Where it leads.
    pub(super) to: usize,
    /// The place on `from`.
    pub(super) exit: Exit,
}

/// Where an edge leaves its box, from the box's upper left corner.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Exit {
    /// Downwards.
    Below(f64, f64),
    /// To the right.
    Right(f64, f64),
}

/// The result: places in pixels, the drawing's upper left corner at the origin.
#[derive(Clone, Debug, Default)]
pub(super) struct Layout {
    /// The upper left corner of each node.
    pub(super) corners: Vec<(f64, f64)>,
    /// The corners of each link's polyline, start and tip included.
    pub(super) routes: Vec<Vec<(f64, f64)>>,
    /// Width of everything.
    pub(super) width: f64,
    /// Height of everything.
    pub(super) height: f64,
}

/// Lays out the nodes; `links` out of a node count in their order, and node 0 comes first.
pub(super) fn layout(nodes: &[Node], links: &[Link]) -> Layout {
    if nodes.is_empty() {
        return Layout::default();
    }
    let layers = layers::assign(nodes.len(), links);
    let mut grid = Grid::new(nodes, links, &layers);
    order::improve(&mut grid);
    place::place(&mut grid);
    route::route(&mut grid, nodes, links)
}
