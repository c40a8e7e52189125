//! The small parts that cards share: ports with data, exits, tags.

use super::super::layout;
use super::super::metrics::{shorten, width};
use super::super::sketch::{Anchor, Arrow, Label, Piece, Rect, Sketch, Tip};
use super::super::usage::{Class, Use};
use super::super::view::{Exit, Input, Output, To};
use super::{Card, Leaving, REACH};
use afp_dsl::graph::Target;
use afp_dsl::outline::{Component, ExitKind, Part};

/// Height of a row with a port or an exit.
pub(super) const ROW: f64 = 22.0;

/// Font sizes in pixels.
pub(super) const PORT_SIZE: f64 = 11.0;
const CHIP_SIZE: f64 = 11.0;

/// The text in the place of a missing part.
const HOLE: &str = "?";

/// Height of data and of exits.
const PILL: f64 = 18.0;

/// The distance of exits from their box.
pub(super) const STAND_OUT: f64 = 9.0;

/// Length of the arrow from an exit to its tag.
const STUB: f64 = 20.0;

/// The length of an exit's arrow back, and its distance from the exit on the way back.
const OUT: f64 = 13.0;
const BESIDE: f64 = 17.0;

/// The texts next to it and to the hook of an exit that returns, and their distance.
const RESUME: &str = "Resume";
const RETURN: &str = "Return";
const APART: f64 = 6.0;

/// The reach of that hook.
const HOOK: f64 = 6.0;

/// The diameter of the hollow tail of an edge that suspends.
const TAIL: f64 = 8.0;

/// The ends of flow that are not elements.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Tag<'a> {
    text: &'a str,
    class: &'static str,
}

impl<'a> Tag<'a> {
    fn of(to: To<'a>) -> Option<Tag<'a>> {
        let (text, class) = match to {
            Some(
                Target::Element(Ok(_)) | Target::Suspend(Ok(_)) | Target::Resume | Target::Return,
            ) => return None,
            Some(Target::Terminate) => ("Terminate", "terminate"),
            Some(Target::Fail("")) => ("Fail", "fail"),
            Some(Target::Fail(reason)) => (reason, "fail"),
            Some(Target::Ignore) => ("Ignore", "ignore"),
            Some(Target::Element(Err(text)) | Target::Suspend(Err(text))) => (text, "unknown"),
            None => ("?", "nowhere"),
        };
        Some(Tag { text, class })
    }
}

pub(super) fn chip_width(name: &str) -> f64 {
    width(name, CHIP_SIZE, false) + 16.0
}

fn tag_width(tag: Tag) -> f64 {
    width(&shorten(tag.text), CHIP_SIZE, false) + 20.0
}

pub(super) fn pill_width(text: &str) -> f64 {
    width(&shorten(text), PORT_SIZE, false) + 16.0
}

/// The width of an exit below a box: its own, or that of its tag or arrow back.
pub(super) fn exit_width(exit: &Exit) -> f64 {
    let own = chip_width(&exit.text());
    match exit.to {
        Some(Target::Resume) => (own + BESIDE + PILL / 3.0).max(width(RESUME, CHIP_SIZE, false)),
        Some(Target::Return) => own.max(width(RETURN, CHIP_SIZE, false)),
        to => own.max(Tag::of(to).map_or(0.0, tag_width)),
    }
}

/// The height of an exit on the right of a box.
pub(super) fn exit_height(exit: &Exit) -> f64 {
    if exit.to == Some(Target::Resume) { ROW + BESIDE - 5.0 } else { ROW }
}

/// The reach of an exit with its tag or arrow back, to the right of its box.
pub(super) fn reach_right(exit: &Exit) -> f64 {
    let beyond = match exit.to {
        Some(Target::Resume) => OUT + APART + width(RESUME, CHIP_SIZE, false),
        Some(Target::Return) => OUT + APART + width(RETURN, CHIP_SIZE, false),
        Some(Target::Suspend(Ok(_))) => TAIL,
        to => Tag::of(to).map_or(0.0, |tag| STUB + tag_width(tag)),
    };
    STAND_OUT + beyond
}

/// Data that flows into a port at `at`, on the side `side`.
pub(super) fn inflow(
    sketch: &mut Sketch,
    of: &Component,
    at: (f64, f64),
    input: &Input,
    side: Anchor,
) {
    let (text, class) = match input {
        Input { missing: true, .. } => (HOLE, "hole"),
        Input { plain: true, text, .. } => (*text, "entry"),
        Input { text, .. } => (*text, "formula"),
    };
    let rect = data(sketch, at, text, class, side);
    let points = vec![attached(rect, at), at];
    sketch.arrows.push(Arrow::data(points));
    port(sketch, at, input.port, side);
    let part = Part::Input { name: input.port.to_owned(), nth: input.nth };
    sketch.pieces.push(Piece {
        item: of.item.clone(),
        part,
        rect,
        severity: input.severity,
        tag: None,
    });
    sketch.mark(input.severity, signed(rect, at));
}

/// Data that flows out of a port at `at`.
pub(super) fn outflow(
    sketch: &mut Sketch,
    of: &Component,
    at: (f64, f64),
    output: &Output,
    side: Anchor,
) {
    let class = if output.entry.is_empty() { "hole" } else { "entry" };
    let rect = data(sketch, at, output.text(), class, side);
    let points = vec![at, attached(rect, at)];
    sketch.arrows.push(Arrow::data(points));
    port(sketch, at, output.port, side);
    let part = Part::Output { name: output.port.to_owned(), nth: output.nth };
    sketch.pieces.push(Piece {
        item: of.item.clone(),
        part,
        rect,
        severity: output.severity,
        tag: None,
    });
    sketch.mark(output.severity, signed(rect, at));
}

impl Output<'_> {
    /// The text of its datum.
    pub(super) fn text(&self) -> &str {
        if self.entry.is_empty() { HOLE } else { self.entry }
    }
}

