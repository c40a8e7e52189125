//! Numbers for everything in a running plan, sub-plans unfolded.
//!
//! A trace speaks in these numbers. Generated code, plans loaded at run time and readers of logs
//! take the names from here, and from [`crate::rows`] where the numbers of a sub-plan begin, so they
//! cannot disagree: 0 is the outermost plan; then come its elements and its supervisors, then, element
//! by element, the blocks of its sub-plans, laid out alike. Entries are numbered the same way.

use crate::graph::{Component, EdgeSpans, Entry, EntryKind, Graph, Plan, PlanId, Target, resuming};
use crate::types::Type;
use afp_syntax::source::Span;

/// What a component is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// The outermost plan.
    Plan,
    /// An actor.
    Actor,
    /// A computation.
    Computation,
    /// A sub-plan.
    SubPlan,
    /// A supervisor.
    Supervisor,
}

/// A component with the names that a trace needs.
#[derive(Clone, Debug)]
pub struct ComponentNames {
    /// Dotted path from the outermost plan; the plan's own name for the outermost.
    pub path: String,
    /// What it is.
    pub kind: Kind,
    /// Name of its template or plan.
    pub template: String,
    /// States or events with where they lead (empty where unconnected), by position.
    pub outcomes: Vec<(String, String)>,
    /// Where its `Error` (elements) or `DeadlineMissed` (supervisors) leads; empty where
    /// unconnected.
    pub special: String,
    /// Input ports, by position.
    pub inputs: Vec<String>,
}

/// An entry with the names that a trace needs.
#[derive(Clone, Debug)]
pub struct EntryNames {
    /// Dotted path from the outermost plan.
    pub path: String,
    /// Who may set it.
    pub kind: EntryKind,
    /// Its type.
    pub ty: Type,
    /// Least and greatest value, in SI units.
    pub range: Option<(f64, f64)>,
    /// The plan that it belongs to, which goes by the number of its element; 0 is the outermost.
    pub plan: u32,
    /// The name in the text.
    pub span: Span,
}

/// All components and entries of a running plan, by number.
#[derive(Clone, Debug, Default)]
pub struct Unfolded {
    /// The components.
    pub components: Vec<ComponentNames>,
    /// The entries.
    pub entries: Vec<EntryNames>,
}

/// How a component hangs together with the others, by their numbers.
#[derive(Clone, Debug, Default)]
pub struct Place {
    /// The plan that it belongs to, which goes by the number of its element; 0 is the outermost. The
    /// outermost plan belongs to itself.
    pub plan: u32,
    /// The element of a local supervisor.
    pub owner: Option<u32>,
    /// Whether it is a computation that may lead to `resume`, so that nothing is interrupted before it runs.
    pub resumes: bool,
    /// Where its states or events lead, by position.
    pub outcomes: Vec<Option<Goal>>,
    /// Where its `Error` or `DeadlineMissed` leads.
    pub special: Option<Goal>,
    /// The name in the text.
    pub span: Span,
    /// Where its edges stand in the text.
    pub edges: EdgeSpans,
    /// The types of its inputs, by port.
    pub inputs: Vec<Type>,
}

/// Where an edge leads.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Goal {
    /// To an element.
    Element(u32),
    /// The plan ends.
    Terminate,
    /// The plan fails.
    Fail,
    /// The event is not taken.
    Ignore,
    /// What is active goes on.
    Resume,
}

/// The place of each component, by its number.
pub fn places(graph: &Graph) -> Vec<Place> {
    let mut all = vec![Place { span: graph.main().span, ..Place::default() }];
    add_places(graph, graph.main, 0, &mut all);
    all
}

