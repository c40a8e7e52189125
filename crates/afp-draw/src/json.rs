//! The graph as JSON, for tools and for comparing plans.

use serde_json::{Map, Value, json};

use super::view::{Exit, Input, View, entry_kind_name, kind_name};
use super::{Options, formula};
use crate::layout_file::Position;
use afp_dsl::graph::{Element, Graph, Plan, Supervisor};

/// The graph as one indented JSON object.
///
/// Keys of a plan: `plan` (its name), `doc`, `first`, `global_supervisors`, `actors` (all elements as
/// written), `entries` and `timing`; of the main plan also `sub_plans`, an array of plans. An
/// element has `name`, `kind`, `template`, `inputs` (the texts of the bound inputs in the order of
/// the template's ports), `outputs` (entries, likewise), `states` (targets by state, `Error`
/// included), `supervisors`, `position` (where it has been placed, in pixels), and `ports` (texts by input port, entries by output port); what is
/// empty is left out. Supervisors have `name`, `template`, `inputs`, `outputs`, `events`; their
/// periods and deadlines stand in `timing`, in nanoseconds.
pub fn json(graph: &Graph, options: &Options) -> String {
    let options = Options { data: true, ..*options };
    let view = |plan| View { graph, plan, options: &options };
    let mut object = plan_object(&view(graph.main()));
    let others = graph.plans.iter().enumerate();
    let others = others.filter(|(index, _)| *index != graph.main.index());
    let others: Vec<_> = others.map(|(_, plan)| plan_object(&view(plan)).into()).collect();
    put(&mut object, "sub_plans", Value::Array(others));
    format!("{:#}\n", Value::Object(object))
}

fn plan_object(view: &View) -> Map<String, Value> {
    let plan = view.plan;
    let supervisors = |owner| supervisor_objects(view, owner);
    let mut object = Map::new();
    put(&mut object, "plan", json!(plan.name));
    put(&mut object, "doc", json!(plan.doc));
    put(&mut object, "first", json!(view.element(plan.start).name));
    put(&mut object, "global_supervisors", supervisors(None));
    let elements = plan.elements.iter().map(|element| element_object(view, element)).collect();
    put(&mut object, "actors", Value::Array(elements));
    put(&mut object, "entries", entries(view));
    put(&mut object, "timing", timing(plan));
    object
}

fn element_object(view: &View, element: &Element) -> Value {
    let mut object = Map::new();
    put(&mut object, "name", json!(element.name));
    put(&mut object, "doc", json!(element.doc));
    put(&mut object, "kind", json!(kind_name(element)));
    put(&mut object, "template", json!(view.template_name(element)));
    let position = view.position(&element.name);
    put(&mut object, "position", json!(position.map(|Position { x, y }| [x, y])));
    let (inputs, outputs) = (view.inputs(element), view.outputs(element));
    put_data(&mut object, &inputs, &outputs);
    put(&mut object, "states", targets(view, &view.states(element)));
    put(&mut object, "supervisors", supervisor_objects(view, Some(element)));
    put(&mut object, "ports", ports(&inputs, &outputs));
    Value::Object(object)
}

fn supervisor_objects(view: &View, owner: Option<&Element>) -> Value {
    let objects = view.supervisors(owner).into_iter().map(|supervisor| {
        let mut object = Map::new();
        put(&mut object, "name", json!(supervisor.name));
        put(&mut object, "template", json!(view.graph.template(supervisor.template).name));
        let (inputs, outputs) =
            (view.supervisor_inputs(supervisor), view.supervisor_outputs(supervisor));
        put_data(&mut object, &inputs, &outputs);
        put(&mut object, "events", targets(view, &view.events(supervisor)));
        Value::Object(object)
    });
    Value::Array(objects.collect())
}

/// Adds what is not empty.
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

fn put_data(object: &mut Map<String, Value>, inputs: &[Input], outputs: &[(&str, &str)]) {
    let bound = inputs.iter().filter(|input| input.bound);
    put(object, "inputs", bound.map(|input| json!(input.text)).collect());
    put(object, "outputs", outputs.iter().map(|(_, entry)| json!(entry)).collect());
}

fn ports(inputs: &[Input], outputs: &[(&str, &str)]) -> Value {
    let inputs = inputs.iter().map(|input| (input.port.to_owned(), json!(input.text)));
    let outputs = outputs.iter().map(|(port, entry)| ((*port).to_owned(), json!(entry)));
    let mut object = Map::new();
    put(&mut object, "in", Value::Object(inputs.collect()));
    put(&mut object, "out", Value::Object(outputs.collect()));
    Value::Object(object)
}

fn targets(view: &View, exits: &[Exit]) -> Value {
    let pair = |exit: &Exit| (exit.name.to_owned(), json!(view.target_name(exit.target)));
    Value::Object(exits.iter().map(pair).collect())
}

fn entries(view: &View) -> Value {
    let objects = view.plan.entries.iter().map(|entry| {
        let init = entry.init.as_ref();
        let init = init.map(|init| formula::text(init, view.plan, view.options.sources));
        let mut object = Map::new();
        put(&mut object, "name", json!(entry.name));
        put(&mut object, "doc", json!(entry.doc));
        put(&mut object, "kind", json!(entry_kind_name(entry.kind)));
        put(&mut object, "type", json!(entry.ty.to_string()));
        put(&mut object, "init", json!(init));
        Value::Object(object)
    });
    Value::Array(objects.collect())
}

fn timing(plan: &Plan) -> Value {
    let object = |supervisor: &Supervisor| {
        let owner = supervisor.owner.map(|owner| plan.elements[owner.index()].name.as_str());
        json!({
            "element": owner,
            "supervisor": supervisor.name,
            "every_ns": supervisor.every,
            "deadline_ns": supervisor.deadline,
        })
    };
    Value::Array(plan.supervisors.iter().map(object).collect())
}
