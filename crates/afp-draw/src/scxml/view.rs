//! The graph for a chart: inputs with their texts, exits with their names.

use super::super::formula;
use afp_dsl::graph::{
    Component, Element, ElementId, Entry, EntryKind, Formula, Graph, Output, Plan, PlanId,
    Supervisor, SupervisorId, Target, TemplateId,
};
use afp_dsl::toolbox::{InPort, Template};
use afp_syntax::source::{Sources, Span};

/// A plan in its graph, with the options of the chart.
#[derive(Clone, Copy)]
pub(super) struct View<'a> {
    pub(super) graph: &'a Graph,
    pub(super) plan: &'a Plan,
    pub(super) sources: Option<&'a Sources>,
    pub(super) data: bool,
}

/// An input port and its source.
pub(super) struct Input<'a> {
    pub(super) port: &'a str,
    pub(super) text: String,
    /// Whether the plan binds it; otherwise the text is the port's default.
    pub(super) bound: bool,
}

/// An exit of an element or a supervisor.
#[derive(Clone, Copy)]
pub(super) struct Exit<'a> {
    pub(super) name: &'a str,
    pub(super) target: Target,
    pub(super) kind: ExitKind,
}

/// The reason for leaving.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum ExitKind {
    State,
    Error,
    Event,
    Missed,
}