fn add_places(graph: &Graph, id: PlanId, number: u32, all: &mut Vec<Place>) {
    let plan = graph.plan(id);
    let first = all.len() as u32;
    let goal = |target: Target| match target {
        Target::Element(id) => Goal::Element(first + u32::from(id.0)),
        Target::Terminate => Goal::Terminate,
        Target::Fail(_) => Goal::Fail,
        Target::Ignore => Goal::Ignore,
        Target::Resume => Goal::Resume,
    };
    let resuming = resuming(plan.elements.iter().map(Some));
    all.extend(plan.elements.iter().zip(resuming).map(|(element, resumes)| Place {
        plan: number,
        owner: None,
        resumes,
        outcomes: element.states.iter().map(|state| state.map(goal)).collect(),
        special: element.on_error.map(goal),
        span: element.span,
        edges: element.edges.clone(),
        inputs: element.inputs.iter().map(|input| input.ty.clone()).collect(),
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
    }));
    for (element, number) in plan.elements.iter().zip(first..) {
        if let Component::SubPlan(child) = element.component {
            add_places(graph, child, number, all);
        }
    }
}

/// Names for all numbers of the plan that runs.
pub fn unfold(graph: &Graph) -> Unfolded {
    let main = graph.main();
    let mut all = Unfolded::default();
    all.components.push(ComponentNames {
        path: main.name.clone(),
        kind: Kind::Plan,
        template: main.name.clone(),
        outcomes: Vec::new(),
        special: String::new(),
        inputs: Vec::new(),
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
        let ty = entry.ty.clone();
        all.entries.push(EntryNames { path, kind, ty, range, plan: number, span });
    }
    for index in 0..plan.elements.len() {
        all.components.push(element(graph, plan, index, prefix));
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

fn element(graph: &Graph, plan: &Plan, index: usize, prefix: &str) -> ComponentNames {
    let element = &plan.elements[index];
    let (kind, template, states, inputs) = match element.component {
        Component::Actor(id) | Component::Computation(id) => {
            let template = graph.template(id);
            let kind = match element.component {
                Component::Actor(_) => Kind::Actor,
                _ => Kind::Computation,
            };
            let states = template.outcomes.iter().map(|state| state.name.clone()).collect();
            let inputs = template.inputs.iter().map(|port| port.name.clone()).collect();
            (kind, template.name.clone(), states, inputs)
        }
        Component::SubPlan(id) => {
            let child = graph.plan(id);
            let inputs = child.entries.iter().filter(|entry| entry.kind == EntryKind::In);
            let inputs = inputs.map(|entry| entry.name.clone()).collect();
            let states = vec!["OK".to_owned(), "Interrupted".to_owned()];
            (Kind::SubPlan, child.name.clone(), states, inputs)
        }
    };
    let targets = element.states.iter().map(|state| target(plan, *state));
    ComponentNames {
        path: format!("{prefix}{}", element.name),
        kind,
        template,
        outcomes: states.into_iter().zip(targets).collect(),
        special: target(plan, element.on_error),
        inputs,
    }
}

fn supervisor(graph: &Graph, plan: &Plan, index: usize, prefix: &str) -> ComponentNames {
    let supervisor = &plan.supervisors[index];
    let template = graph.template(supervisor.template);
    let owner = supervisor.owner.map(|id| format!("{}.", plan.elements[id.index()].name));
    let targets = supervisor.events.iter().map(|event| target(plan, Some(*event)));
    ComponentNames {
        path: format!("{prefix}{}{}", owner.unwrap_or_default(), supervisor.name),
        kind: Kind::Supervisor,
        template: template.name.clone(),
        outcomes: template.outcomes.iter().map(|event| event.name.clone()).zip(targets).collect(),
        special: target(plan, supervisor.on_miss),
        inputs: template.inputs.iter().map(|port| port.name.clone()).collect(),
    }
}

/// A target as the text names it.
fn target(plan: &Plan, target: Option<Target>) -> String {
    match target {
        Some(Target::Element(id)) => plan.elements[id.index()].name.clone(),
        Some(Target::Terminate) => "terminate".to_owned(),
        Some(Target::Fail(_)) => "fail".to_owned(),
        Some(Target::Ignore) => "ignore".to_owned(),
        Some(Target::Resume) => "resume".to_owned(),
        None => String::new(),
    }
}
