//! Plans with errors, as far as needed for timing: flow, templates and times.
//!
//! Editors keep showing the bounds of valid supervisors. Invalid parts take no time and may lead
//! anywhere, so that no other part of the plan is lost.

use std::sync::Arc;

use crate::check::assemble::{needed, tell_apart};
use crate::check::timing::DEFAULT_EVERY;
use crate::check::{PlanHead, Program};
use crate::graph::{
    self, EdgeSpans, Element, ElementId, Formula, Graph, PlanId, Reactions, ReasonId, Supervisor,
    SupervisorId, TemplateId, ToolboxId,
};
use crate::outline::{
    Component, ComponentKind, Destination, Edge, Exit, ExitKind, MadeFrom, Outline, Plan, Times,
};
use crate::toolbox::{Template, Toolbox};
use afp_syntax::diagnostics::Diagnostics;
use afp_syntax::source::Span;

/// A possibly incomplete plan; it cannot run.
#[derive(Clone, Debug)]
pub(crate) struct Partial {
    /// Its graph without rows; elements with errors have no inputs, and none has outputs.
    pub graph: Graph,
    /// Names of supervisors with errors, whose bounds are unknown.
    pub wrong: Vec<Span>,
}

/// The checked parts of a plan.
pub(super) struct Parts {
    /// The plan, if it is complete.
    pub plan: Option<graph::Plan>,
    /// Otherwise the valid inputs of each element.
    pub inputs: Vec<Vec<Formula>>,
}

/// The plan `main` with its sub-plans; `order` has sub-plans before their users. `None` if there
/// are too many elements.
pub(super) fn partial(
    program: &Program<'_>,
    mut plans: Vec<Parts>,
    outline: &Outline,
    (order, main): (&[usize], usize),
    diags: &Diagnostics,
) -> Option<Partial> {
    let needed = needed(program, main);
    let mut toolboxes = program.linked.clone();
    let unknown = ToolboxId(u16::try_from(toolboxes.len()).ok()?);
    toolboxes.push(Arc::new(nothing_known()));
    let unknown = TemplateId { toolbox: unknown, index: 0 };
    let mut reader = Reader { toolboxes, unknown, ids: vec![None; plans.len()], wrong: Vec::new() };
    let mut drawn = Vec::new();
    for place in order.iter().copied().filter(|place| needed[*place]) {
        let (head, node) = (&program.plans[place], &outline.plans[place]);
        let plan = match plans[place].plan.take() {
            Some(plan) => reader.whole(plan),
            None => reader.plan(head, node, &plans[place].inputs)?,
        };
        reader.note_wrong(node, diags);
        reader.ids[place] = Some(PlanId(u16::try_from(drawn.len()).ok()?));
        drawn.push(plan);
    }
    let main = reader.ids[main]?;
    tell_apart(&mut drawn, main);
    let sources = program.files.iter().map(|file| (file.source.0, Arc::clone(file.source.1)));
    let (toolboxes, sources) = (reader.toolboxes, sources.collect());
    let graph = Graph { plans: drawn, main, toolboxes, rows: Vec::new(), sources, moment: None };
    Some(Partial { graph, wrong: reader.wrong })
}

/// A toolbox with one template that takes no time, for unknown templates.
fn nothing_known() -> Toolbox {
    let template =
        Template { every: DEFAULT_EVERY, budget: Some(0), stop: Some(0), ..Template::default() };
    Toolbox { templates: vec![template], ..Toolbox::default() }
}

/// Reads plans from the outline.
struct Reader {
    toolboxes: Vec<Arc<Toolbox>>,
    unknown: TemplateId,
    /// Plans read so far, by their index in the program.
    ids: Vec<Option<PlanId>>,
    wrong: Vec<Span>,
}

impl Reader {
    /// A complete plan with the numbers of its sub-plans.
    fn whole(&self, mut plan: graph::Plan) -> graph::Plan {
        for element in &mut plan.elements {
            if let graph::Component::SubPlan(place) = element.component {
                element.component = self.sub_plan(place.index());
            }
        }
        plan
    }

