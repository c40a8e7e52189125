//! Scenes in messages: elements and edges by id; after a change only those that differ.

use std::collections::BTreeMap;
use std::sync::Arc;

use afp_draw::{EdgeScene, ElementScene, PieceScene, PlanScene, Rect};
use afp_dsl::outline::{Component, Entry, Outline, Part, Plan};
use afp_ide::edit::path;
use afp_syntax::diagnostics::Severity;
use afp_syntax::item::Item;
use rustc_hash::FxHashMap;
use serde_json::{Value, json};

/// Facts about a plan that its drawing does not show.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Facts {
    elements: FxHashMap<Item, Fact>,
    entries: Vec<Value>,
}

/// Facts about an element that its drawing does not show.
#[derive(Clone, Debug, PartialEq)]
struct Fact {
    kind: &'static str,
    template: Option<String>,
    /// The plan of a sub-plan, and the address of its file if it is a different one.
    plan: Option<String>,
    file: Option<String>,
    help: String,
    note: String,
    folded: bool,
}

impl Facts {
    pub fn new(
        plan: &Plan,
        outline: &Outline,
        folded: &[Item],
        address: &dyn Fn(u16) -> Option<String>,
    ) -> Facts {
        let fact = |one: &Component| {
            let folded = folded.contains(&one.item);
            let used = one.sub_plan().map(|id| outline.plan(id).file());
            let file = used.filter(|file| *file != plan.file()).and_then(address);
            (one.item.clone(), Fact { folded, file, ..Fact::new(one, outline) })
        };
        Facts {
            elements: plan.elements.iter().map(fact).collect(),
            entries: plan.entries.iter().map(entry).collect(),
        }
    }
}

impl Fact {
    fn new(component: &Component, outline: &Outline) -> Fact {
        let used = component.sub_plan().map(|id| outline.plan(id));
        Fact {
            kind: component.kind.keyword(),
            template: component.template.as_ref().map(|template| template.text.clone()),
            plan: used.map(|plan| plan.item.name().to_owned()),
            help: component.doc.clone(),
            note: component.note.clone(),
            folded: false,
            file: None,
        }
    }
}

/// A plan with its drawing, if it has one.
#[derive(Clone, Copy)]
pub(super) struct Shown<'a> {
    pub scene: Option<&'a PlanScene>,
    pub facts: &'a Facts,
}

impl<'a> Shown<'a> {
    fn elements(self) -> FxHashMap<&'a Item, &'a ElementScene> {
        self.scene.iter().flat_map(|it| &it.elements).map(|one| (&one.item, one)).collect()
    }

    fn edges(self) -> FxHashMap<(&'a Item, &'a Part), &'a EdgeScene> {
        self.scene
            .iter()
            .flat_map(|it| &it.edges)
            .map(|one| ((&one.item, &one.part), one))
            .collect()
    }

    fn element(self, one: &ElementScene) -> (String, Value) {
        (path(&one.item), element(one, self.facts.elements.get(&one.item)))
    }

    fn bounds(self) -> Value {
        self.scene.map_or(Value::Null, |scene| rect(scene.bounds))
    }

    pub fn whole(self) -> Value {
        let elements = self.elements().into_values().map(|one| self.element(one));
        let edges = self.edges().into_values().map(|one| (id(one), edge(one)));
        json!({
            "bounds": self.bounds(),
            "elements": sorted(elements),
            "edges": sorted(edges),
            "entries": self.entries(),
        })
    }

    /// Returns new or different parts and the ids of removed ones. `None` means no difference, if
    /// `is_same` confirms it for the other facts.
    pub fn since(self, before: Shown<'_>, is_same: bool) -> Option<Value> {
        let (old, new) = (before.elements(), self.elements());
        let same = |one: &ElementScene| {
            old.get(&one.item).is_some_and(|known| is_same_element(known, one))
                && before.facts.elements.get(&one.item) == self.facts.elements.get(&one.item)
        };
        let elements: Vec<_> =
            new.values().filter(|one| !same(one)).map(|one| self.element(one)).collect();
        let (old_edges, new_edges) = (before.edges(), self.edges());
        let same = |(key, one): &(&(&Item, &Part), &&EdgeScene)| {
            old_edges.get(*key).is_some_and(|known| is_same_edge(known, one))
        };
        let changed = new_edges.iter().filter(|each| !same(each));
        let edges: Vec<_> = changed.map(|(_, one)| (id(one), edge(one))).collect();
        let gone = old.keys().filter(|item| !new.contains_key(*item)).map(|item| path(item));
        let mut gone: Vec<_> = gone.collect();
        gone.sort();
        let left = old_edges.iter().filter(|(key, _)| !new_edges.contains_key(*key));
        let mut left: Vec<_> = left.map(|(_, one)| id(one)).collect();
        left.sort();
        gone.extend(left);
        let calm = is_same && elements.is_empty() && edges.is_empty() && gone.is_empty();
        if calm && self.bounds() == before.bounds() && self.facts.entries == before.facts.entries {
            return None;
        }
        Some(json!({
            "elements": sorted(elements),
            "edges": sorted(edges),
            "gone": gone,
            "entries": self.entries(),
            "bounds": self.bounds(),
        }))
    }

    fn entries(self) -> Value {
        if self.scene.is_some() { json!(self.facts.entries) } else { Value::Null }
    }
}

