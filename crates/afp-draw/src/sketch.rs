//! The parts of a drawing before it becomes SVG: frames, labels, pictures and lines.
//!
//! Tests measure overlaps here, with the same numbers as in the drawing.

use super::metrics;
use super::usage::Class;
use afp_dsl::outline::{ComponentKind, Part};
use afp_dsl::toolbox::Toolbox;
use afp_syntax::diagnostics::Severity;
use afp_syntax::item::Item;

/// A rectangle in pixels, y downwards.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Rect {
    /// Left border.
    pub x: f64,
    /// Upper border.
    pub y: f64,
    pub width: f64,
    pub height: f64,
}

/// Width of the signs at diagnostics.
const SIGN: f64 = 14.0;

/// The outline of a frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Shape {
    /// Rounded corners.
    Round(f64),
    /// Rounded on the right only, to lean on a box.
    Leaning(f64),
    /// Cut corners.
    Cut(f64),
    /// Rounded corners and a second line inside.
    Double(f64),
}

/// A box.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Frame {
    pub(super) rect: Rect,
    pub(super) shape: Shape,
    pub(super) class: Class,
    /// Its tooltip; empty for none.
    pub(super) title: String,
}

/// The anchor of a label.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Anchor {
    Start,
    Middle,
    End,
}

#[derive(Clone, Debug, PartialEq)]
pub(super) struct Label {
    pub(super) x: f64,
    /// Ordinate of the baseline.
    pub(super) y: f64,
    pub(super) text: String,
    pub(super) size: f64,
    pub(super) bold: bool,
    pub(super) anchor: Anchor,
    pub(super) class: Class,
}

/// A square picture.
#[derive(Clone, Debug)]
pub(super) struct Picture<'a> {
    pub(super) x: f64,
    pub(super) y: f64,
    pub(super) size: f64,
    pub(super) class: Class,
    pub(super) icon: Option<(&'a Toolbox, &'a str)>,
    /// The picture for a missing icon.
    pub(super) fallback: Glyph,
}

/// The simple pictures that are always available.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Glyph {
    Actor,
    Computation,
    SubPlan,
    Supervisor,
    Start,
    Error,
    Warning,
    Note,
}

impl Glyph {
    /// The picture for a kind without an icon.
    pub(super) fn of(kind: ComponentKind) -> Glyph {
        match kind {
            ComponentKind::Actor | ComponentKind::Reactions => Glyph::Actor,
            ComponentKind::Computation => Glyph::Computation,
            ComponentKind::SubPlan => Glyph::SubPlan,
            ComponentKind::Supervisor => Glyph::Supervisor,
        }
    }
}

/// A part of a drawing with an identity in the text.
#[derive(Clone, Debug)]
pub(super) struct Piece {
    pub(super) item: Item,
    pub(super) part: Part,
    pub(super) rect: Rect,
    pub(super) severity: Option<Severity>,
    /// The tag of an unconnected exit.
    pub(super) tag: Option<Rect>,
}

/// A line with an arrow tip at its end.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Arrow {
    pub(super) points: Vec<(f64, f64)>,
    pub(super) class: Class,
    pub(super) tip: Tip,
    /// The length at its end that it shares with others: they are not crossed there.
    pub(super) joined: f64,
}

/// The style of an arrow.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Tip {
    /// A thick line: flow of action.
    Thick,
    /// A thick line with an outlined tip: the active element continues.
    Hollow,
    /// A thick line without a tip: a suspended element continues.
    Hook,
    /// No line but a ring on it: the beginning of an edge that suspends.
    Ring,
    /// A thin line: flow of data.
    Thin,
}

impl Arrow {
    /// Flow of action.
    pub(super) fn flow(points: Vec<(f64, f64)>, class: Class) -> Arrow {
        Arrow { points, class, tip: Tip::Thick, joined: 0.0 }
    }

    pub(super) fn data(points: Vec<(f64, f64)>) -> Arrow {
        Arrow { tip: Tip::Thin, ..Arrow::flow(points, "data".into()) }
    }

    /// Whether it is flow of action.
    pub(super) fn is_flow(&self) -> bool {
        self.tip != Tip::Thin
    }
}

/// A drawing or a part of one.
#[derive(Clone, Debug, Default)]
pub(super) struct Sketch<'a> {
    pub(super) frames: Vec<Frame>,
    pub(super) labels: Vec<Label>,
    pub(super) pictures: Vec<Picture<'a>>,
    pub(super) arrows: Vec<Arrow>,
    pub(super) pieces: Vec<Piece>,
}

