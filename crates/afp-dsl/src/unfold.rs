//! Numbers for everything in a running plan, including sub-plans.
//!
//! Traces use these numbers. Generated code, loaded plans and log readers take names from here, and
//! the first numbers of sub-plans from [`crate::rows`], so they cannot differ: 0 is the outermost
//! plan; then its elements and its supervisors, then, element by element, the blocks of its
//! sub-plans with the same layout. Entries are numbered likewise.

mod ports;
mod texts;

pub use crate::graph::Goal;
use crate::graph::{
    Component, EdgeSpans, Element, Entry, EntryKind, Graph, Plan, PlanId, Target, resuming,
};
use crate::toolbox::{Case, Template};
use crate::types::Type;
use afp_syntax::source::Span;
pub use afp_types::ComponentKind;
use ports::Ports;
pub use texts::{PlanTexts, TextPlace};

#[derive(Clone, Debug)]
pub struct ComponentNames {
    /// Dotted path from the outermost plan; the plan's own name for the outermost.
    pub path: String,
    pub kind: ComponentKind,
    pub template: String,
    /// States or events with their targets (empty if unconnected), by position.
    pub outcomes: Vec<(String, String)>,
    /// Target of its `Error` (elements) or `DeadlineMissed` (supervisors); empty if unconnected.
    pub special: String,
    pub inputs: Vec<PortNames>,
    /// The bound output ports with their positions.
    pub outputs: Vec<(u16, PortNames)>,
    /// Its edges that override global ones, with their targets.
    pub reactions: Vec<(Reaction, String)>,
    /// Places of the states of a declared computation whose formulas can fail.
    pub states: Vec<Span>,
}

#[derive(Clone, Debug)]
pub struct PortNames {
    pub name: String,
    pub ty: Type,
    /// The SI unit; empty for other values.
    pub unit: String,
    /// Minimum and maximum, in SI units; for an output, those of its entry.
    pub range: Option<(f64, f64)>,
    /// Dotted path of an output's entry; empty for an input.
    pub entry: String,
    /// Place of the bound formula; a default has a place in its toolbox.
    pub span: Span,
}

/// An edge of an element that overrides a global one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Reaction {
    pub supervisor: u32,
    /// The event; `None` for `DeadlineMissed`.
    pub event: Option<u16>,
}

#[derive(Clone, Debug)]
pub struct EntryNames {
    /// Dotted path from the outermost plan.
    pub path: String,
    pub kind: EntryKind,
    pub ty: Type,
    /// Its type as written.
    pub type_text: String,
    /// The SI unit; empty for other values.
    pub unit: String,
    /// Minimum and maximum, in SI units.
    pub range: Option<(f64, f64)>,
    /// Its plan, as the number of its element; 0 is the outermost.
    pub plan: u32,
    pub span: Span,
    /// Place of its initial value.
    pub initial: Option<Span>,
}

/// All components and entries of a running plan, by number.
#[derive(Clone, Debug, Default)]
pub struct Unfolded {
    pub components: Vec<ComponentNames>,
    pub entries: Vec<EntryNames>,
    pub texts: PlanTexts,
}

/// The relations of a component, by numbers.
#[derive(Clone, Debug, Default)]
pub struct Place {
    /// Its plan, as the number of its element; 0 is the outermost. The outermost plan belongs to
    /// itself.
    pub plan: u32,
    /// The element of a local supervisor.
    pub owner: Option<u32>,
    /// Whether it is a computation that may reach `resume`, so that nothing is interrupted before
    /// it.
    pub resumes: bool,
    /// Targets of its states or events, by position.
    pub outcomes: Vec<Option<Goal>>,
    /// Target of its `Error` or `DeadlineMissed`.
    pub special: Option<Goal>,
    pub span: Span,
    pub edges: EdgeSpans,
    pub inputs: Vec<Type>,
    /// Its edges that override global ones, with their source places.
    pub reactions: Vec<(Reaction, Goal, Span)>,
}

impl Place {
    /// The target of a supervisor's event, or its `DeadlineMissed`, if this element overrides it.
    pub fn reaction(&self, supervisor: u32, event: Option<u16>) -> Option<Goal> {
        let wanted = Reaction { supervisor, event };
        self.reactions.iter().find(|(each, ..)| *each == wanted).map(|(_, goal, _)| *goal)
    }
}

pub fn places(graph: &Graph) -> Vec<Place> {
    let mut all = vec![Place { span: graph.main().span, ..Place::default() }];
    add_places(graph, graph.main, 0, &mut all);
    all
}

fn add_places(graph: &Graph, id: PlanId, number: u32, all: &mut Vec<Place>) {
    let plan = graph.plan(id);
    let first = all.len() as u32;
    let goal = |target: Target| target.map(|id| first + u32::from(id.0), |_| ());
    let supervisors = first + plan.elements.len() as u32;
    let resuming = resuming(plan.elements.iter().map(Some));
    all.extend(plan.elements.iter().zip(resuming).map(|(element, resumes)| {
        Place {
            plan: number,
            owner: None,
            resumes,
            outcomes: element.states.iter().map(|state| state.map(goal)).collect(),
            special: element.on_error.map(goal),
            span: element.span,
            edges: element.edges.clone(),
            inputs: element.inputs.iter().map(|input| input.ty.clone()).collect(),
            reactions: reactions(element, supervisors)
                .map(|(each, target, span)| (each, goal(target), span))
                .collect(),
        }
    }));
    all.extend(plan.supervisors.iter().map(|supervisor| Place {
        plan: number,
        owner: supervisor.owner.map(|id| first + u32::from(id.0)),
        resumes: false,
        outcomes: supervisor.events.iter().map(|event| Some(goal(*event))).collect(),
        special: supervisor.on_miss.map(goal),
        span: supervisor.span,
        edges: supervisor.edges.clone(),
        inputs: supervisor.inputs.iter().map(|input| input.ty.clone()).collect(),
        reactions: Vec::new(),
    }));
    for (element, number) in plan.elements.iter().zip(first..) {
        if let Component::SubPlan(child) = element.component {
            add_places(graph, child, number, all);
        }
    }
}

