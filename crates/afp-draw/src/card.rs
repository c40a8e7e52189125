//! Cards: a box with all its parts, measured and drawn at the origin.
//!
//! An element's card is its box with name, template and icon. The data is on its left, its states
//! are exits on its lower border, and its supervisors are on its right side with their events as
//! exits. The start tag has the global supervisors in the same way. Edges to `terminate`, `fail`
//! and `ignore` end in tags on the card, and edges to `resume` are hollow arrows back to it. Only
//! flow between elements is routed.

mod conditions;
mod folded;
mod parts;
mod start;
mod supervisors;

use super::metrics::width;
use super::sketch::{Anchor, Frame, Glyph, Label, Picture, Piece, Rect, Shape, Sketch};
use super::usage::{Class, Use, times};
use super::view::{Input, View, name};
use super::{formula, layout};
use afp_dsl::outline::{Component, ComponentKind, Part};
use afp_syntax::diagnostics::Severity;
use afp_syntax::item::Item;
use conditions::Conditions;
use parts::{ROW, exit_below, exit_width, inflow, outflow, part, pill_width};

pub(super) use start::start;

/// A card, with the places where flow leaves and reaches it.
pub(super) struct Card<'a> {
    /// The item that its position belongs to.
    pub(super) item: Item,
    /// The box itself; its position is that of its corner.
    pub(super) rect: Rect,
    pub(super) sketch: Sketch<'a>,
    pub(super) width: f64,
    pub(super) height: f64,
    /// The range on the upper border where edges may arrive.
    pub(super) entry: (f64, f64),
    pub(super) exits: Vec<Leaving>,
}

/// An exit that leads to an element.
pub(super) struct Leaving {
    /// The element, supervisor or plan of the exit, and the exit itself.
    pub(super) item: Item,
    pub(super) part: Part,
    pub(super) severity: Option<Severity>,
    pub(super) at: layout::Exit,
    pub(super) to: usize,
    pub(super) class: Class,
}

/// Font sizes in pixels.
const NAME: f64 = 13.0;
const TEMPLATE: f64 = 11.0;

/// Height of a box's head, with name and template.
const HEAD: f64 = 48.0;

/// Length of the thin arrows between data and ports.
const REACH: f64 = 24.0;

/// Distance between neighbouring exits below a box.
const EXIT_GAP: f64 = 10.0;

/// The card of an element. `towards` gives for its states the side of their targets, which orders
/// them; without it they have the template's order.
pub(super) fn element<'a>(
    view: &View<'a>,
    element: &'a Component,
    towards: &dyn Fn(&Part) -> Option<f64>,
) -> Card<'a> {
    let mut card = Card::empty(element.item.clone());
    let (inputs, outputs) = (shown(view.inputs(element)), view.outputs(element));
    let data = inputs.iter().map(|input| pill_width(input.shown()));
    let data = data.chain(outputs.iter().map(|output| pill_width(output.text())));
    let data = data.fold(0.0, f64::max);
    let left = if data > 0.0 { data + REACH } else { 0.0 };
    let template = &template(view, element);
    let head = 44.0 + width(name(element), NAME, true).max(width(template, TEMPLATE, false)) + 16.0;
    let states = view.exits(element);
    let exits = states.iter().map(|exit| exit_width(exit) + EXIT_GAP).sum::<f64>() + 16.0;
    let rows = (inputs.len() + outputs.len()) as f64;
    let conditions = Conditions::new(view, element);
    let own = HEAD + rows * ROW + conditions.height() + 16.0;
    let hung = Hung::new(view, &element.item, element.inner());
    let rect = Rect {
        x: left,
        y: 0.0,
        width: head.max(exits).max(conditions.width()),
        height: own.max(hung.first()),
    };
    let (shape, class) = look(view, element);
    card.sketch.frames.push(Frame { rect, shape, class, title: title(element, template) });
    heading(view, &mut card, element, template, rect);
    let mut y = HEAD + ROW / 2.0;
    for input in &inputs {
        inflow(&mut card.sketch, element, (left, y), input, Anchor::Start);
        y += ROW;
    }
    for output in &outputs {
        outflow(&mut card.sketch, element, (left, y), output, Anchor::Start);
        y += ROW;
    }
    conditions.write(&mut card.sketch, (left, y - ROW / 2.0));
    let mut x = left + (rect.width - (exits - 16.0 - EXIT_GAP)) / 2.0;
    card.height = rect.bottom();
    let mut middles = vec![0.0; states.len()];
    let wishes: Vec<_> = states.iter().map(|exit| towards(&part(exit))).collect();
    for index in from_left_to_right(&wishes) {
        let width = exit_width(&states[index]);
        middles[index] = x + width / 2.0;
        x += width + EXIT_GAP;
    }
    for (exit, middle) in states.iter().zip(middles) {
        exit_below(&mut card, element, (middle, rect.bottom()), exit);
    }
    card.entry = (rect.x + 20.0, rect.right() - 20.0);
    card.width = rect.right();
    card.rect = rect;
    let severity = view.severity(element.findings.worst());
    let item = element.item.clone();
    card.sketch.piece(Piece { item, part: Part::Whole, rect, severity, tag: None }, 2.0);
    hung.attach(view, &mut card, rect);
    card
}

