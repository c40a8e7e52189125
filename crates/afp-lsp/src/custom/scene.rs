//! A scene in messages, piece by piece.

use std::collections::BTreeMap;

use afp_draw::{EdgeScene, ElementScene, PieceScene, PlanScene, Rect};
use afp_dsl::graph::EntryKind;
use afp_dsl::outline::{Component, Entry, Outline, Part, Plan};
use afp_ide::edit::path;
use afp_syntax::diagnostics::Severity;
use serde_json::{Value, json};

use super::items::part;

/// Everything of a drawing that a client is told of: elements and edges by their ids.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Shown {
    pub elements: BTreeMap<String, Value>,
    pub edges: BTreeMap<String, Value>,
    pub entries: Value,
    pub bounds: Value,
}

impl Shown {
    pub fn new(scene: &PlanScene, plan: &Plan, outline: &Outline) -> Shown {
        let element = |one: &ElementScene| {
            (path(&one.item), element(one, plan.component(&one.item), outline))
        };
        Shown {
            elements: scene.elements.iter().map(element).collect(),
            edges: scene.edges.iter().map(|one| (id(one), edge(one))).collect(),
            entries: plan.entries.iter().map(entry).collect(),
            bounds: rect(scene.bounds),
        }
    }
}

/// An edge goes by what it leaves.
fn id(edge: &EdgeScene) -> String {
    let item = path(&edge.item);
    match &edge.part {
        Part::Exit { name, nth: 1 } => format!("{item}!{name}"),
        Part::Exit { name, nth } => format!("{item}!{name}#{nth}"),
        Part::Start(nth) => format!("{item}!start#{nth}"),
        _ => item,
    }
}

fn element(one: &ElementScene, component: Option<&Component>, outline: &Outline) -> Value {
    let used = component.and_then(|it| it.sub_plan()).map(|id| outline.plan(id));
    json!({
        "item": path(&one.item),
        "rect": rect(one.rect),
        "outer": rect(one.outer),
        "svg": one.svg,
        "pieces": one.pieces.iter().map(piece).collect::<Vec<_>>(),
        "kind": component.map(|it| it.kind.keyword()),
        "template": component.and_then(|it| it.template.as_ref()).map(|template| &template.text),
        "plan": used.map(|plan| plan.item.name()),
        "help": component.map(|it| &it.doc),
        "note": component.map(|it| &it.note),
    })
}

fn piece(piece: &PieceScene) -> Value {
    json!({
        "item": path(&piece.item),
        "part": part(&piece.part),
        "rect": rect(piece.rect),
        "severity": piece.severity.map(Severity::as_str),
    })
}

fn edge(edge: &EdgeScene) -> Value {
    let points: Vec<_> = edge.points.iter().map(|(x, y)| [tenth(*x), tenth(*y)]).collect();
    json!({
        "id": id(edge),
        "from": path(&edge.item),
        "part": part(&edge.part),
        "to": path(&edge.to),
        "kind": edge.kind,
        "points": points,
        "svg": edge.svg,
        "severity": edge.severity.map(Severity::as_str),
    })
}

fn entry(entry: &Entry) -> Value {
    json!({
        "item": path(&entry.item),
        "name": entry.name.as_ref().map(|name| &name.text),
        "kind": match entry.kind {
            EntryKind::In => "in",
            EntryKind::Out => "out",
            EntryKind::Var => "var",
            EntryKind::Const => "const",
        },
        "type": entry.ty.as_ref().map(ToString::to_string),
        "value": entry.init.as_ref().map(|init| &init.text),
        "range": entry.range.as_ref().map(|ends| ends.each_ref().map(|end| &end.text)),
        "help": entry.doc,
    })
}

fn rect(rect: Rect) -> Value {
    json!([rect.x, rect.y, rect.width, rect.height].map(tenth))
}

/// Rounded to a tenth of a pixel; no zero has a sign.
fn tenth(value: f64) -> f64 {
    (value * 10.0).round() / 10.0 + 0.0
}