/// Whether two elements give the same message; places are rounded to tenths.
fn is_same_element(one: &ElementScene, other: &ElementScene) -> bool {
    let same = |(one, other): (&PieceScene, &PieceScene)| {
        (&one.item, &one.part, one.severity) == (&other.item, &other.part, other.severity)
            && tenths(one.rect) == tenths(other.rect)
    };
    is_same_svg(&one.svg, &other.svg)
        && [tenths(one.rect), tenths(one.outer)] == [tenths(other.rect), tenths(other.outer)]
        && one.pieces.len() == other.pieces.len()
        && one.pieces.iter().zip(&other.pieces).all(same)
}

/// Whether two edges give the same message.
fn is_same_edge(one: &EdgeScene, other: &EdgeScene) -> bool {
    let told = |edge: &EdgeScene| {
        edge.points.iter().map(|(x, y)| [tenth(*x), tenth(*y)]).collect::<Vec<_>>()
    };
    is_same_svg(&one.svg, &other.svg)
        && (&one.to, one.kind, one.severity) == (&other.to, other.kind, other.severity)
        && (one.points == other.points || told(one) == told(other))
}

/// Whether two fragments are equal; most share the memory of the last scene.
fn is_same_svg(one: &Arc<str>, other: &Arc<str>) -> bool {
    Arc::ptr_eq(one, other) || one == other
}

fn sorted(all: impl IntoIterator<Item = (String, Value)>) -> Vec<Value> {
    all.into_iter().collect::<BTreeMap<_, _>>().into_values().collect()
}

/// An edge's id comes from its source.
fn id(edge: &EdgeScene) -> String {
    let item = path(&edge.item);
    match &edge.part {
        Part::Exit { name, nth: 1 } => format!("{item}!{name}"),
        Part::Exit { name, nth } => format!("{item}!{name}#{nth}"),
        Part::Start(nth) => format!("{item}!start#{nth}"),
        _ => item,
    }
}

/// Describes an element; the start has no facts.
fn element(one: &ElementScene, fact: Option<&Fact>) -> Value {
    json!({
        "item": path(&one.item),
        "rect": rect(one.rect),
        "outer": rect(one.outer),
        "svg": &*one.svg,
        "pieces": one.pieces.iter().map(piece).collect::<Vec<_>>(),
        "kind": fact.map(|it| it.kind),
        "template": fact.and_then(|it| it.template.as_ref()),
        "plan": fact.and_then(|it| it.plan.as_ref()),
        "file": fact.and_then(|it| it.file.as_ref()),
        "help": fact.map(|it| &it.help),
        "note": fact.map(|it| &it.note),
        "folded": fact.is_some_and(|it| it.folded),
    })
}

fn piece(piece: &PieceScene) -> Value {
    json!({
        "item": path(&piece.item),
        "part": part(&piece.part),
        "rect": rect(piece.rect),
        "severity": piece.severity.map(Severity::as_str),
        "tag": piece.tag.map(rect),
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
        "svg": &*edge.svg,
        "severity": edge.severity.map(Severity::as_str),
    })
}

fn entry(entry: &Entry) -> Value {
    json!({
        "item": path(&entry.item),
        "name": entry.name.as_ref().map(|name| &name.text),
        "kind": entry.kind.word(),
        "type": entry.ty.as_ref().map(ToString::to_string),
        "value": entry.init.as_ref().map(|init| &init.text),
        "range": entry.range.as_ref().map(|ends| ends.each_ref().map(|end| &end.text)),
        "help": entry.doc,
    })
}

fn rect(rect: Rect) -> Value {
    json!(tenths(rect))
}

fn tenths(rect: Rect) -> [f64; 4] {
    [rect.x, rect.y, rect.width, rect.height].map(tenth)
}

/// Rounds to a tenth of a pixel, without a negative zero.
fn tenth(value: f64) -> f64 {
    (value * 10.0).round() / 10.0 + 0.0
}

/// Describes a part of an item: its kind and name.
pub(crate) fn part(part: &Part) -> Value {
    match part {
        Part::Whole => json!({ "kind": "whole" }),
        Part::Start(nth) => json!({ "kind": "start", "nth": nth }),
        Part::Input { name, nth } => json!({ "kind": "input", "name": name, "nth": nth }),
        Part::Output { name, nth } => json!({ "kind": "output", "name": name, "nth": nth }),
        Part::Exit { name, nth } => json!({ "kind": "exit", "name": name, "nth": nth }),
    }
}