    /// A plan; its last element stands for all targets of invalid edges.
    fn plan(
        &mut self,
        head: &PlanHead,
        node: &Plan,
        inputs: &[Vec<Formula>],
    ) -> Option<graph::Plan> {
        let anything = ElementId(u16::try_from(node.elements.len()).ok()?);
        let leads = Leads { anything };
        let globals = u16::try_from(node.supervisors.len()).ok()?;
        let mut supervisors: Vec<_> =
            node.supervisors.iter().map(|each| self.supervisor(each, None, leads)).collect();
        let mut elements = Vec::with_capacity(node.elements.len() + 1);
        for (id, each) in (0..).map(ElementId).zip(&node.elements) {
            let first = u16::try_from(supervisors.len()).ok()?;
            let locals = each.supervisors.iter();
            supervisors.extend(locals.map(|local| self.supervisor(local, Some(id), leads)));
            let end = u16::try_from(supervisors.len()).ok()?;
            let mut element = self.element(each, leads);
            element.supervisors = (first..end).map(SupervisorId).collect();
            element.reactions = leads.reactions(each, &node.supervisors);
            element.inputs = inputs.get(id.index()).cloned().unwrap_or_default();
            elements.push(element);
        }
        elements.push(self.anything(anything, node.span));
        let start = node.starts.first();
        let (name, span) = named(node.name.as_ref(), node.span);
        Some(graph::Plan {
            name,
            file: None,
            doc: String::new(),
            entries: head.entries.iter().map(super::plan::entry).collect(),
            elements,
            supervisors,
            globals,
            reasons: Vec::new(),
            start: start.map_or(anything, |start| match start.target.as_ref().map(|it| it.to) {
                Some(Destination::Element(Some(id))) => leads.element(id),
                _ => anything,
            }),
            interruptible: node.interruptible,
            forever: node.forever,
            span,
            start_span: start.map_or(span, |start| start.span),
        })
    }

    /// An element that may lead to every element of a plan.
    fn anything(&self, own: ElementId, span: Span) -> Element {
        let states = (0..own.0).map(|id| Some(graph::Target::Element(ElementId(id)))).collect();
        Element { states, ..element(String::new(), graph::Component::Actor(self.unknown), span) }
    }

    fn element(&mut self, node: &Component, leads: Leads) -> Element {
        let (name, span) = named(node.name.as_ref(), node.span);
        let component = self.component(node);
        let exits = || node.exits.iter().filter(|exit| exit.kind == ExitKind::State);
        let mut states: Vec<_> = match component {
            graph::Component::SubPlan(_) => {
                let of = |name: &str| exits().find(|exit| *exit.name == *name);
                ["OK", "Interrupted"].map(|name| leads.target(of(name)?)).to_vec()
            }
            _ => exits().map(|exit| leads.target(exit)).collect(),
        };
        if component == graph::Component::Actor(self.unknown) {
            states.push(Some(graph::Target::Element(leads.anything)));
        }
        let error = node.exits.iter().find(|exit| exit.kind == ExitKind::Error);
        let on_error = error.and_then(|exit| leads.target(exit));
        Element { states, on_error, ..element(name, component, span) }
    }

    fn supervisor(
        &mut self,
        node: &Component,
        owner: Option<ElementId>,
        leads: Leads,
    ) -> Supervisor {
        let (name, span) = named(node.name.as_ref(), node.span);
        let times = node.times.unwrap_or_else(|| Times::new(DEFAULT_EVERY, DEFAULT_EVERY, None));
        let event = |exit: &Exit| leads.target(exit).unwrap_or(graph::Target::Ignore);
        let missed = node.exits.iter().find(|exit| exit.kind == ExitKind::Missed);
        Supervisor {
            doc: String::new(),
            owner,
            template: self.template(node).unwrap_or(self.unknown),
            generic: None,
            inputs: Vec::new(),
            outputs: Vec::new(),
            events: events(node).map(event).collect(),
            on_miss: missed.and_then(|exit| leads.target(exit)),
            timing: times.timing,
            timed_by: Vec::new(),
            every_span: times.every_span,
            edges: EdgeSpans::default(),
            name,
            span,
        }
    }

    fn component(&mut self, node: &Component) -> graph::Component {
        match (node.kind, node.sub_plan(), self.template(node)) {
            (ComponentKind::SubPlan, Some(plan), _) => self.sub_plan(plan.index()),
            (ComponentKind::Computation, _, Some(id)) => graph::Component::Computation(id),
            (_, _, id) => graph::Component::Actor(id.unwrap_or(self.unknown)),
        }
    }

