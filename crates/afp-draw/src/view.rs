//! The graph as a drawing sees it: ports with their texts, exits with their names.
//!
//! The three drawings agree on what an element shows, since all of them ask here.

use std::borrow::Cow;

use super::usage::{Count, PlanUsage, times};
use super::{Options, formula};
use crate::layout_file::Position;
use afp_dsl::graph::{
    Component, Element, ElementId, Entry, EntryKind, Formula, FormulaKind, Graph, Output, Plan,
    PlanId, Supervisor, Target, TemplateId,
};
use afp_dsl::toolbox::{InPort, Template, Toolbox};
use afp_syntax::item::Item;
use afp_syntax::source::Span;

/// A plan in its graph, with the options of the drawing.
#[derive(Clone, Copy)]
pub(super) struct View<'a> {
    pub(super) graph: &'a Graph,
    pub(super) plan: &'a Plan,
    pub(super) options: &'a Options<'a>,
}

/// An input port and what feeds it.
pub(super) struct Input<'a> {
    pub(super) port: &'a str,
    pub(super) text: String,
    /// Whether the plan binds it; otherwise the text is the port's default.
    pub(super) bound: bool,
    /// Whether it is fed by an entry alone.
    pub(super) plain: bool,
}

/// A way out of an element or a supervisor.
#[derive(Clone, Copy)]
pub(super) struct Exit<'a> {
    pub(super) name: &'a str,
    pub(super) target: Target,
    pub(super) kind: ExitKind,
    /// How often it was taken, where that is shown.
    pub(super) count: Option<u64>,
}

impl Exit<'_> {
    /// Its name, with how often it was taken.
    pub(super) fn text(&self) -> Cow<'_, str> {
        match self.count {
            None => self.name.into(),
            Some(count) => format!("{}  {}", self.name, times(count)).into(),
        }
    }
}

/// What makes control leave.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum ExitKind {
    State,
    Error,
    Event,
    Missed,
}