/// The edges of an element that override global ones; `supervisors` is the number of the plan's
/// first one.
fn reactions(
    element: &Element,
    supervisors: u32,
) -> impl Iterator<Item = (Reaction, Target, Span)> {
    element.reactions.iter().flat_map(move |table| {
        let number = supervisors + u32::from(table.supervisor.0);
        let events = (0..).map(Some).take(table.events.len()).chain([None]);
        events.filter_map(move |event| {
            let span = match event {
                Some(event) => table.edges.outcomes.get(usize::from(event)).copied().flatten(),
                None => table.edges.extra,
            };
            let reaction = Reaction { supervisor: number, event };
            Some((reaction, table.target(event)?, span.unwrap_or(table.span)))
        })
    })
}

pub fn unfold(graph: &Graph) -> Unfolded {
    let main = graph.main();
    let mut all = Unfolded { texts: PlanTexts::new(graph), ..Unfolded::default() };
    all.components.push(ComponentNames {
        path: main.name.clone(),
        kind: ComponentKind::Plan,
        template: main.name.clone(),
        outcomes: Vec::new(),
        special: String::new(),
        inputs: Vec::new(),
        outputs: Vec::new(),
        reactions: Vec::new(),
        states: Vec::new(),
    });
    add(graph, graph.main, 0, "", &mut all);
    all
}

fn add(graph: &Graph, id: PlanId, number: u32, prefix: &str, all: &mut Unfolded) {
    let plan = graph.plan(id);
    let first = all.components.len() as u32;
    for entry in &plan.entries {
        let path = format!("{prefix}{}", entry.name);
        let &Entry { kind, range, span, .. } = entry;
        all.entries.push(EntryNames {
            path,
            kind,
            ty: entry.ty.clone(),
            type_text: entry.ty.to_string(),
            unit: entry.ty.si_unit(),
            range,
            plan: number,
            span,
            initial: entry.init.as_ref().map(|init| init.span),
        });
    }
    for index in 0..plan.elements.len() {
        all.components.push(element(graph, plan, index, (prefix, first)));
    }
    for index in 0..plan.supervisors.len() {
        all.components.push(supervisor(graph, plan, index, prefix));
    }
    for (element, number) in plan.elements.iter().zip(first..) {
        if let Component::SubPlan(child) = element.component {
            add(graph, child, number, &format!("{prefix}{}.", element.name), all);
        }
    }
}

fn element(
    graph: &Graph,
    plan: &Plan,
    index: usize,
    (prefix, first): (&str, u32),
) -> ComponentNames {
    let element = &plan.elements[index];
    let (kind, template, states, places) = match element.component {
        Component::Actor(id) | Component::Computation(id) => {
            let template = graph.template(id);
            let kind = match element.component {
                Component::Actor(_) => ComponentKind::Actor,
                _ => ComponentKind::Computation,
            };
            let states = template.outcomes.iter().map(|state| state.name.clone()).collect();
            (kind, template.name.clone(), states, states_that_fail(template))
        }
        Component::SubPlan(id) => {
            let child = graph.plan(id);
            let states = vec!["OK".to_owned(), "Interrupted".to_owned()];
            (ComponentKind::SubPlan, child.name.clone(), states, Vec::new())
        }
    };
    let targets = element.states.iter().map(|state| target(plan, *state));
    let ports = Ports::of_element(graph, plan, element);
    ComponentNames {
        path: format!("{prefix}{}", element.name),
        kind,
        template,
        outcomes: states.into_iter().zip(targets).collect(),
        special: target(plan, element.on_error),
        inputs: ports.inputs(&element.inputs),
        outputs: ports.outputs(&element.outputs, prefix),
        reactions: reactions(element, first + plan.elements.len() as u32)
            .map(|(each, to, _)| (each, target(plan, Some(to))))
            .collect(),
        states: places,
    }
}

/// The places of the states of a declared computation, if a formula of it can fail.
fn states_that_fail(template: &Template) -> Vec<Span> {
    let never_fail = template.cases.iter().flat_map(|cases| cases.iter()).all(Case::never_fails);
    let states = template.outcomes.iter().filter(|_| !never_fail);
    states.map(|state| state.span).collect()
}

fn supervisor(graph: &Graph, plan: &Plan, index: usize, prefix: &str) -> ComponentNames {
    let supervisor = &plan.supervisors[index];
    let template = graph.template(supervisor.template);
    let owner = supervisor.owner.map(|id| format!("{}.", plan.elements[id.index()].name));
    let targets = supervisor.events.iter().map(|event| target(plan, Some(*event)));
    let ports = Ports::of_template(plan, template);
    ComponentNames {
        path: format!("{prefix}{}{}", owner.unwrap_or_default(), supervisor.name),
        kind: ComponentKind::Supervisor,
        template: template.name.clone(),
        outcomes: template.outcomes.iter().map(|event| event.name.clone()).zip(targets).collect(),
        special: target(plan, supervisor.on_miss),
        inputs: ports.inputs(&supervisor.inputs),
        outputs: ports.outputs(&supervisor.outputs, prefix),
        reactions: Vec::new(),
        states: Vec::new(),
    }
}

/// The name of a target.
fn target(plan: &Plan, target: Option<Target>) -> String {
    let Some(target) = target else { return String::new() };
    target.text(|id| &plan.elements[id.index()].name).to_string()
}
