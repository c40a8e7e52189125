//! Plans as SVG in the paper's notation.
//!
//! Thick arrows are flow of action, thin ones flow of data. The picture needs nothing from outside
//! and sets no ids, so it can stand in a page as often as one likes.

mod icon;
mod paint;
mod style;

use super::Options;
use super::card::{self, Card};
use super::layout::{Link, Node, layout_around};
use super::legend::legend;
use super::sketch::{Arrow, Sketch};
use super::view::View;
use crate::layout_file::Position;
use afp_dsl::graph::Graph;

/// Space around everything, in pixels.
const MARGIN: f64 = 24.0;

/// Distance between the drawings of two plans.
const BETWEEN: f64 = 64.0;

/// Distance between the drawings and the legend.
const LEGEND: f64 = 32.0;

/// The main plan as an SVG picture, its sub-plans below it unless the options say otherwise.
///
/// Texts come from the graph and are escaped. The picture's size is in pixels and given by the
/// plan. The same graph and options give the same text.
pub fn svg(graph: &Graph, options: &Options) -> String {
    let (sketch, size) = sketch(graph, options);
    paint::picture(&sketch, size, graph.main(), options)
}

/// Everything to be drawn, and the size of the picture.
pub(super) fn sketch<'a>(graph: &'a Graph, options: &'a Options<'a>) -> (Sketch<'a>, (f64, f64)) {
    let mut all = Sketch::default();
    let mut size = (0.0_f64, 0.0);
    for view in View::all(graph, options) {
        let top = if size.1 > 0.0 { size.1 + BETWEEN } else { MARGIN };
        let (sketch, width, height) = plan(&view);
        all.add(sketch, (MARGIN, top));
        size = (size.0.max(width), top + height);
    }
    if options.usage.is_some() {
        let (legend, width, height) = legend();
        let top = size.1 + LEGEND;
        all.add(legend, (MARGIN, top));
        size = (size.0.max(width), top + height);
    }
    (all, (size.0 + 2.0 * MARGIN, size.1 + MARGIN))
}

fn pixels(position: Position) -> (f64, f64) {
    (position.x.into(), position.y.into())
}

fn plan<'a>(view: &View<'a>) -> (Sketch<'a>, f64, f64) {
    let elements = view.plan.elements.iter().map(|element| card::element(view, element));
    let cards: Vec<Card> = std::iter::once(card::start(view)).chain(elements).collect();
    let nodes: Vec<_> = cards
        .iter()
        .map(|card| Node { width: card.width, height: card.height, entry: card.entry })
        .collect();
    let exits = cards.iter().enumerate();
    let exits: Vec<_> =
        exits.flat_map(|(from, card)| card.exits.iter().map(move |exit| (from, exit))).collect();
    // The start tag is node 0, so elements count from 1.
    let link = |(from, exit): &(usize, &card::Leaving)| Link {
        from: *from,
        to: exit.to + 1,
        exit: exit.at,
    };
    let links: Vec<_> = exits.iter().map(link).collect();
    let elements = view.plan.elements.iter().map(|element| view.position(&element.name));
    let fixed: Vec<_> = std::iter::once(view.position("start")).chain(elements).collect();
    let fixed: Vec<_> = fixed.iter().map(|place| place.map(pixels)).collect();
    let placed = layout_around(&nodes, &links, &fixed);
    let mut sketch = Sketch::default();
    for ((_, exit), points) in exits.iter().zip(placed.routes) {
        sketch.arrows.push(Arrow { points, class: exit.class, thick: true });
    }
    for (card, corner) in cards.into_iter().zip(placed.corners) {
        sketch.add(card.sketch, corner);
    }
    (sketch, placed.width, placed.height)
}