impl<'a> View<'a> {
    pub(super) fn element(&self, id: ElementId) -> &'a Element {
        &self.plan.elements[id.index()]
    }

    /// The name of the template or of the sub-plan.
    pub(super) fn template_name(&self, element: &Element) -> &'a str {
        match element.component {
            Component::Actor(id) | Component::Computation(id) => &self.graph.template(id).name,
            Component::SubPlan(id) => &self.graph.plan(id).name,
        }
    }

    pub(super) fn inputs(&self, element: &Element) -> Vec<Input<'a>> {
        match element.component {
            Component::Actor(id) | Component::Computation(id) => {
                self.template_inputs(id, &element.inputs)
            }
            Component::SubPlan(id) => self.plan_inputs(id, &element.inputs),
        }
    }

    pub(super) fn supervisor_inputs(&self, supervisor: &Supervisor) -> Vec<Input<'a>> {
        self.template_inputs(supervisor.template, &supervisor.inputs)
    }

    fn template_inputs(&self, id: TemplateId, formulas: &[Formula]) -> Vec<Input<'a>> {
        let template = self.graph.template(id);
        let with =
            |(port, formula): (&'a InPort, &Formula)| self.input(&port.name, port.span, formula);
        let inputs = template.inputs.iter().zip(self.shown(formulas)).map(with);
        let table = template.table().filter(|_| self.data);
        let table = table.map(|(port, table)| Input {
            port: &port.name,
            text: table.name.clone(),
            bound: true,
        });
        table.into_iter().chain(inputs).collect()
    }

    fn plan_inputs(&self, id: PlanId, formulas: &[Formula]) -> Vec<Input<'a>> {
        let entries = self.graph.plan(id).entries.iter();
        let ports = entries.filter(|entry| entry.kind == EntryKind::In);
        let with =
            |(entry, formula): (&'a Entry, &Formula)| self.input(&entry.name, entry.span, formula);
        ports.zip(self.shown(formulas)).map(with).collect()
    }

    /// The data, or nothing if the options leave it out.
    fn shown<'d, T>(&self, data: &'d [T]) -> &'d [T] {
        if self.data { data } else { &[] }
    }

    /// A formula at the port's declaration is the port's default.
    fn input(&self, port: &'a str, declared: Span, formula: &Formula) -> Input<'a> {
        let bound = formula.span != declared;
        let sources = self.sources.filter(|_| bound);
        Input { port, text: formula::text(formula, self.plan, sources), bound }
    }

    /// The connected output ports, each with its entry.
    pub(super) fn outputs(&self, element: &Element) -> Vec<(&'a str, &'a str)> {
        match element.component {
            Component::Actor(id) | Component::Computation(id) => {
                self.template_outputs(id, &element.outputs)
            }
            Component::SubPlan(id) => {
                let entries = self.graph.plan(id).entries.iter();
                let ports = entries.filter(|entry| entry.kind == EntryKind::Out);
                let names: Vec<_> = ports.map(|entry| entry.name.as_str()).collect();
                self.named_outputs(&names, &element.outputs)
            }
        }
    }

    pub(super) fn supervisor_outputs(&self, supervisor: &Supervisor) -> Vec<(&'a str, &'a str)> {
        self.template_outputs(supervisor.template, &supervisor.outputs)
    }

    fn template_outputs(&self, id: TemplateId, outputs: &[Output]) -> Vec<(&'a str, &'a str)> {
        let ports = self.graph.template(id).outputs.iter();
        let names: Vec<_> = ports.map(|port| port.name.as_str()).collect();
        self.named_outputs(&names, outputs)
    }

    fn named_outputs(&self, names: &[&'a str], outputs: &[Output]) -> Vec<(&'a str, &'a str)> {
        let mut outputs: Vec<_> = self.shown(outputs).iter().collect();
        outputs.sort_by_key(|output| output.port);
        let named = outputs.into_iter().filter_map(|output| {
            let port = names.get(usize::from(output.port))?;
            Some((*port, self.plan.entries[output.entry.index()].name.as_str()))
        });
        named.collect()
    }

    /// The connected states, `Error` last.
    pub(super) fn states(&self, element: &Element) -> Vec<Exit<'a>> {
        let names: Vec<&'a str> = match element.component {
            Component::Actor(id) | Component::Computation(id) => {
                outcome_names(self.graph.template(id))
            }
            Component::SubPlan(_) => vec!["OK", "Interrupted"],
        };
        let states = names.into_iter().zip(&element.states).filter_map(|(name, target)| {
            target.map(|target| Exit { name, target, kind: ExitKind::State })
        });
        let error =
            element.on_error.map(|target| Exit { name: "Error", target, kind: ExitKind::Error });
        states.chain(error).collect()
    }

    /// The states of a declared computation by name, as declared; empty without data.
    pub(super) fn declared(&self, element: &Element) -> Vec<(&'a str, String)> {
        match element.component {
            Component::Computation(id) if self.data => {
                formula::states(self.graph.template(id)).collect()
            }
            _ => Vec::new(),
        }
    }

    /// The events, with a connected `DeadlineMissed` last.
    pub(super) fn events(&self, supervisor: &Supervisor) -> Vec<Exit<'a>> {
        let names = outcome_names(self.graph.template(supervisor.template)).into_iter();
        let event =
            |(name, target): (_, &Target)| Exit { name, target: *target, kind: ExitKind::Event };
        let missed = supervisor.on_miss.map(|target| Exit {
            name: "DeadlineMissed",
            target,
            kind: ExitKind::Missed,
        });
        names.zip(&supervisor.events).map(event).chain(missed).collect()
    }

    /// The events of each global supervisor during an element, each with whether the element
    /// replaces it.
    pub(super) fn global_events(
        &self,
        element: &Element,
    ) -> Vec<(&'a Supervisor, Vec<(Exit<'a>, bool)>)> {
        let globals = (0..self.plan.globals).map(SupervisorId);
        let exits = |id: SupervisorId| {
            let supervisor = &self.plan.supervisors[id.index()];
            let table = element.reactions_to(id);
            let events =
                (0..).map(Some).zip(outcome_names(self.graph.template(supervisor.template)));
            let events = events.map(|(event, name)| (event, name, ExitKind::Event));
            let all = events.chain([(None, "DeadlineMissed", ExitKind::Missed)]);
            let exits = all.filter_map(|(event, name, kind)| {
                let here = table.and_then(|table| table.target(event));
                let own = match event {
                    Some(event) => supervisor.events.get(usize::from(event)).copied(),
                    None => supervisor.on_miss,
                };
                Some((Exit { name, target: here.or(own)?, kind }, here.is_some()))
            });
            (supervisor, exits.collect())
        };
        globals.map(exits).collect()
    }

    pub(super) fn supervisors(&self, owner: Option<&Element>) -> Vec<&'a Supervisor> {
        let all = &self.plan.supervisors;
        match owner {
            None => all.iter().take(usize::from(self.plan.globals)).collect(),
            Some(element) => element.supervisors.iter().map(|id| &all[id.index()]).collect(),
        }
    }
}

fn outcome_names(template: &Template) -> Vec<&str> {
    template.outcomes.iter().map(|outcome| outcome.name.as_str()).collect()
}
