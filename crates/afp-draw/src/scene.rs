//! The scene: each part of a drawing with its identity, its place and a fragment of SVG.
//!
//! Pictures are put together from it, and editors take it piece by piece. Coordinates are those of
//! the plan: a box that has a position stands exactly there. Where boxes stand depends on the plan
//! and its positions alone ([`standing`]). The scene before saves work: fragments that are the same are not
//! painted again, and a large plan keeps the routes of edges whose ends and surroundings are the same.

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

/// The routes of more edges than this take too long to be found again at each change.
const FEW: usize = 40;

/// A drawing of plans.
#[derive(Clone, Debug, Default)]
pub struct Scene {
    /// The plans: the main one, then those it uses.
    pub plans: Vec<PlanScene>,
    /// The icons that fragments use, each by its id.
    pub symbols: Vec<Symbol>,
    /// Width and height of the picture with all plans.
    pub size: Point,
    /// What colours mean in a drawing by use, as a fragment.
    pub legend: Option<String>,
}

/// One plan of a drawing, in coordinates of its own.
#[derive(Clone, Debug)]
pub struct PlanScene {
    pub plan: Item,
    /// The file that it stands in.
    pub file: u16,
    pub name: String,
    pub doc: String,
    /// Where its origin is in the picture with all plans.
    pub offset: Point,
    /// What all of it takes.
    pub bounds: Rect,
    /// The start tag, then the elements as written.
    pub elements: Vec<ElementScene>,
    /// The edges that lead to elements; later ones lie above earlier ones.
    pub edges: Vec<EdgeScene>,
}

/// A box with everything attached to it.
#[derive(Clone, Debug, PartialEq)]
pub struct ElementScene {
    /// Under what it is placed: the element, or `start` of the plan.
    pub item: Item,
    /// The box itself; its corner is its position.
    pub rect: Rect,
    /// The box with ports, exits and supervisors.
    pub outer: Rect,
    /// What belongs to it and has an identity: itself, its supervisors, ports, exits, entries.
    pub pieces: Vec<PieceScene>,
    /// A group, moved to its place.
    pub svg: Arc<str>,
    /// What the group was painted from.
    content: Arc<Content>,
}

/// A box, tab, port, exit or entry.
#[derive(Clone, Debug, PartialEq)]
pub struct PieceScene {
    pub item: Item,
    pub part: Part,
    pub rect: Rect,
    /// The worst that is wrong with it, where it is marked.
    pub severity: Option<Severity>,
    /// The tag of an exit that leads nowhere.
    pub tag: Option<Rect>,
}

/// An edge from an exit to an element.
#[derive(Clone, Debug, PartialEq)]
pub struct EdgeScene {
    /// The element, supervisor or plan that it leaves.
    pub item: Item,
    /// Which of its exits.
    pub part: Part,
    /// The element that it leads to.
    pub to: Item,
    /// What kind of exit it leaves: `start`, `state`, `error`, `event` or `missed`.
    pub kind: &'static str,
    /// The corners of its route, start and tip included.
    pub points: Vec<Point>,
    /// The worst that is wrong with it, where it is marked.
    pub severity: Option<Severity>,
    /// A group with the line and its tip.
    pub svg: Arc<str>,
    /// What that was painted from, besides the points.
    class: Class,
    joined: f64,
}

impl Scene {
    /// The drawing of the main plan and, unless the options say otherwise, of the plans it uses.
    ///
    /// The scene `before` a change saves work; no box is elsewhere because of it.
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

    /// The area that the boxes alone take, in pixels: known before anything is laid out, and less than that of the whole
    /// picture. Nothing where positions let boxes stand on each other.
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
    /// Each card with the place of its upper left corner.
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

    /// Where the box of an element is.
    pub(super) fn rect(&self, item: &Item) -> Option<Rect> {
        let (card, at) = self.cards.iter().find(|(card, _)| card.item == *item)?;
        Some(card.rect.moved(*at))
    }

    /// Everything at its place in the picture.
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

/// The edges in the order in which they lie above one another: what was never used below, so that where an arrow that was
/// used joins one that was not their tip is that of the first; on top what would look dashed otherwise.
fn from_below(edges: Vec<DrawnEdge>) -> Vec<DrawnEdge> {
    let dashes = lines::dashes(&edges);
    let mut edges: Vec<_> = dashes.into_iter().zip(edges).collect();
    edges.sort_by_key(|(dashes, edge)| (edge.class.usage != Some(Use::Never), *dashes));
    edges.into_iter().map(|(_, edge)| edge).collect()
}

/// The cards of the start tag and the elements, with states by what they wish.
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

/// What leads to elements, each with the card that it leaves.
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

/// The routes that the edges of a large plan had.
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