impl Input<'_> {
    /// The shortened text of its datum.
    pub(super) fn shown(&self) -> &str {
        if self.missing { HOLE } else { self.text }
    }
}

/// The end of a datum next to its port.
fn attached(rect: Rect, (x, y): (f64, f64)) -> (f64, f64) {
    (if rect.x < x { rect.right() } else { rect.x }, y)
}

/// The place of a datum's sign: at its end away from the port.
fn signed(rect: Rect, (x, _): (f64, f64)) -> (f64, f64) {
    (if rect.x < x { rect.x } else { rect.right() }, rect.y)
}

/// Draws the datum next to the port.
fn data(
    sketch: &mut Sketch,
    (x, y): (f64, f64),
    text: &str,
    class: &'static str,
    side: Anchor,
) -> Rect {
    let width = pill_width(text);
    let left = if side == Anchor::Start { x - REACH - width } else { x + REACH };
    let rect = Rect { x: left, y: y - PILL / 2.0, width, height: PILL };
    sketch.pill(rect, class, text, PORT_SIZE);
    rect
}

fn port(sketch: &mut Sketch, (x, y): (f64, f64), name: &str, side: Anchor) {
    let inset = if side == Anchor::Start { 10.0 } else { -10.0 };
    let label = Label::new((x + inset, y + 0.36 * PORT_SIZE), name, PORT_SIZE, "port");
    sketch.labels.push(Label { anchor: side, ..label });
}

/// Draws a state on the lower border of a box, centred at `at`, with its tag or its arrow back.
pub(super) fn exit_below(card: &mut Card, of: &Component, (x, y): (f64, f64), exit: &Exit) {
    let text = exit.text();
    let width = chip_width(&text);
    // The arrow back comes up next to the exit.
    let x = if exit.to == Some(Target::Resume) { x - (exit_width(exit) - width) / 2.0 } else { x };
    let rect = Rect { x: x - width / 2.0, y: y - PILL + STAND_OUT, width, height: PILL };
    chip(card, of, rect, exit, &text);
    let bottom = rect.bottom();
    card.height = card.height.max(bottom);
    if exit.to == Some(Target::Resume) {
        let (turn, up) = (bottom + OUT, rect.right() + BESIDE - 5.0);
        back(card, exit, vec![(x, bottom), (x, turn), (up, turn), (up, y)]);
        let base = turn + APART + 0.8 * CHIP_SIZE;
        card.sketch.labels.push(Label::new((rect.x, base), RESUME, CHIP_SIZE, "resume"));
        card.height = card.height.max(base + 0.2 * CHIP_SIZE);
        return;
    }
    if exit.to == Some(Target::Return) {
        let turn = bottom + OUT;
        hook(card, exit, vec![(x, bottom), (x, turn), (x + HOOK, turn), (x + HOOK, turn - HOOK)]);
        let base = turn + APART + 0.8 * CHIP_SIZE;
        card.sketch.labels.push(Label::new((rect.x, base), RETURN, CHIP_SIZE, "resume"));
        card.height = card.height.max(base + 0.2 * CHIP_SIZE);
        return;
    }
    let Some(tag) = Tag::of(exit.to) else {
        let tail = tail(card, exit, (x, bottom), (x, bottom + TAIL));
        leave(card, of, layout::Exit::Below(x, bottom + tail), exit);
        return;
    };
    let points = vec![(x, bottom), (x, bottom + STUB)];
    card.sketch.arrows.push(Arrow::flow(points, exit_class(exit)));
    let width = tag_width(tag);
    let rect = Rect { x: x - width / 2.0, y: bottom + STUB, width, height: PILL };
    end(card, exit, tag, rect);
    card.height = card.height.max(rect.bottom());
}

