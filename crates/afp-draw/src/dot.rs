//! A plan as GraphViz text, for external layout tools.

use std::fmt::Write;

use super::Options;
use super::names::free_names;
use super::view::{Exit, To, View, name, to};
use afp_dsl::graph::Target;
use afp_dsl::outline::{Component, ComponentKind, ExitKind, Outline};

/// The plan in the DOT language: a cluster for each plan, solid edges for states, dashed edges for
/// events, with their exits' names. A state of a declared computation also has its condition. A resuming exit has a hollow arrow back to its own element.
/// An edge that suspends begins with a ring, its handler is dashed, and `return` is a node.
/// Ignored events and unconnected exits are left out.
pub fn dot(outline: &Outline, options: &Options) -> String {
    let views = View::all(outline, options);
    let title = views.first().map_or("", View::name);
    let mut text = format!("digraph {} {{\n", quoted(title));
    text += "  node [fontname=\"Helvetica\", shape=box, style=rounded];\n";
    text += "  edge [fontname=\"Helvetica\", fontsize=10];\n";
    // Plans in other files may have the same name.
    let prefixes = free_names(views.iter().map(View::name));
    for (index, (view, prefix)) in views.iter().zip(prefixes).enumerate() {
        Cluster { view, prefix }.write(&mut text, index);
    }
    text + "}\n"
}

struct Cluster<'a, 'v> {
    view: &'v View<'a>,
    /// The prefix of its nodes' names.
    prefix: String,
}

impl<'a> Cluster<'a, '_> {
    fn write(&self, text: &mut String, index: usize) {
        let (view, plan) = (self.view, self.view.plan);
        let start = format!("{}!start", self.prefix);
        line(text, 1, &format!("subgraph cluster_{index} {{"));
        line(text, 2, &format!("label={};", quoted(view.name())));
        let label =
            if plan.forever { format!("{}\nforever", view.name()) } else { view.name().to_owned() };
        line(text, 2, &format!("{} [label={}, shape=cds];", quoted(&start), quoted(&label)));
        for element in &plan.elements {
            self.node(text, element);
        }
        let ends = [
            (Target::Terminate, ""),
            (Target::Fail(""), ", color=red"),
            (Target::Return, ", style=dotted"),
        ];
        for (end, look) in ends {
            let end = Some(end);
            if self.reaches(end) {
                let (node, label) = (quoted(&self.node_name(end)), view.target_name(end));
                line(text, 2, &format!("{node} [label=\"{label}\", shape=oval{look}];"));
            }
        }
        line(text, 1, "}");
        for first in &plan.starts {
            let to = to(first.target.as_ref());
            if to.is_some() {
                let to = quoted(&self.node_name(to));
                line(text, 1, &format!("{} -> {to} [penwidth=2];", quoted(&start)));
            }
        }
        self.events(text, &start, &plan.supervisors);
        for element in &plan.elements {
            let from = self.element_name(element);
            let conditions = view.conditions(element);
            for exit in view.exits(element) {
                let condition = conditions.iter().find(|(state, _)| *state == exit.name);
                let label = condition.map_or(exit.name.to_owned(), |(state, condition)| {
                    format!("{state}\n{condition}")
                });
                self.edge(text, &from, &exit, &label);
            }
            self.events(text, &from, &element.supervisors);
            self.events(text, &from, &element.reactions);
        }
    }

    fn node(&self, text: &mut String, element: &'a Component) {
        let view = self.view;
        let shape = match element.kind {
            ComponentKind::Computation => "shape=hexagon, style=solid",
            ComponentKind::SubPlan if view.is_handler(element) => {
                "shape=box, peripheries=2, style=\"rounded,dashed\""
            }
            ComponentKind::SubPlan => "shape=box, peripheries=2",
            ComponentKind::Actor if view.is_handler(element) => {
                "shape=box, style=\"rounded,dashed\""
            }
            ComponentKind::Actor | ComponentKind::Supervisor | ComponentKind::Reactions => {
                "shape=box"
            }
        };
        let mut label = format!("{}\n{}", name(element), view.template_name(element));
        for input in view.inputs(element).iter().filter(|input| input.bound) {
            label += &format!("\n{} = {}", input.port, input.text);
        }
        for output in view.outputs(element) {
            label += &format!("\n{} => {}", output.port, output.entry);
        }
        let node = quoted(&self.element_name(element));
        line(text, 2, &format!("{node} [label={}, {shape}];", quoted(&label)));
    }

    fn events(&self, text: &mut String, from: &str, supervisors: &'a [Component]) {
        for supervisor in supervisors {
            for exit in self.view.exits(supervisor) {
                self.edge(text, from, &exit, &format!("{}: {}", name(supervisor), exit.name));
            }
        }
    }

    fn edge(&self, text: &mut String, from: &str, exit: &Exit<'a>, label: &str) {
        if matches!(exit.to, Some(Target::Ignore) | None) {
            return;
        }
        let style = match exit.kind {
            ExitKind::State => "solid",
            ExitKind::Error => "dotted",
            ExitKind::Event | ExitKind::Missed => "dashed",
        };
        let suspends = matches!(exit.to, Some(Target::Suspend(Ok(_))));
        let looks = if suspends { ", dir=both, arrowtail=odot" } else { "" };
        if exit.to == Some(Target::Resume) {
            let (from, label) = (quoted(from), quoted(&format!("{label}\nresume")));
            let look = format!("label={label}, style={style}, arrowhead=empty");
            return line(text, 1, &format!("{from} -> {from} [{look}];"));
        }
        let (from, to) = (quoted(from), quoted(&self.node_name(exit.to)));
        let label = quoted(label);
        line(text, 1, &format!("{from} -> {to} [label={label}, style={style}{looks}];"));
    }

    fn element_name(&self, element: &Component) -> String {
        format!("{}:{}", self.prefix, element.item.name())
    }

    /// The name of a target's node. Tags get names that no element can have.
    fn node_name(&self, to: To<'a>) -> String {
        match to {
            Some(Target::Element(Ok(id)) | Target::Suspend(Ok(id))) => {
                self.element_name(&self.view.plan.elements[id.index()])
            }
            other => format!("{}!{}", self.prefix, self.view.target_name(other)),
        }
    }

    fn reaches(&self, end: To<'a>) -> bool {
        let end = self.node_name(end);
        let ends = |component: &'a Component| {
            self.view.exits(component).iter().any(|exit| self.node_name(exit.to) == end)
        };
        self.view.plan.components().any(ends)
    }
}

fn line(text: &mut String, depth: usize, content: &str) {
    // Writing to a string cannot fail.
    let _ = writeln!(text, "{:width$}{content}", "", width = 2 * depth);
}

fn quoted(text: &str) -> String {
    let escaped = text.replace('\\', "\\\\").replace('"', "\\\"").replace('\n', "\\n");
    format!("\"{escaped}\"")
}
