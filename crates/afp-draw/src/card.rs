//! Cards: a box with everything attached to it, measured and drawn at the origin.
//!
//! An element's card is its box with name, template and icon, the data on its left, its states as
//! exits on its lower border, and its supervisors leaning on its right side with their events as
//! exits. The start tag carries the global supervisors in the same way. Edges to `terminate` and
//! `ignore` end in tags of their own on the card, so that only flow between elements is routed.

mod parts;
mod start;
mod supervisors;

use super::layout;
use super::metrics::width;
use super::sketch::{Anchor, Frame, Glyph, Label, Picture, Rect, Shape, Sketch};
use super::usage::{Class, Use, times};
use super::view::{Exit, Input, View};
use afp_dsl::graph::{Component, Element};
use parts::{ROW, Tag, chip_width, exit_below, inflow, outflow, pill_width, tag_width};

pub(super) use start::start;

/// A card, and where flow leaves and reaches it.
pub(super) struct Card<'a> {
    pub(super) sketch: Sketch<'a>,
    pub(super) width: f64,
    pub(super) height: f64,
    /// Where edges may arrive on the upper border.
    pub(super) entry: (f64, f64),
    pub(super) exits: Vec<Leaving>,
}

/// An exit that leads to an element.
pub(super) struct Leaving {
    pub(super) at: layout::Exit,
    /// The element's index.
    pub(super) to: usize,
    pub(super) class: Class,
}

/// Sizes of texts in pixels.
const NAME: f64 = 13.0;
const TEMPLATE: f64 = 11.0;

/// Height of a box's head, with name and template.
const HEAD: f64 = 48.0;

/// Length of the thin arrows between data and ports.
const REACH: f64 = 24.0;

/// Distance between neighbouring exits below a box.
const EXIT_GAP: f64 = 10.0;

/// The card of an element.
pub(super) fn element<'a>(view: &View<'a>, element: &'a Element) -> Card<'a> {
    let mut card = Card::empty();
    let (inputs, outputs) = (bound(view.inputs(element)), view.outputs(element));
    let data = inputs.iter().map(|input| pill_width(&input.text));
    let data = data.chain(outputs.iter().map(|(_, entry)| pill_width(entry)));
    let data = data.fold(0.0, f64::max);
    let left = if data > 0.0 { data + REACH } else { 0.0 };
    let template = &template(view, element);
    let head = 44.0 + width(&element.name, NAME, true).max(width(template, TEMPLATE, false)) + 16.0;
    let states = view.states(element);
    let exits = states.iter().map(|exit| exit_width(exit) + EXIT_GAP).sum::<f64>() + 16.0;
    let rows = (inputs.len() + outputs.len()) as f64;
    let own = HEAD + rows * ROW + 16.0;
    let stack = supervisors::Stack::new(view, &view.supervisors(Some(element)));
    let rect = Rect { x: left, y: 0.0, width: head.max(exits), height: own.max(stack.height) };
    let (shape, class) = look(view, element);
    card.sketch.frames.push(Frame { rect, shape, class, title: title(element, template) });
    heading(view, &mut card, element, template, rect);
    let mut y = HEAD + ROW / 2.0;
    for input in &inputs {
        inflow(&mut card.sketch, (left, y), input, REACH, Anchor::Start);
        y += ROW;
    }
    for (port, entry) in outputs {
        outflow(&mut card.sketch, (left, y), port, entry, REACH, Anchor::Start);
        y += ROW;
    }
    let mut x = left + (rect.width - (exits - 16.0 - EXIT_GAP)) / 2.0;
    card.height = rect.bottom();
    for exit in &states {
        let width = exit_width(exit);
        exit_below(&mut card, (x + width / 2.0, rect.bottom()), exit);
        x += width + EXIT_GAP;
    }
    card.entry = (rect.x + 20.0, rect.right() - 20.0);
    card.width = rect.right();
    stack.attach(view, &mut card, rect);
    card
}

impl Card<'_> {
    fn empty() -> Self {
        Card {
            sketch: Sketch::default(),
            width: 0.0,
            height: 0.0,
            entry: (0.0, 0.0),
            exits: Vec::new(),
        }
    }
}

/// What the plan itself connects; defaults would only hide it.
fn bound(inputs: Vec<Input>) -> Vec<Input> {
    inputs.into_iter().filter(|input| input.bound).collect()
}

/// The room that an exit needs below a box: its own or that of the tag it leads to.
fn exit_width(exit: &Exit) -> f64 {
    chip_width(&exit.text()).max(Tag::of(exit.target).map_or(0.0, tag_width))
}

fn look(view: &View, element: &Element) -> (Shape, Class) {
    let (shape, name) = match element.component {
        Component::Actor(_) => (Shape::Round(9.0), "actor"),
        Component::Computation(_) => (Shape::Cut(12.0), "computation"),
        Component::SubPlan(_) => (Shape::Double(9.0), "subplan"),
    };
    let usage = view.element_count(element).map(|count| {
        let states = view.states(element);
        Use::with_exits(count.starts, states.iter().filter_map(|exit| exit.count))
    });
    (shape, Class { name, usage })
}

/// The name of an element's template; where use is shown, with how often it started.
fn template(view: &View, element: &Element) -> String {
    let name = view.template_name(element);
    match view.element_count(element) {
        None => name.to_owned(),
        Some(count) => format!("{name} · {}", times(count.starts)),
    }
}

fn title(element: &Element, template: &str) -> String {
    let head = format!("{}: {template}", element.name);
    if element.doc.is_empty() { head } else { format!("{head}\n{}", element.doc) }
}

fn heading<'a>(
    view: &View<'a>,
    card: &mut Card<'a>,
    element: &Element,
    template: &str,
    rect: Rect,
) {
    let (icon, fallback) = match element.component {
        Component::Actor(id) => (view.icon(id), Glyph::Actor),
        Component::Computation(id) => (view.icon(id), Glyph::Computation),
        Component::SubPlan(_) => (None, Glyph::SubPlan),
    };
    let (_, class) = look(view, element);
    card.sketch.pictures.push(Picture {
        x: rect.x + 12.0,
        y: 12.0,
        size: 24.0,
        class,
        icon,
        fallback,
    });
    let label = |text: &str, y, size, bold, class| Label {
        x: rect.x + 46.0,
        y,
        text: text.to_owned(),
        size,
        bold,
        anchor: Anchor::Start,
        class: Class::from(class),
    };
    card.sketch.labels.push(label(&element.name, 22.0, NAME, true, "name"));
    card.sketch.labels.push(label(template, 37.0, TEMPLATE, false, "template"));
}