/// Draws the tag of an exit. A tag of an unconnected exit can be clicked for its exit.
fn end(card: &mut Card, exit: &Exit, tag: Tag, rect: Rect) {
    card.sketch.pill(rect, tag.class, tag.text, CHIP_SIZE);
    if exit.to.is_none()
        && let Some(piece) = card.sketch.pieces.last_mut()
    {
        piece.tag = Some(rect);
    }
}

/// Draws an event on the right border of a box at `at`, with its tag or its arrow back.
pub(super) fn exit_right(card: &mut Card, of: &Component, (x, y): (f64, f64), exit: &Exit) {
    let text = exit.text();
    let width = chip_width(&text);
    let right = x + STAND_OUT;
    let rect = Rect { x: right - width, y: y - PILL / 2.0, width, height: PILL };
    chip(card, of, rect, exit, &text);
    if exit.to == Some(Target::Resume) {
        let (turn, below) = (right + OUT, y + BESIDE);
        back(card, exit, vec![(right, y), (turn, y), (turn, below), (x, below)]);
        let place = (turn + APART, y + BESIDE / 2.0 + 0.36 * CHIP_SIZE);
        card.sketch.labels.push(Label::new(place, RESUME, CHIP_SIZE, "resume"));
        return;
    }
    if exit.to == Some(Target::Return) {
        let turn = right + OUT;
        hook(card, exit, vec![(right, y), (turn, y), (turn, y - HOOK), (turn - HOOK, y - HOOK)]);
        let place = (turn + APART, y + 0.36 * CHIP_SIZE);
        card.sketch.labels.push(Label::new(place, RETURN, CHIP_SIZE, "resume"));
        return;
    }
    let Some(tag) = Tag::of(exit.to) else {
        let tail = tail(card, exit, (right, y), (right + TAIL, y));
        leave(card, of, layout::Exit::Right(right + tail, y), exit);
        return;
    };
    let points = vec![(right, y), (right + STUB, y)];
    card.sketch.arrows.push(Arrow::flow(points, exit_class(exit)));
    let rect = Rect { x: right + STUB, y: y - PILL / 2.0, width: tag_width(tag), height: PILL };
    end(card, exit, tag, rect);
}

/// Draws the arrow back of a resuming exit.
fn back(card: &mut Card, exit: &Exit, points: Vec<(f64, f64)>) {
    card.sketch.arrows.push(Arrow { tip: Tip::Hollow, ..Arrow::flow(points, exit_class(exit)) });
}

/// Draws the small hook of an exit that returns.
fn hook(card: &mut Card, exit: &Exit, points: Vec<(f64, f64)>) {
    card.sketch.arrows.push(Arrow { tip: Tip::Hook, ..Arrow::flow(points, exit_class(exit)) });
}

/// Draws the hollow tail of an edge that suspends, from a place on. Returns its diameter, or 0.
fn tail(card: &mut Card, exit: &Exit, from: (f64, f64), to: (f64, f64)) -> f64 {
    if !matches!(exit.to, Some(Target::Suspend(_))) {
        return 0.0;
    }
    let ring = Arrow { tip: Tip::Ring, ..Arrow::flow(vec![from, to], exit_class(exit)) };
    card.sketch.arrows.push(ring);
    TAIL
}

/// Draws the exit itself; it is hollow if it is unconnected.
fn chip(card: &mut Card, of: &Component, rect: Rect, exit: &Exit, text: &str) {
    let class = if exit.to.is_none() { "open".into() } else { exit_class(exit) };
    card.sketch.pill(rect, class, text, CHIP_SIZE);
    let (part, severity) = (part(exit), exit.severity);
    card.sketch.piece(Piece { item: of.item.clone(), part, rect, severity, tag: None }, 0.0);
}

pub(super) fn part(exit: &Exit) -> Part {
    Part::Exit { name: exit.name.to_owned(), nth: exit.nth }
}

/// Starts the flow from an exit to its element, if it has one.
pub(super) fn leave(card: &mut Card, of: &Component, at: layout::Exit, exit: &Exit) {
    if let Some(Target::Element(Ok(id)) | Target::Suspend(Ok(id))) = exit.to {
        let (item, part, severity) = (of.item.clone(), part(exit), exit.severity);
        let class = exit_class(exit);
        card.exits.push(Leaving { item, part, severity, at, to: id.index(), class });
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