impl Rect {
    /// The rectangle, moved.
    pub(super) fn moved(self, (dx, dy): (f64, f64)) -> Rect {
        Rect { x: self.x + dx, y: self.y + dy, ..self }
    }

    /// Right border.
    pub fn right(&self) -> f64 {
        self.x + self.width
    }

    /// Lower border.
    pub fn bottom(&self) -> f64 {
        self.y + self.height
    }

    /// Whether another rectangle is inside of it, with a tolerance of half a pixel.
    pub(super) fn holds(&self, other: &Rect) -> bool {
        self.x - 0.5 < other.x
            && self.y - 0.5 < other.y
            && other.right() < self.right() + 0.5
            && other.bottom() < self.bottom() + 0.5
    }
}

impl Label {
    /// A plain text that begins at a place.
    pub(super) fn new((x, y): (f64, f64), text: &str, size: f64, class: impl Into<Class>) -> Label {
        let (text, class) = (text.to_owned(), class.into());
        Label { x, y, text, size, bold: false, anchor: Anchor::Start, class }
    }

    /// Its bounds.
    #[cfg(test)]
    pub(super) fn rect(&self) -> Rect {
        let width = metrics::width(&self.text, self.size, self.bold);
        let x = match self.anchor {
            Anchor::Start => self.x,
            Anchor::Middle => self.x - width / 2.0,
            Anchor::End => self.x - width,
        };
        Rect { x, y: self.y - 0.8 * self.size, width, height: self.size }
    }
}

impl<'a> Sketch<'a> {
    /// Adds a sign for a diagnostic.
    pub(super) fn mark(&mut self, severity: Option<Severity>, (x, y): (f64, f64)) {
        let (fallback, class) = match severity {
            None => return,
            Some(Severity::Error) => (Glyph::Error, "wrong"),
            Some(Severity::Warning) => (Glyph::Warning, "doubtful"),
            Some(Severity::Note) => (Glyph::Note, "note"),
        };
        let class = class.into();
        let (x, y) = (x - SIGN / 2.0, y - SIGN / 2.0);
        self.pictures.push(Picture { x, y, size: SIGN, class, icon: None, fallback });
    }

    /// Adds another drawing, moved by `(dx, dy)`.
    #[cfg(test)]
    pub(super) fn add(&mut self, other: Sketch<'a>, (dx, dy): (f64, f64)) {
        self.frames.extend(other.frames.into_iter().map(|mut frame| {
            frame.rect.x += dx;
            frame.rect.y += dy;
            frame
        }));
        self.labels.extend(other.labels.into_iter().map(|mut label| {
            label.x += dx;
            label.y += dy;
            label
        }));
        self.pictures.extend(other.pictures.into_iter().map(|mut picture| {
            picture.x += dx;
            picture.y += dy;
            picture
        }));
        self.pieces.extend(other.pieces.into_iter().map(|mut piece| {
            piece.rect.x += dx;
            piece.rect.y += dy;
            piece
        }));
        self.arrows.extend(other.arrows.into_iter().map(|mut arrow| {
            for point in &mut arrow.points {
                *point = (point.0 + dx, point.1 + dy);
            }
            arrow
        }));
    }

    /// Adds a part with an identity, with a sign at this distance inside of its corner if it has a
    /// diagnostic.
    pub(super) fn piece(&mut self, piece: Piece, inset: f64) {
        self.mark(piece.severity, (piece.rect.x + inset, piece.rect.y + inset));
        self.pieces.push(piece);
    }

    /// Adds a frame without a tooltip.
    pub(super) fn frame(&mut self, rect: Rect, shape: Shape, class: impl Into<Class>) {
        let class = class.into();
        self.frames.push(Frame { rect, shape, class, title: String::new() });
    }

    /// Adds a frame of a text line's height with a text.
    pub(super) fn pill(&mut self, rect: Rect, class: impl Into<Class>, text: &str, size: f64) {
        let class = class.into();
        let title = if metrics::shorten(text) == text { String::new() } else { text.to_owned() };
        self.frames.push(Frame { rect, shape: Shape::Round(rect.height / 2.0), class, title });
        let place = (rect.x + rect.width / 2.0, rect.y + rect.height / 2.0 + 0.36 * size);
        let label = Label::new(place, &metrics::shorten(text), size, class);
        self.labels.push(Label { anchor: Anchor::Middle, ..label });
    }
}