/// The parts on the right side of a box: its supervisors, or one tab for all of them in a folded
/// box.
enum Hung<'a> {
    Rows(supervisors::Stack<'a>),
    Tab(folded::Tab<'a>),
}

impl<'a> Hung<'a> {
    fn new(
        view: &View<'a>,
        item: &Item,
        supervisors: impl Iterator<Item = &'a Component>,
    ) -> Hung<'a> {
        match view.is_folded(item) {
            true => Hung::Tab(folded::Tab::new(view, supervisors)),
            false => Hung::Rows(supervisors::Stack::new(view, supervisors)),
        }
    }

    /// Minimum height of the box for its first part; 0 without parts.
    fn first(&self) -> f64 {
        match self {
            Hung::Rows(stack) => stack.first,
            Hung::Tab(tab) => tab.first(),
        }
    }

    fn attach(self, view: &View<'a>, card: &mut Card<'a>, rect: Rect) {
        match self {
            Hung::Rows(stack) => stack.attach(view, card, rect),
            Hung::Tab(tab) => tab.attach(view, card, rect),
        }
    }
}

/// The order of exits: those with a wish are sorted by it, in the places that they have together.
fn from_left_to_right(wishes: &[Option<f64>]) -> Vec<usize> {
    let places: Vec<usize> = (0..wishes.len()).filter(|place| wishes[*place].is_some()).collect();
    let wish = |place: &usize| wishes[*place].unwrap_or_default();
    let mut sorted = places.clone();
    sorted.sort_by(|a, b| wish(a).total_cmp(&wish(b)));
    let mut order: Vec<usize> = (0..wishes.len()).collect();
    for (place, which) in places.into_iter().zip(sorted) {
        order[place] = which;
    }
    order
}

impl Card<'_> {
    fn empty(item: Item) -> Self {
        Card {
            item,
            rect: Rect::default(),
            sketch: Sketch::default(),
            width: 0.0,
            height: 0.0,
            entry: (0.0, 0.0),
            exits: Vec::new(),
        }
    }
}

/// The inputs that the plan connects or should connect, without defaults.
fn shown(inputs: Vec<Input>) -> Vec<Input> {
    inputs.into_iter().filter(|input| input.bound || input.missing).collect()
}

fn look(view: &View, element: &Component) -> (Shape, Class) {
    let (shape, name) = match element.kind {
        ComponentKind::Computation => (Shape::Cut(12.0), "computation"),
        ComponentKind::SubPlan if view.is_handler(element) => {
            (Shape::Double(9.0), "subplan handler")
        }
        ComponentKind::SubPlan => (Shape::Double(9.0), "subplan"),
        ComponentKind::Actor if view.is_handler(element) => (Shape::Round(9.0), "actor handler"),
        ComponentKind::Actor | ComponentKind::Supervisor | ComponentKind::Reactions => {
            (Shape::Round(9.0), "actor")
        }
    };
    let usage = view.count(element).map(|count| {
        let states = view.exits(element);
        Use::with_exits(count.starts, states.iter().filter_map(|exit| exit.count))
    });
    (shape, Class { name, usage })
}

/// The name of an element's template; in a drawing by use, with its number of starts.
fn template(view: &View, element: &Component) -> String {
    let name = view.template_name(element);
    match view.count(element) {
        None => name.to_owned(),
        Some(count) => format!("{name} · {}", times(count.starts)),
    }
}

fn title(element: &Component, template: &str) -> String {
    let mut title = format!("{}: {template}", name(element));
    let states = element.template().into_iter().flat_map(formula::states).map(|(_, text)| text);
    let doc = Some(element.doc.clone()).filter(|doc| !doc.is_empty());
    for line in states.chain(doc) {
        title.push('\n');
        title += &line;
    }
    title
}

fn heading<'a>(
    view: &View<'a>,
    card: &mut Card<'a>,
    element: &'a Component,
    template: &str,
    rect: Rect,
) {
    let icon = view.icon(element);
    let (_, class) = look(view, element);
    card.sketch.pictures.push(Picture {
        x: rect.x + 12.0,
        y: 12.0,
        size: 24.0,
        class,
        icon,
        fallback: Glyph::of(element.kind),
    });
    let x = rect.x + 46.0;
    let named = Label::new((x, 22.0), name(element), NAME, "name");
    card.sketch.labels.push(Label { bold: true, ..named });
    card.sketch.labels.push(Label::new((x, 37.0), template, TEMPLATE, "template"));
}