    /// A plan by its index in the program; a recursive plan is unknown.
    fn sub_plan(&self, index: usize) -> graph::Component {
        let id = self.ids.get(index).copied().flatten();
        id.map_or(graph::Component::Actor(self.unknown), graph::Component::SubPlan)
    }

    fn template(&mut self, node: &Component) -> Option<TemplateId> {
        let MadeFrom::Template { toolbox, index } = node.template.as_ref()?.made_from.as_ref()?
        else {
            return None;
        };
        let known = self.toolboxes.iter().position(|known| Arc::ptr_eq(known, toolbox));
        let place = known.unwrap_or_else(|| {
            self.toolboxes.push(Arc::clone(toolbox));
            self.toolboxes.len() - 1
        });
        let toolbox = ToolboxId(u16::try_from(place).ok()?);
        Some(TemplateId { toolbox, index: u16::try_from(*index).ok()? })
    }

    /// Records supervisors with errors, and those of elements with unknown templates.
    fn note_wrong(&mut self, plan: &Plan, diags: &Diagnostics) {
        let elements = plan.elements.iter().flat_map(|element| {
            let is_known = element.template().is_some() || element.sub_plan().is_some();
            element.supervisors.iter().map(move |own| (own, is_known))
        });
        let all = plan.supervisors.iter().map(|own| (own, true)).chain(elements);
        let is_wrong = |(own, is_known): &(&Component, bool)| {
            !is_known || own.template().is_none() || diags.error_within(own.span)
        };
        let wrong = all.filter(is_wrong);
        self.wrong
            .extend(wrong.map(|(own, _)| own.name.as_ref().map_or(own.span, |name| name.span)));
    }
}

/// Targets of a plan's edges.
#[derive(Clone, Copy)]
struct Leads {
    /// The element for invalid targets.
    anything: ElementId,
}

impl Leads {
    /// `None` for an optional unconnected exit.
    fn target(self, exit: &Exit) -> Option<graph::Target> {
        match &exit.edge {
            Some(edge) => Some(self.edge(edge)),
            None => exit.required.then_some(graph::Target::Element(self.anything)),
        }
    }

    fn edge(self, edge: &Edge) -> graph::Target {
        let to = edge.target.as_ref().map_or(Destination::Element(None), |target| target.to);
        let element = |id: Option<_>| id.map_or(self.anything, |id| self.element(id));
        to.map(element, |()| ReasonId(0))
    }

    fn element(self, id: crate::outline::ElementId) -> ElementId {
        u16::try_from(id.index()).map_or(self.anything, ElementId)
    }

    /// The reactions of an element to existing supervisors.
    fn reactions(self, element: &Component, globals: &[Component]) -> Vec<Reactions> {
        if element.kind == ComponentKind::Computation {
            return Vec::new();
        }
        let reactions = element.reactions.iter().filter_map(|node| {
            let name = node.name.as_ref()?;
            let is_it = |own: &Component| own.name.as_ref().is_some_and(|it| it.text == name.text);
            let index = globals.iter().position(is_it)?;
            let own = |event: &Exit| node.exits.iter().find(|exit| exit.name == event.name);
            let missed = node.exits.iter().find(|exit| exit.kind == ExitKind::Missed);
            Some(Reactions {
                supervisor: SupervisorId(u16::try_from(index).ok()?),
                events: events(&globals[index]).map(|it| self.target(own(it)?)).collect(),
                on_miss: missed.and_then(|exit| self.target(exit)),
                span: name.span,
                edges: EdgeSpans::default(),
            })
        });
        reactions.collect()
    }
}

/// Events of a supervisor, including undeclared ones.
fn events(supervisor: &Component) -> impl Iterator<Item = &Exit> {
    supervisor.exits.iter().filter(|exit| exit.kind == ExitKind::Event)
}

/// An element without edges.
fn element(name: String, component: graph::Component, span: Span) -> Element {
    Element {
        name,
        doc: String::new(),
        component,
        generic: None,
        inputs: Vec::new(),
        outputs: Vec::new(),
        states: Vec::new(),
        on_error: None,
        supervisors: Vec::new(),
        reactions: Vec::new(),
        span,
        edges: EdgeSpans::default(),
    }
}

/// A name and its place, or the whole place without a name.
fn named(name: Option<&afp_syntax::ast::Name>, whole: Span) -> (String, Span) {
    name.map_or((String::new(), whole), |name| (name.text.clone(), name.span))
}
