//! The scene: each part of a drawing with its identity, its place and a fragment of SVG.
//!
//! Pictures consist of it, and editors use its pieces. Coordinates are those of the plan: a box
//! with a position is exactly there. The places of boxes depend only on the plan and its positions
//! ([`standing`]). The previous scene saves work: equal fragments are not painted again, and a
//! large plan keeps the routes of edges whose ends and surroundings have not changed.

mod lines;
mod painted;
mod standing;

use std::sync::Arc;

use super::Options;
use super::arrange::arrange;
use super::card::{self, Card, Leaving};
use super::layout::{self, Link, Node};
use super::legend::legend;
use super::polyline::Point;
#[cfg(test)]
use super::sketch::Arrow;
use super::sketch::{Rect, Sketch};
use super::svg::paint::{self, Content, Painter, Symbol};
use super::usage::{Class, Use};
use super::view::View;
use afp_dsl::outline::{Component, Outline, Part};
use afp_syntax::diagnostics::Severity;
use afp_syntax::item::Item;
use painted::Painted;
use rustc_hash::FxHashMap;
pub use standing::Boxes;
use standing::Standing;

/// Space around everything, in pixels.
const MARGIN: f64 = 24.0;

/// Distance between the drawings and the legend.
const LEGEND: f64 = 32.0;

/// The routes of more edges than this take too long to compute after each change: plans of about 80
/// elements.
const FEW: usize = 200;

/// A drawing of plans.
#[derive(Clone, Debug, Default)]
pub struct Scene {
    /// The plans: the main one, then those it uses.
    pub plans: Vec<PlanScene>,
    /// The icons that fragments use, each by its id.
    pub symbols: Vec<Symbol>,
    /// Width and height of the picture with all plans.
    pub size: Point,
    /// The legend of a drawing by use, as a fragment.
    pub legend: Option<String>,
}

/// One plan of a drawing, in its own coordinates.
#[derive(Clone, Debug)]
pub struct PlanScene {
    pub plan: Item,
    pub file: u16,
    pub name: String,
    pub doc: String,
    /// The place of its origin in the picture with all plans.
    pub offset: Point,
    pub bounds: Rect,
    /// The start tag, then the elements in source order.
    pub elements: Vec<ElementScene>,
    /// The edges to elements; later edges are above earlier ones.
    pub edges: Vec<EdgeScene>,
}

/// A box with all its parts.
#[derive(Clone, Debug, PartialEq)]
pub struct ElementScene {
    /// The item of its position: the element, or `start` of the plan.
    pub item: Item,
    /// The box itself; its position is that of its corner.
    pub rect: Rect,
    /// The box with ports, exits and supervisors.
    pub outer: Rect,
    /// Its parts with an identity: itself, its supervisors, ports, exits, entries.
    pub pieces: Vec<PieceScene>,
    /// A group, moved to its place.
    pub svg: Arc<str>,
    /// The painted content of the group.
    content: Arc<Content>,
}

/// A box, tab, port, exit or entry.
#[derive(Clone, Debug, PartialEq)]
pub struct PieceScene {
    pub item: Item,
    pub part: Part,
    pub rect: Rect,
    /// The worst diagnostic of it, if it is marked.
    pub severity: Option<Severity>,
    /// The tag of an unconnected exit.
    pub tag: Option<Rect>,
}

/// An edge from an exit to an element.
#[derive(Clone, Debug, PartialEq)]
pub struct EdgeScene {
    /// The element, supervisor or plan of its start.
    pub item: Item,
    /// Which of its exits.
    pub part: Part,
    /// The target element.
    pub to: Item,
    /// The kind of its exit: `start`, `state`, `error`, `event` or `missed`.
    pub kind: &'static str,
    /// The corners of its route, start and tip included.
    pub points: Vec<Point>,
    /// The worst diagnostic of it, if it is marked.
    pub severity: Option<Severity>,
    /// A group with the line and its tip.
    pub svg: Arc<str>,
    /// The class that it was painted with.
    class: Class,
    joined: f64,
}

