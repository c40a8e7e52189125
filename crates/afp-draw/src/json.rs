//! The graph as JSON, for tools and for comparisons of plans.

use serde_json::{Map, Value, json};

use super::scene::{Drawn, DrawnPlan};
use super::view::{Exit, Input, Output, View, entry_name, entry_type, name, to};
use super::{Options, Rect};
use crate::layout_file::Position;
use afp_dsl::outline::{Component, Outline, Part, Plan};
use afp_syntax::item::Item;

/// The plan as one indented JSON object, with the places of all parts.
///
/// A plan has the keys `plan` (its name), `doc`, `forever` (if set), `first`, `global_supervisors`,
/// `actors` (all elements in source order), `entries`, `timing` and `edges`. The main plan also has
/// `sub_plans`, an array of plans.
///
/// An element has the keys `name`, `kind`, `template`, `inputs` (the texts of the bound inputs in
/// the order of the template's ports), `outputs` (entries in the same order), `states` (targets by
/// state, including `Error`), `supervisors`, `position` (its given place in pixels), `rect` (its
/// box: left, top, width, height), `ports` (texts by input port, entries by output port), and
/// `conditions` (of a declared computation, by state). Empty values are left out.
///
/// Supervisors have `name`, `template`, `inputs`, `outputs`, `events`; their periods and deadlines
/// are in `timing`, in nanoseconds. An edge has `from` (the path of its start), `exit`, `to` and
/// the corners of its route, `points`.
pub fn json(outline: &Outline, options: &Options) -> String {
    let options = Options { data: true, sub_plans: true, ..*options };
    let drawn = Drawn::new(outline, &options, None);
    let mut plans = drawn.plans.iter().map(plan_object);
    let mut object = plans.next().unwrap_or_default();
    put(&mut object, "sub_plans", plans.map(Value::Object).collect());
    format!("{:#}\n", Value::Object(object))
}

fn plan_object(drawn: &DrawnPlan) -> Map<String, Value> {
    let (view, plan) = (&drawn.view, drawn.view.plan);
    let first = plan.starts.first().map(|start| to(start.target.as_ref()));
    let elements = plan.elements.iter().map(|element| element_object(drawn, element)).collect();
    let mut object = Map::new();
    put(&mut object, "plan", json!(view.name()));
    put(&mut object, "doc", json!(plan.doc));
    put(&mut object, "forever", json!(plan.forever.then_some(true)));
    put(&mut object, "first", json!(first.map(|first| view.target_name(first))));
    put(&mut object, "global_supervisors", supervisor_objects(view, &plan.supervisors));
    put(&mut object, "actors", Value::Array(elements));
    put(&mut object, "entries", entries(view));
    put(&mut object, "timing", timing(plan));
    put(&mut object, "edges", edges(drawn));
    object
}

fn element_object<'a>(drawn: &DrawnPlan<'a>, element: &'a Component) -> Value {
    let view = &drawn.view;
    let mut object = Map::new();
    put(&mut object, "name", json!(name(element)));
    put(&mut object, "doc", json!(element.doc));
    put(&mut object, "kind", json!(element.kind.keyword()));
    put(&mut object, "template", json!(view.template_name(element)));
    let position = view.position(&element.item);
    put(&mut object, "position", json!(position.map(|Position { x, y }| [x, y])));
    put(&mut object, "rect", json!(drawn.rect(&element.item).map(rectangle)));
    let (inputs, outputs) = (view.inputs(element), view.outputs(element));
    put_data(&mut object, &inputs, &outputs);
    put(&mut object, "states", targets(view, &view.exits(element)));
    put(&mut object, "supervisors", supervisor_objects(view, &element.supervisors));
    let reactions = element
        .reactions
        .iter()
        .map(|table| json!({ "to": name(table), "events": targets(view, &view.exits(table)) }));
    put(&mut object, "reactions", reactions.collect());
    put(&mut object, "ports", ports(&inputs, &outputs));
    let conditions = view.conditions(element).into_iter();
    let conditions = conditions.map(|(state, condition)| (state.to_owned(), json!(condition)));
    put(&mut object, "conditions", Value::Object(conditions.collect()));
    Value::Object(object)
}

