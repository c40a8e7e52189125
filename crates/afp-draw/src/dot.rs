//! The graph as GraphViz text, for those who lay out with tools of their own.

use std::fmt::Write;

use super::Options;
use super::view::{Exit, ExitKind, View};
use afp_dsl::graph::{Component, Element, Graph, Supervisor, Target};

/// The graph in the DOT language: a cluster for each plan, solid edges for states, dashed ones for
/// events, named after what takes them. Ignored events are left out.
pub fn dot(graph: &Graph, options: &Options) -> String {
    let mut text = format!("digraph {} {{\n", quoted(&graph.main().name));
    text += "  node [fontname=\"Helvetica\", shape=box, style=rounded];\n";
    text += "  edge [fontname=\"Helvetica\", fontsize=10];\n";
    for (index, view) in View::all(graph, options).iter().enumerate() {
        cluster(&mut text, index, view);
    }
    text + "}\n"
}

fn cluster(text: &mut String, index: usize, view: &View) {
    let plan = view.plan;
    let start = format!("{}!start", plan.name);
    line(text, 1, &format!("subgraph cluster_{index} {{"));
    line(text, 2, &format!("label={};", quoted(&plan.name)));
    line(text, 2, &format!("{} [label={}, shape=cds];", quoted(&start), quoted(&plan.name)));
    for element in &plan.elements {
        node(text, view, element);
    }
    if reaches_end(view) {
        let end = quoted(&node_name(view, Target::Terminate));
        line(text, 2, &format!("{end} [label=\"terminate\", shape=oval];"));
    }
    line(text, 1, "}");
    let first = node_name(view, Target::Element(plan.start));
    line(text, 1, &format!("{} -> {} [penwidth=2];", quoted(&start), quoted(&first)));
    edges(text, view, &start, None);
    for element in &plan.elements {
        edges(text, view, &format!("{}:{}", plan.name, element.name), Some(element));
    }
}

fn node(text: &mut String, view: &View, element: &Element) {
    let name = format!("{}:{}", view.plan.name, element.name);
    let shape = match element.component {
        Component::Actor(_) => "shape=box",
        Component::Computation(_) => "shape=hexagon, style=solid",
        Component::SubPlan(_) => "shape=box, peripheries=2",
    };
    let mut label = format!("{}\n{}", element.name, view.template_name(element));
    for input in view.inputs(element).iter().filter(|input| input.bound) {
        label += &format!("\n{} = {}", input.port, input.text);
    }
    for (port, entry) in view.outputs(element) {
        label += &format!("\n{port} => {entry}");
    }
    line(text, 2, &format!("{} [label={}, {shape}];", quoted(&name), quoted(&label)));
}

fn edges(text: &mut String, view: &View, from: &str, owner: Option<&Element>) {
    for exit in owner.map(|element| view.states(element)).unwrap_or_default() {
        edge(text, view, from, &exit, exit.name);
    }
    for supervisor in view.supervisors(owner) {
        for exit in view.events(supervisor) {
            edge(text, view, from, &exit, &event_label(supervisor, &exit));
        }
    }
}

fn event_label(supervisor: &Supervisor, exit: &Exit) -> String {
    format!("{}: {}", supervisor.name, exit.name)
}

fn edge(text: &mut String, view: &View, from: &str, exit: &Exit, label: &str) {
    if exit.target == Target::Ignore {
        return;
    }
    let style = match exit.kind {
        ExitKind::State => "solid",
        ExitKind::Error => "dotted",
        ExitKind::Event | ExitKind::Missed => "dashed",
    };
    let (from, to, label) = (quoted(from), quoted(&node_name(view, exit.target)), quoted(label));
    line(text, 1, &format!("{from} -> {to} [label={label}, style={style}];"));
}

/// Tags get a name that no element can have.
fn node_name(view: &View, target: Target) -> String {
    let mark = if matches!(target, Target::Element(_)) { ':' } else { '!' };
    format!("{}{mark}{}", view.plan.name, view.target_name(target))
}

fn reaches_end(view: &View) -> bool {
    let elements = view.plan.elements.iter();
    let ends = |exits: Vec<Exit>| exits.iter().any(|exit| exit.target == Target::Terminate);
    elements.into_iter().any(|element| ends(view.states(element)))
        || view.plan.supervisors.iter().any(|supervisor| ends(view.events(supervisor)))
}

fn line(text: &mut String, depth: usize, content: &str) {
    // Writing to a string cannot fail.
    let _ = writeln!(text, "{:width$}{content}", "", width = 2 * depth);
}

fn quoted(text: &str) -> String {
    let escaped = text.replace('\\', "\\\\").replace('"', "\\\"").replace('\n', "\\n");
    format!("\"{escaped}\"")
}