impl Scene {
    /// The drawing of the main plan and, by default, of the plans that it uses.
    ///
    /// The scene `before` a change saves work and does not move boxes.
    pub fn new(outline: &Outline, options: &Options, before: Option<&Scene>) -> Scene {
        let drawn = Drawn::new(outline, options, before);
        let mut painter = Painter::new(options.icons);
        let painted = |plan: DrawnPlan<'_>| {
            let known =
                before.and_then(|before| before.plan(&plan.view.plan.item, plan.view.plan.file()));
            plan.scene(&mut painter, known)
        };
        let plans = drawn.plans.into_iter().map(painted).collect();
        let legend =
            drawn.legend.map(|(sketch, at)| paint::group("legend", &painter.content(sketch), at));
        Scene { plans, symbols: painter.symbols(), size: drawn.size, legend }
    }

    /// The area of only the boxes, in pixels: known before the layout, and less than the area of
    /// the whole picture. `None` if positions let boxes overlap.
    pub fn least_area(outline: &Outline, options: &Options) -> f64 {
        if options.positions.iter().any(|layout| layout.iter().next().is_some()) {
            return 0.0;
        }
        let views = View::all(outline, options).into_iter();
        let areas =
            views.flat_map(|view| cards(&view, &|_, _| None)).map(|card| card.width * card.height);
        areas.sum()
    }

    fn plan(&self, plan: &Item, file: u16) -> Option<&PlanScene> {
        self.plans.iter().find(|known| known.plan == *plan && known.file == file)
    }
}

/// A drawing before it is painted.
pub(super) struct Drawn<'a> {
    pub(super) plans: Vec<DrawnPlan<'a>>,
    pub(super) legend: Option<(Sketch<'a>, Point)>,
    pub(super) size: Point,
}

/// A plan before it is painted.
pub(super) struct DrawnPlan<'a> {
    pub(super) view: View<'a>,
    pub(super) offset: Point,
    pub(super) bounds: Rect,
    /// Each card with its upper left corner.
    pub(super) cards: Vec<(Card<'a>, Point)>,
    pub(super) edges: Vec<DrawnEdge>,
}

/// An edge before it is painted.
pub(super) struct DrawnEdge {
    pub(super) item: Item,
    pub(super) part: Part,
    pub(super) to: Option<Item>,
    pub(super) class: Class,
    pub(super) severity: Option<Severity>,
    pub(super) points: Vec<Point>,
}

impl<'a> Drawn<'a> {
    pub(super) fn new(
        outline: &'a Outline,
        options: &'a Options<'a>,
        before: Option<&Scene>,
    ) -> Drawn<'a> {
        let known = |view: &View| before?.plan(&view.plan.item, view.plan.file());
        let views = View::all(outline, options).into_iter();
        let mut plans: Vec<_> = views.map(|view| DrawnPlan::new(view, known(&view))).collect();
        let sizes: Vec<Point> =
            plans.iter().map(|plan| (plan.bounds.width, plan.bounds.height)).collect();
        let arranged = arrange(&sizes);
        for (plan, (x, y)) in plans.iter_mut().zip(arranged.corners) {
            plan.offset = (MARGIN + x - plan.bounds.x, MARGIN + y - plan.bounds.y);
        }
        let mut size = (arranged.size.0, MARGIN + arranged.size.1);
        let legend = options.usage.map(|_| {
            let (legend, width, height) = legend();
            let top = size.1 + LEGEND;
            size = (size.0.max(width), top + height);
            (legend, (MARGIN, top))
        });
        Drawn { plans, legend, size: (size.0 + 2.0 * MARGIN, size.1 + MARGIN) }
    }
}

impl<'a> DrawnPlan<'a> {
    fn new(view: View<'a>, before: Option<&PlanScene>) -> DrawnPlan<'a> {
        let Standing { corners, automatic, .. } = Standing::new(&view.unfolded(), &[]);
        let cards = standing::leading(&view, &corners);
        let corner = |(card, (x, y)): (&Card, Point)| (x - card.rect.x, y - card.rect.y);
        let corners: Vec<_> = cards.iter().zip(corners).map(corner).collect();
        let (nodes, exits) = (nodes(&cards), exits(&cards));
        let links = links(&exits);
        let automatic = automatic.filter(|known| known.links == links && view.folded.is_empty());
        let placed = match automatic {
            Some(automatic) => automatic.laid_out,
            None => layout::routed(&nodes, &links, corners, routes(&exits, before)),
        };
        let edges = exits.iter().zip(placed.routes).map(|((_, exit), points)| DrawnEdge {
            item: exit.item.clone(),
            part: exit.part.clone(),
            to: view.plan.elements.get(exit.to).map(|element| element.item.clone()),
            class: exit.class,
            severity: exit.severity,
            points,
        });
        let edges = from_below(edges.collect());
        let cards = cards.into_iter().zip(placed.corners).collect();
        DrawnPlan { view, offset: (0.0, 0.0), bounds: placed.bounds, cards, edges }
    }

    /// The box of an element.
    pub(super) fn rect(&self, item: &Item) -> Option<Rect> {
        let (card, at) = self.cards.iter().find(|(card, _)| card.item == *item)?;
        Some(card.rect.moved(*at))
    }

    /// All parts at their places in the picture.
    #[cfg(test)]
    pub(super) fn sketch(self) -> Sketch<'a> {
        let mut all = Sketch::default();
        let mut arrows = Sketch::default();
        let edges = self.edges.into_iter().map(|edge| Arrow::flow(edge.points, edge.class));
        arrows.arrows.extend(edges);
        all.add(arrows, self.offset);
        for (card, at) in self.cards {
            all.add(card.sketch, (at.0 + self.offset.0, at.1 + self.offset.1));
        }
        all
    }

