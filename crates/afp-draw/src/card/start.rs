//! The start tag: the plan's name, its configuration, its global supervisors.

use super::super::layout;
use super::super::metrics::{shorten, width};
use super::super::sketch::{Arrow, Frame, Glyph, Label, Picture, Piece, Rect, Shape, Sketch};
use super::super::usage::{Class, Use, times};
use super::super::view::{View, entry_name, entry_type, to};
use super::parts::{PORT_SIZE, ROW, pill_width};
use super::{Card, Hung, Leaving};
use afp_dsl::graph::EntryKind;
use afp_dsl::graph::Target;
use afp_dsl::outline::{Entry, Part};

/// Font size of the plan's name in pixels.
const NAME: f64 = 15.0;

/// Length of the arrow from the tag without a target.
const STUB: f64 = 20.0;

/// Distance between the configuration and the tag.
const GAP: f64 = 28.0;

/// The text below the name of an endless plan.
const FOREVER: &str = "forever";

/// Width of the words `in live`, `out`, `var`, `const` with the space after them.
const KIND: f64 = 40.0;

/// The card of a plan's start tag. Its flow leads to the first element.
pub(in super::super) fn start<'a>(view: &View<'a>) -> Card<'a> {
    let plan = view.plan;
    let mut card = Card::empty(view.start_item());
    let table = configuration(view, &mut card.sketch);
    let left = if table.width > 0.0 { table.width + GAP } else { 0.0 };
    let hung = Hung::new(view, &card.item, plan.supervisors.iter());
    let below = if plan.forever { FOREVER } else { "" };
    let name = width(view.name(), NAME, true).max(width(below, PORT_SIZE, false));
    let rect = Rect { x: left, y: 0.0, width: name + 66.0, height: hung.first().max(46.0) };
    let shape = if hung.first() > 0.0 { Shape::Round(9.0) } else { Shape::Round(23.0) };
    let title = if plan.doc.is_empty() { view.name().to_owned() } else { plan.doc.clone() };
    card.sketch.frames.push(Frame { rect, shape, class: "start".into(), title });
    let middle = rect.height / 2.0;
    card.sketch.pictures.push(Picture {
        x: rect.x + 16.0,
        y: middle - 10.0,
        size: 20.0,
        class: "start".into(),
        icon: None,
        fallback: Glyph::Start,
    });
    let base = middle + 0.36 * NAME - if plan.forever { 0.5 * PORT_SIZE } else { 0.0 };
    let named = Label::new((rect.x + 46.0, base), view.name(), NAME, "start");
    card.sketch.labels.push(Label { bold: true, ..named });
    if plan.forever {
        let place = (rect.x + 46.0, base + 1.4 * PORT_SIZE);
        card.sketch.labels.push(Label::new(place, below, PORT_SIZE, "start"));
    }
    card.width = rect.right();
    card.height = rect.bottom().max(table.height);
    card.rect = rect;
    let severity = view.severity(plan.findings.worst());
    card.sketch.piece(
        Piece { item: plan.item.clone(), part: Part::Whole, rect, severity, tag: None },
        4.0,
    );
    leave(view, &mut card, rect);
    card.entry = (rect.x, rect.right());
    hung.attach(view, &mut card, rect);
    card
}

