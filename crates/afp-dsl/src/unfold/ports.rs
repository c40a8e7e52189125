//! The ports of a component with their bindings, for fault messages.

use super::PortNames;
use crate::graph::{Component, Element, EntryKind, Formula, Graph, Output, Plan};
use crate::toolbox::Template;

/// Names and ranges of a component's ports.
pub(super) struct Ports<'a> {
    plan: &'a Plan,
    inputs: Vec<(&'a str, Option<(f64, f64)>)>,
    outputs: Vec<&'a str>,
}

impl<'a> Ports<'a> {
    /// The ports of an element: of its template, or the entries of its plan.
    pub(super) fn of_element(graph: &'a Graph, plan: &'a Plan, element: &Element) -> Self {
        match element.component {
            Component::Actor(id) | Component::Computation(id) => {
                Ports::of_template(plan, graph.template(id))
            }
            Component::SubPlan(id) => {
                let all = graph.plan(id).entries.iter();
                let of = |kind| all.clone().filter(move |entry| entry.kind == kind);
                let inputs = of(EntryKind::In).map(|entry| (&*entry.name, entry.range)).collect();
                let outputs = of(EntryKind::Out).map(|entry| &*entry.name).collect();
                Ports { plan, inputs, outputs }
            }
        }
    }

    pub(super) fn of_template(plan: &'a Plan, template: &'a Template) -> Self {
        let inputs = template.inputs.iter().map(|port| (&*port.name, port.range));
        let outputs = template.outputs.iter().map(|port| &*port.name);
        Ports { plan, inputs: inputs.collect(), outputs: outputs.collect() }
    }
}

impl Ports<'_> {
    pub(super) fn inputs(&self, formulas: &[Formula]) -> Vec<PortNames> {
        let ports = self.inputs.iter().zip(formulas);
        let names = ports.map(|((name, range), formula)| PortNames {
            name: (*name).to_owned(),
            ty: formula.ty.clone(),
            unit: formula.ty.si_unit(),
            range: *range,
            entry: String::new(),
            span: formula.span,
        });
        names.collect()
    }

    /// The bound outputs with their positions; paths of entries begin with `prefix`.
    pub(super) fn outputs(&self, outputs: &[Output], prefix: &str) -> Vec<(u16, PortNames)> {
        let bound = outputs.iter().filter_map(|output| {
            let entry = self.plan.entries.get(output.entry.index())?;
            let name = self.outputs.get(usize::from(output.port))?;
            let names = PortNames {
                name: (*name).to_owned(),
                ty: entry.ty.clone(),
                unit: entry.ty.si_unit(),
                range: entry.range,
                entry: format!("{prefix}{}", entry.name),
                span: output.span,
            };
            Some((output.port, names))
        });
        bound.collect()
    }
}