    fn scene(self, painter: &mut Painter, before: Option<&PlanScene>) -> PlanScene {
        let painted = Painted::of(before);
        let joined = lines::joined(&self.edges);
        let edges = self.edges.into_iter().zip(joined);
        let edges: Vec<_> = edges.filter_map(|(edge, joined)| painted.edge(edge, joined)).collect();
        let cards = self.cards.into_iter();
        let elements: Vec<_> = cards.map(|(card, at)| painted.element(card, at, painter)).collect();
        PlanScene {
            plan: self.view.plan.item.clone(),
            file: self.view.plan.file(),
            name: self.view.name().to_owned(),
            doc: self.view.plan.doc.clone(),
            offset: self.offset,
            bounds: self.bounds,
            elements,
            edges,
        }
    }
}

/// The edges in drawing order: unused edges are below. If a used arrow joins an unused one, their
/// tip is then that of the used one. Edges that would look dashed are on top.
fn from_below(edges: Vec<DrawnEdge>) -> Vec<DrawnEdge> {
    let dashes = lines::dashes(&edges);
    let mut edges: Vec<_> = dashes.into_iter().zip(edges).collect();
    edges.sort_by_key(|(dashes, edge)| (edge.class.usage != Some(Use::Never), *dashes));
    edges.into_iter().map(|(_, edge)| edge).collect()
}

/// The cards of the start tag and the elements, with their states ordered by wish.
fn cards<'a>(view: &View<'a>, towards: &dyn Fn(&Item, &Part) -> Option<f64>) -> Vec<Card<'a>> {
    let card = |element: &'a Component| {
        let item = &element.item;
        card::element(view, element, &|part| towards(item, part))
    };
    std::iter::once(card::start(view)).chain(view.plan.elements.iter().map(card)).collect()
}

fn nodes(cards: &[Card]) -> Vec<Node> {
    let node = |card: &Card| Node {
        width: card.width,
        height: card.height,
        entry: card.entry,
        anchor: (card.rect.x, card.rect.y),
    };
    cards.iter().map(node).collect()
}

fn exits<'c>(cards: &'c [Card]) -> Vec<(usize, &'c Leaving)> {
    let of = |(from, card): (usize, &'c Card)| card.exits.iter().map(move |exit| (from, exit));
    cards.iter().enumerate().flat_map(of).collect()
}

/// The start tag is node 0, so elements count from 1.
fn links(exits: &[(usize, &Leaving)]) -> Vec<Link> {
    let link = |(from, exit): &(usize, &Leaving)| Link {
        from: *from,
        to: exit.to + 1,
        exit: exit.at,
        kind: exit.class.name,
    };
    exits.iter().map(link).collect()
}

/// The previous routes of a large plan's edges.
fn routes<'c>(
    exits: &[(usize, &'c Leaving)],
    before: Option<&'c PlanScene>,
) -> Vec<Option<Vec<Point>>> {
    let before = before.filter(|_| exits.len() > FEW);
    let edges = before.iter().flat_map(|before| &before.edges);
    let edges: FxHashMap<_, _> =
        edges.map(|known| ((&known.item, &known.part), &known.points)).collect();
    let known = |(_, exit): &(usize, &'c Leaving)| {
        edges.get(&(&exit.item, &exit.part)).map(|points| points.to_vec())
    };
    exits.iter().map(known).collect()
}

#[cfg(test)]
mod tests;