fn supervisor_objects<'a>(view: &View<'a>, supervisors: &'a [Component]) -> Value {
    let objects = supervisors.iter().map(|supervisor| {
        let mut object = Map::new();
        put(&mut object, "name", json!(name(supervisor)));
        put(&mut object, "template", json!(view.template_name(supervisor)));
        let (inputs, outputs) = (view.inputs(supervisor), view.outputs(supervisor));
        put_data(&mut object, &inputs, &outputs);
        put(&mut object, "events", targets(view, &view.exits(supervisor)));
        Value::Object(object)
    });
    Value::Array(objects.collect())
}

fn edges(drawn: &DrawnPlan) -> Value {
    let objects = drawn.edges.iter().map(|edge| {
        let exit = match &edge.part {
            Part::Exit { name, .. } => name.as_str(),
            _ => "start",
        };
        let points: Vec<_> = edge.points.iter().map(|(x, y)| [tenth(*x), tenth(*y)]).collect();
        let to = edge.to.as_ref().map(Item::name);
        json!({ "from": edge.item.to_string(), "exit": exit, "to": to, "points": points })
    });
    Value::Array(objects.collect())
}

fn rectangle(rect: Rect) -> [f64; 4] {
    [rect.x, rect.y, rect.width, rect.height].map(tenth)
}

/// Rounds to a tenth of a pixel.
fn tenth(value: f64) -> f64 {
    (value * 10.0).round() / 10.0 + 0.0
}

/// Adds a value unless it is empty.
fn put(object: &mut Map<String, Value>, key: &str, value: Value) {
    let empty = match &value {
        Value::Null => true,
        Value::String(text) => text.is_empty(),
        Value::Array(items) => items.is_empty(),
        Value::Object(items) => items.is_empty(),
        Value::Bool(_) | Value::Number(_) => false,
    };
    if !empty {
        object.insert(key.to_owned(), value);
    }
}

fn put_data(object: &mut Map<String, Value>, inputs: &[Input], outputs: &[Output]) {
    let bound = inputs.iter().filter(|input| input.bound);
    put(object, "inputs", bound.map(|input| json!(input.text)).collect());
    put(object, "outputs", outputs.iter().map(|output| json!(output.entry)).collect());
}

fn ports(inputs: &[Input], outputs: &[Output]) -> Value {
    let inputs = inputs.iter().filter(|input| !input.missing);
    let inputs = inputs.map(|input| (input.port.to_owned(), json!(input.value())));
    let outputs = outputs.iter().map(|output| (output.port.to_owned(), json!(output.entry)));
    let mut object = Map::new();
    put(&mut object, "in", Value::Object(inputs.collect()));
    put(&mut object, "out", Value::Object(outputs.collect()));
    Value::Object(object)
}

fn targets<'a>(view: &View<'a>, exits: &[Exit<'a>]) -> Value {
    let exits = exits.iter().filter(|exit| exit.to.is_some());
    let pair = |exit: &Exit<'a>| (exit.name.to_owned(), json!(view.target_name(exit.to)));
    Value::Object(exits.map(pair).collect())
}

fn entries(view: &View) -> Value {
    let objects = view.plan.entries.iter().map(|entry| {
        let mut object = Map::new();
        put(&mut object, "name", json!(entry_name(entry)));
        put(&mut object, "doc", json!(entry.doc));
        put(&mut object, "kind", json!(entry.kind.word()));
        put(&mut object, "live", json!(entry.live.then_some(true)));
        put(&mut object, "type", json!(entry_type(entry)));
        put(&mut object, "init", json!(entry.init.as_ref().map(|init| &init.text)));
        let range = entry.range.as_ref().map(|ends| ends.each_ref().map(|end| &end.text));
        put(&mut object, "range", json!(range));
        Value::Object(object)
    });
    Value::Array(objects.collect())
}

fn timing(plan: &Plan) -> Value {
    let global = plan.supervisors.iter().map(|each| (None, each));
    let local = plan
        .elements
        .iter()
        .flat_map(|owner| owner.supervisors.iter().map(move |each| (Some(name(owner)), each)));
    let object = |(owner, supervisor): (Option<&str>, &Component)| {
        let times = supervisor.times?;
        Some(json!({
            "element": owner,
            "supervisor": name(supervisor),
            "every_ns": times.timing.period.as_nanos(),
            "deadline_ns": times.timing.deadline.as_nanos(),
        }))
    };
    Value::Array(global.chain(local).filter_map(object).collect())
}
