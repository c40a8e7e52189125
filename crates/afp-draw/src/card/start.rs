//! The start tag: the plan's name, its configuration, its global supervisors.

use super::super::formula;
use super::super::layout;
use super::super::metrics::{shorten, width};
use super::super::sketch::{Anchor, Frame, Glyph, Label, Picture, Rect, Shape, Sketch};
use super::super::usage::{Class, Use, times};
use super::super::view::{View, entry_kind_name};
use super::parts::{PORT_SIZE, ROW, pill_width};
use super::supervisors::Stack;
use super::{Card, Leaving};
use afp_dsl::graph::{Entry, EntryKind};

/// Size of the plan's name in pixels.
const NAME: f64 = 15.0;

/// Distance between the configuration and the tag.
const GAP: f64 = 28.0;

/// Width of the words `in`, `out`, `var`, `const` with the space after them.
const KIND: f64 = 40.0;

/// The card of a plan's start tag. Its flow leads to the first element.
pub(in super::super) fn start<'a>(view: &View<'a>) -> Card<'a> {
    let plan = view.plan;
    let mut card = Card::empty();
    let table = configuration(view, &mut card.sketch);
    let left = if table.width > 0.0 { table.width + GAP } else { 0.0 };
    let stack = Stack::new(view, &view.supervisors(None));
    let name = width(&plan.name, NAME, true);
    let rect = Rect { x: left, y: 0.0, width: name + 66.0, height: stack.height.max(46.0) };
    let shape = if stack.height > 0.0 { Shape::Round(9.0) } else { Shape::Round(23.0) };
    let title = if plan.doc.is_empty() { plan.name.clone() } else { plan.doc.clone() };
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
    card.sketch.labels.push(Label {
        x: rect.x + 46.0,
        y: middle + 0.36 * NAME,
        text: plan.name.clone(),
        size: NAME,
        bold: true,
        anchor: Anchor::Start,
        class: "start".into(),
    });
    let at = layout::Exit::Below(rect.x + rect.width / 2.0, rect.bottom());
    card.exits.push(Leaving { at, to: plan.start.index(), class: "start".into() });
    card.width = rect.right();
    card.height = rect.bottom().max(table.height);
    card.entry = (rect.x, rect.right());
    stack.attach(view, &mut card, rect);
    card
}

/// Draws the entries of the plan at the origin; an empty rectangle when there are none.
fn configuration(view: &View, sketch: &mut Sketch) -> Rect {
    let entries = view.entries();
    if entries.is_empty() {
        return Rect { x: 0.0, y: 0.0, width: 0.0, height: 0.0 };
    }
    let pills: Vec<_> = (0..).zip(entries).map(|(id, entry)| pill(view, id, entry)).collect();
    let names = pills.iter().map(|(text, _)| pill_width(text)).fold(0.0, f64::max);
    let texts: Vec<_> = entries.iter().map(|entry| declaration(view, entry)).collect();
    let right = texts.iter().map(|text| width(text, PORT_SIZE, false)).fold(0.0, f64::max);
    let inner = KIND + names + 10.0 + right;
    let rect = Rect {
        x: 0.0,
        y: 0.0,
        width: inner.max(120.0) + 24.0,
        height: 30.0 + entries.len() as f64 * ROW + 4.0,
    };
    sketch.frame(rect, Shape::Round(9.0), "configuration");
    sketch.labels.push(label((12.0, 19.0), "Configuration", PORT_SIZE, "template"));
    for (place, (entry, text)) in entries.iter().zip(&texts).enumerate() {
        let y = 30.0 + (place as f64 + 0.5) * ROW;
        let base = y + 0.36 * PORT_SIZE;
        sketch.labels.push(label((12.0, base), entry_kind_name(entry.kind), PORT_SIZE, "port"));
        let (text_in_pill, class) = &pills[place];
        let width = pill_width(text_in_pill);
        let pill = Rect { x: 12.0 + KIND, y: y - 9.0, width, height: 18.0 };
        sketch.pill(pill, *class, text_in_pill, PORT_SIZE);
        sketch.labels.push(label((22.0 + KIND + names, base), text, PORT_SIZE, "port"));
    }
    rect
}

/// The name of an entry; where use is shown and the plan can write it, with how often it did.
fn pill(view: &View, id: usize, entry: &Entry) -> (String, Class) {
    match view.writes(id).filter(|_| matches!(entry.kind, EntryKind::Var | EntryKind::Out)) {
        None => (entry.name.clone(), "entry".into()),
        Some(count) => {
            let class = Class { name: "entry", usage: Some(Use::of(count)) };
            (format!("{}  {}", entry.name, times(count)), class)
        }
    }
}

/// Type and initial value.
fn declaration(view: &View, entry: &Entry) -> String {
    let ty = entry.ty.to_string();
    match &entry.init {
        None => ty,
        Some(init) => {
            let init = formula::text(init, view.plan, view.options.sources);
            format!("{ty} = {}", shorten(&init))
        }
    }
}

fn label((x, y): (f64, f64), text: &str, size: f64, class: &'static str) -> Label {
    Label {
        x,
        y,
        text: text.to_owned(),
        size,
        bold: false,
        anchor: Anchor::Start,
        class: class.into(),
    }
}
