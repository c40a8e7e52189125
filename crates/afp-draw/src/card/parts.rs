//! The small parts that cards share: ports with data, exits, tags.

use super::super::layout;
use super::super::metrics::{shorten, width};
use super::super::sketch::{Anchor, Arrow, Label, Rect, Sketch};
use super::super::usage::{Class, Use};
use super::super::view::{Exit, ExitKind, Input};
use super::{Card, Leaving};
use afp_dsl::graph::Target;

/// Height of a row with a port or an exit.
pub(super) const ROW: f64 = 22.0;

/// Sizes of texts in pixels.
pub(super) const PORT_SIZE: f64 = 11.0;
const CHIP_SIZE: f64 = 11.0;

/// Height of data and of exits.
const PILL: f64 = 18.0;

/// How far exits stand out of their box.
pub(super) const STAND_OUT: f64 = 9.0;

/// Length of the arrow from an exit to its tag.
const STUB: f64 = 20.0;

/// The ends of flow that are no elements.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Tag {
    Terminate,
    Ignore,
}

impl Tag {
    pub(super) fn of(target: Target) -> Option<Tag> {
        match target {
            Target::Element(_) => None,
            Target::Terminate => Some(Tag::Terminate),
            Target::Ignore => Some(Tag::Ignore),
        }
    }

    fn text(self) -> &'static str {
        match self {
            Tag::Terminate => "Terminate",
            Tag::Ignore => "Ignore",
        }
    }

    fn class(self) -> &'static str {
        match self {
            Tag::Terminate => "terminate",
            Tag::Ignore => "ignore",
        }
    }
}

pub(super) fn chip_width(name: &str) -> f64 {
    width(name, CHIP_SIZE, false) + 16.0
}

pub(super) fn tag_width(tag: Tag) -> f64 {
    width(tag.text(), CHIP_SIZE, false) + 20.0
}

pub(super) fn pill_width(text: &str) -> f64 {
    width(&shorten(text), PORT_SIZE, false) + 16.0
}

/// How far to the right of its box an exit with its tag reaches.
pub(super) fn reach_right(exit: &Exit) -> f64 {
    STAND_OUT + Tag::of(exit.target).map_or(0.0, |tag| STUB + tag_width(tag))
}

/// Data that flows into a port at `at`; on the side named by `side`.
pub(super) fn inflow(sketch: &mut Sketch, at: (f64, f64), input: &Input, reach: f64, side: Anchor) {
    let class = if input.plain { "entry" } else { "formula" };
    let edge = data(sketch, at, &input.text, class, reach, side);
    sketch.arrows.push(Arrow { points: vec![edge, at], class: "data".into(), thick: false });
    port(sketch, at, input.port, side);
}

/// Data that flows out of a port at `at`.
pub(super) fn outflow(
    sketch: &mut Sketch,
    at: (f64, f64),
    name: &str,
    entry: &str,
    reach: f64,
    side: Anchor,
) {
    let edge = data(sketch, at, entry, "entry", reach, side);
    sketch.arrows.push(Arrow { points: vec![at, edge], class: "data".into(), thick: false });
    port(sketch, at, name, side);
}

/// Draws the datum beside the port and returns where its arrow is attached.
fn data(
    sketch: &mut Sketch,
    (x, y): (f64, f64),
    text: &str,
    class: &'static str,
    reach: f64,
    side: Anchor,
) -> (f64, f64) {
    let width = pill_width(text);
    let (left, edge) = match side {
        Anchor::Start => (x - reach - width, x - reach),
        _ => (x + reach, x + reach),
    };
    let rect = Rect { x: left, y: y - PILL / 2.0, width, height: PILL };
    sketch.pill(rect, class, text, PORT_SIZE);
    (edge, y)
}

fn port(sketch: &mut Sketch, (x, y): (f64, f64), name: &str, side: Anchor) {
    let inset = if side == Anchor::Start { 10.0 } else { -10.0 };
    sketch.labels.push(Label {
        x: x + inset,
        y: y + 0.36 * PORT_SIZE,
        text: name.to_owned(),
        size: PORT_SIZE,
        bold: false,
        anchor: side,
        class: "port".into(),
    });
}

/// A state on the lower border of a box, centred at `at`, with its tag.
pub(super) fn exit_below(card: &mut Card, (x, y): (f64, f64), exit: &Exit) {
    let text = exit.text();
    let width = chip_width(&text);
    let rect = Rect { x: x - width / 2.0, y: y - PILL + STAND_OUT, width, height: PILL };
    card.sketch.pill(rect, exit_class(exit), &text, CHIP_SIZE);
    let bottom = rect.bottom();
    card.height = card.height.max(bottom);
    let Some(tag) = Tag::of(exit.target) else {
        leave(card, layout::Exit::Below(x, bottom), exit);
        return;
    };
    let points = vec![(x, bottom), (x, bottom + STUB)];
    card.sketch.arrows.push(Arrow { points, class: exit_class(exit), thick: true });
    let width = tag_width(tag);
    let rect = Rect { x: x - width / 2.0, y: bottom + STUB, width, height: PILL };
    card.sketch.pill(rect, tag.class(), tag.text(), CHIP_SIZE);
    card.height = card.height.max(rect.bottom());
}

/// An event on the right border of a box at `at`, with its tag.
pub(super) fn exit_right(card: &mut Card, (x, y): (f64, f64), exit: &Exit) {
    let text = exit.text();
    let width = chip_width(&text);
    let right = x + STAND_OUT;
    let rect = Rect { x: right - width, y: y - PILL / 2.0, width, height: PILL };
    card.sketch.pill(rect, exit_class(exit), &text, CHIP_SIZE);
    let Some(tag) = Tag::of(exit.target) else {
        leave(card, layout::Exit::Right(right, y), exit);
        return;
    };
    let points = vec![(right, y), (right + STUB, y)];
    card.sketch.arrows.push(Arrow { points, class: exit_class(exit), thick: true });
    let rect = Rect { x: right + STUB, y: y - PILL / 2.0, width: tag_width(tag), height: PILL };
    card.sketch.pill(rect, tag.class(), tag.text(), CHIP_SIZE);
}

fn leave(card: &mut Card, at: layout::Exit, exit: &Exit) {
    if let Target::Element(id) = exit.target {
        card.exits.push(Leaving { at, to: id.index(), class: exit_class(exit) });
    }
}

fn exit_class(exit: &Exit) -> Class {
    let name = match exit.kind {
        ExitKind::State => "state",
        ExitKind::Error => "error",
        ExitKind::Event => "event",
        ExitKind::Missed => "missed",
    };
    Class { name, usage: exit.count.map(Use::of) }
}