impl<'a> View<'a> {
    /// The plans to be drawn: the main one first, the ones it uses after it where wanted.
    pub(super) fn all(graph: &'a Graph, options: &'a Options<'a>) -> Vec<View<'a>> {
        let main = graph.main;
        let indices = (0..graph.plans.len()).rev().filter(|index| *index != main.index());
        let others = indices.filter(|_| options.sub_plans).map(|index| &graph.plans[index]);
        let plans = std::iter::once(graph.main()).chain(others);
        plans.map(|plan| View { graph, plan, options }).collect()
    }

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

    /// Where an element, or the start tag under the name `start`, has been placed.
    pub(super) fn position(&self, name: &str) -> Option<Position> {
        let file = self.options.positions.get(usize::from(self.plan.span.file))?;
        file.get(&Item::inner(&self.plan.name, name))
    }

    /// The entries of the plan, if data is shown.
    pub(super) fn entries(&self) -> &'a [Entry] {
        self.shown(&self.plan.entries)
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
        let ports = self.graph.template(id).inputs.iter();
        let with =
            |(port, formula): (&'a InPort, &Formula)| self.input(&port.name, port.span, formula);
        ports.zip(self.shown(formulas)).map(with).collect()
    }

    fn plan_inputs(&self, id: PlanId, formulas: &[Formula]) -> Vec<Input<'a>> {
        let entries = self.graph.plan(id).entries.iter();
        let ports = entries.filter(|entry| entry.kind == EntryKind::In);
        let with =
            |(entry, formula): (&'a Entry, &Formula)| self.input(&entry.name, entry.span, formula);
        ports.zip(self.shown(formulas)).map(with).collect()
    }

    /// All or nothing, as the options say.
    fn shown<'d, T>(&self, data: &'d [T]) -> &'d [T] {
        if self.options.data { data } else { &[] }
    }

    /// A formula that stands where the port is declared is the port's default.
    fn input(&self, port: &'a str, declared: Span, formula: &Formula) -> Input<'a> {
        let bound = formula.span != declared;
        let sources = self.options.sources.filter(|_| bound);
        Input {
            port,
            text: formula::text(formula, self.plan, sources),
            bound,
            plain: is_entry(formula),
        }
    }

    /// The connected output ports, each with the entry it writes.
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
        let counts = self.element_count(element);
        let count = |place: usize| counts?.outcomes.get(place).copied();
        let states = names.into_iter().zip(&element.states).enumerate();
        let states = states.filter_map(|(place, (name, target))| {
            let count = count(place);
            target.map(|target| Exit { name, target, kind: ExitKind::State, count })
        });
        let error = element.on_error.map(|target| Exit {
            name: "Error",
            target,
            kind: ExitKind::Error,
            count: counts.map(|counts| counts.special),
        });
        states.chain(error).collect()
    }

    /// The events, `DeadlineMissed` last where it is connected.
    pub(super) fn events(&self, supervisor: &Supervisor) -> Vec<Exit<'a>> {
        let names = outcome_names(self.graph.template(supervisor.template));
        let counts = self.supervisor_count(supervisor);
        let event = |(place, (name, target)): (usize, (&'a str, &Target))| Exit {
            name,
            target: *target,
            kind: ExitKind::Event,
            // What is ignored is never taken, so that counting it would say nothing.
            count: counts
                .and_then(|counts| counts.outcomes.get(place).copied())
                .filter(|_| *target != Target::Ignore),
        };
        let missed = supervisor.on_miss.map(|target| Exit {
            name: "DeadlineMissed",
            target,
            kind: ExitKind::Missed,
            count: counts.map(|counts| counts.special),
        });
        names.into_iter().zip(&supervisor.events).enumerate().map(event).chain(missed).collect()
    }

    /// How often the parts of the plan were used, where that is shown.
    fn usage(&self) -> Option<&'a PlanUsage> {
        let usage = self.options.usage?;
        let place = self.graph.plans.iter().position(|plan| std::ptr::eq(plan, self.plan))?;
        usage.plans.get(place)
    }

    /// How often an element of the plan was used.
    pub(super) fn element_count(&self, element: &Element) -> Option<&'a Count> {
        let elements = &self.plan.elements;
        let place = elements.iter().position(|each| std::ptr::eq(each, element))?;
        self.usage()?.elements.get(place)
    }

    /// How often a supervisor of the plan was used.
    pub(super) fn supervisor_count(&self, supervisor: &Supervisor) -> Option<&'a Count> {
        let supervisors = &self.plan.supervisors;
        let place = supervisors.iter().position(|each| std::ptr::eq(each, supervisor))?;
        self.usage()?.supervisors.get(place)
    }

    /// How often an entry of the plan was written.
    pub(super) fn writes(&self, entry: usize) -> Option<u64> {
        self.usage()?.entries.get(entry).copied()
    }

    /// Where an exit leads, in the words of the language.
    pub(super) fn target_name(&self, target: Target) -> &'a str {
        match target {
            Target::Element(id) => &self.element(id).name,
            Target::Terminate => "terminate",
            Target::Ignore => "ignore",
        }
    }

    /// The template's toolbox and its icon's name.
    pub(super) fn icon(&self, id: TemplateId) -> Option<(&'a Toolbox, &'a str)> {
        let icon = self.graph.template(id).icon.as_deref()?;
        Some((&self.graph.toolboxes[id.toolbox.index()], icon))
    }

    /// The supervisors of an element, or the global ones.
    pub(super) fn supervisors(&self, owner: Option<&Element>) -> Vec<&'a Supervisor> {
        let all = &self.plan.supervisors;
        match owner {
            None => all.iter().take(usize::from(self.plan.globals)).collect(),
            Some(element) => element.supervisors.iter().map(|id| &all[id.index()]).collect(),
        }
    }
}

/// Whether it is an entry's value, perhaps converted.
fn is_entry(formula: &Formula) -> bool {
    match &formula.kind {
        FormulaKind::Entry(_) => true,
        FormulaKind::Convert(_, inner) => is_entry(inner),
        _ => false,
    }
}

/// The word for an element's kind.
pub(super) fn kind_name(element: &Element) -> &'static str {
    match element.component {
        Component::Actor(_) => "actor",
        Component::Computation(_) => "computation",
        Component::SubPlan(_) => "subplan",
    }
}

/// The word for an entry's kind.
pub(super) fn entry_kind_name(kind: EntryKind) -> &'static str {
    match kind {
        EntryKind::In => "in",
        EntryKind::Out => "out",
        EntryKind::Var => "var",
        EntryKind::Const => "const",
    }
}

fn outcome_names(template: &Template) -> Vec<&str> {
    template.outcomes.iter().map(|outcome| outcome.name.as_str()).collect()
}