/// Starts the flow from the tag to the first element, or to a tag with the error.
fn leave(view: &View, card: &mut Card, rect: Rect) {
    let count = view.plan.starts.len() as f64;
    for (number, start) in (1_u16..).zip(&view.plan.starts) {
        let x = rect.x + rect.width * f64::from(number) / (count + 1.0);
        let (class, severity) = ("start".into(), view.severity(start.findings.worst()));
        let (item, part) = (view.plan.item.clone(), Part::Start(number));
        match to(start.target.as_ref()) {
            Some(Target::Element(Ok(id))) => {
                let at = layout::Exit::Below(x, rect.bottom());
                card.exits.push(Leaving { item, part, severity, at, to: id.index(), class });
                card.sketch.mark(severity, (x, rect.bottom()));
            }
            to => {
                let points = vec![(x, rect.bottom()), (x, rect.bottom() + STUB)];
                card.sketch.arrows.push(Arrow::flow(points, class));
                let (text, class) = match to {
                    Some(Target::Element(Err(text))) => (text.to_owned(), "unknown"),
                    other => (view.target_name(other), "nowhere"),
                };
                let text = if text.is_empty() { "?" } else { &text };
                let width = pill_width(text);
                let top = rect.bottom() + STUB;
                let tag = Rect { x: x - width / 2.0, y: top, width, height: 18.0 };
                card.sketch.pill(tag, class, text, PORT_SIZE);
                card.sketch.piece(Piece { item, part, rect: tag, severity, tag: None }, 0.0);
                card.height = card.height.max(tag.bottom());
            }
        }
    }
}

/// Draws the entries of the plan at the origin; returns an empty rectangle without entries.
fn configuration<'a>(view: &View<'a>, sketch: &mut Sketch<'a>) -> Rect {
    let entries = view.entries();
    if entries.is_empty() {
        return Rect::default();
    }
    let pills: Vec<_> = (0..).zip(entries).map(|(id, entry)| pill(view, id, entry)).collect();
    let names = pills.iter().map(|(text, _)| pill_width(text)).fold(0.0, f64::max);
    let texts: Vec<_> = entries.iter().map(declaration).collect();
    let right = texts.iter().map(|text| width(text, PORT_SIZE, false)).fold(0.0, f64::max);
    let inner = KIND + names + 10.0 + right;
    let height = 30.0 + entries.len() as f64 * ROW + 4.0;
    let rect = Rect { width: inner.max(120.0) + 24.0, height, ..Rect::default() };
    sketch.frame(rect, Shape::Round(9.0), "configuration");
    sketch.labels.push(Label::new((12.0, 19.0), "Configuration", PORT_SIZE, "template"));
    for (index, (entry, text)) in entries.iter().zip(&texts).enumerate() {
        let y = 30.0 + (index as f64 + 0.5) * ROW;
        let base = y + 0.36 * PORT_SIZE;
        sketch.labels.push(Label::new((12.0, base), keyword(entry), PORT_SIZE, "port"));
        let (text_in_pill, class) = &pills[index];
        let width = pill_width(text_in_pill);
        let pill = Rect { x: 12.0 + KIND, y: y - 9.0, width, height: 18.0 };
        sketch.pill(pill, *class, text_in_pill, PORT_SIZE);
        let (item, severity) = (entry.item.clone(), view.severity(entry.findings.worst()));
        sketch.piece(Piece { item, part: Part::Whole, rect: pill, severity, tag: None }, 0.0);
        let place = (22.0 + KIND + names, base);
        sketch.labels.push(Label::new(place, text, PORT_SIZE, "port declared"));
    }
    rect
}

/// The name of an entry. In a drawing by use, a writable entry has its number of writes.
fn pill(view: &View, id: usize, entry: &Entry) -> (String, Class) {
    match view.writes(id).filter(|_| matches!(entry.kind, EntryKind::Var | EntryKind::Out)) {
        None => (entry_name(entry).to_owned(), "entry".into()),
        Some(count) => {
            let class = Class { name: "entry", usage: Some(Use::of(count)) };
            (format!("{}  {}", entry_name(entry), times(count)), class)
        }
    }
}

/// The start of its declaration.
fn keyword(entry: &Entry) -> &'static str {
    if entry.live { "in live" } else { entry.kind.word() }
}

/// Type, initial value and range.
fn declaration(entry: &Entry) -> String {
    let mut text = entry_type(entry);
    if let Some(init) = &entry.init {
        text += &format!(" = {}", shorten(&init.text));
    }
    if let Some([least, greatest]) = &entry.range {
        text += &format!(" from {} to {}", shorten(&least.text), shorten(&greatest.text));
    }
    text
}
