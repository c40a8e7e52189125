//! The components and entries of a scenario's plan as in the graph, with all sub-plans.

use super::resolve::{Resolver, Walk};
use crate::graph::{Component, ElementId, EntryId, Graph, Plan, PlanId, SupervisorId, Target};
use crate::scenario::Outcome;
use crate::toolbox::OutPort;
use afp_syntax::ast::Name;
use afp_syntax::diagnostics::Diagnostic;
use afp_syntax::source::Span;

pub(super) use super::resolve::Part;

pub(super) struct Paths<'a> {
    pub graph: &'a Graph,
    pub names: Resolver<'a>,
    /// The plan's index in [`crate::check::Program::plans`].
    pub main: usize,
}

/// One plan or sub-plan with its first numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Instance {
    /// Index in [`crate::check::Program::plans`].
    plan_index: usize,
    plan: PlanId,
    /// Number of its first element.
    components: u32,
    /// Number of its first entry.
    entries: u32,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Found {
    /// Its plan.
    pub instance: Instance,
    pub part: Part,
}

impl Instance {
    pub fn plan(self) -> PlanId {
        self.plan
    }

    /// The plan's index in [`crate::check::Program::plans`].
    pub fn plan_index(self) -> usize {
        self.plan_index
    }
}

impl<'a> Paths<'a> {
    pub fn new(graph: &'a Graph, names: Resolver<'a>, main: usize) -> Self {
        Paths { graph, names, main }
    }

    pub fn main(&self) -> Instance {
        Instance { plan_index: self.main, plan: self.graph.main, components: 1, entries: 0 }
    }

    fn plan(&self, instance: Instance) -> &'a Plan {
        self.graph.plan(instance.plan)
    }

    /// Finds the component of the first names; returns the remaining names.
    ///
    /// # Errors
    /// There is none.
    pub fn find<'n>(
        &self,
        instance: Instance,
        names: &'n [Name],
    ) -> Result<(Found, &'n [Name]), Box<Diagnostic>> {
        self.arrived(instance, self.names.component(instance.plan_index, names), names)
    }

    /// Finds the end of a walk from `instance`; returns the remaining names.
    ///
    /// # Errors
    /// There is nothing.
    pub fn arrived<'n>(
        &self,
        instance: Instance,
        walk: Walk<Part>,
        names: &'n [Name],
    ) -> Result<(Found, &'n [Name]), Box<Diagnostic>> {
        let instance = self.enter(instance, &walk);
        let part = walk.end?;
        Ok((Found { instance, part }, &names[walk.trail.len().min(names.len())..]))
    }

    /// The plan at the end of a walk from `instance`.
    fn enter<T>(&self, mut instance: Instance, walk: &Walk<T>) -> Instance {
        for id in &walk.entered {
            let element = &self.plan(instance).elements[id.index()];
            let Component::SubPlan(inner) = element.component else { break };
            let child = self.graph.rows(instance.plan).elements[id.index()].child;
            instance = Instance {
                plan_index: walk.plan,
                plan: inner,
                components: instance.components + child.components,
                entries: instance.entries + child.entries,
            };
        }
        instance
    }

    /// The number of the named entry, and its declaration.
    ///
    /// # Errors
    /// There is none.
    pub fn entry(&self, names: &[Name]) -> Result<(u32, PlanId, EntryId), Box<Diagnostic>> {
        let walk = self.names.entry(self.main, names);
        let instance = self.enter(self.main(), &walk);
        let index = u16::try_from(walk.end?).unwrap_or(u16::MAX);
        Ok((instance.entries + u32::from(index), instance.plan, EntryId(index)))
    }

    /// Components of the outermost plan with dotted names.
    pub fn components(&self) -> impl Iterator<Item = (String, Found)> {
        self.components_of(self.main())
    }

    /// The sub-plan of an element.
    pub fn inside(&self, found: Found) -> Option<Instance> {
        let Part::Element(id) = found.part else { return None };
        let names = &self.names;
        let plan_index = names.sub_plan(found.instance.plan_index, id)?;
        let walk = Walk { trail: Vec::new(), entered: vec![id], plan: plan_index, end: Ok(()) };
        Some(self.enter(found.instance, &walk))
    }

    /// Components of a plan with dotted names relative to it.
    pub fn components_of(&self, instance: Instance) -> impl Iterator<Item = (String, Found)> {
        let plan = self.plan(instance);
        let elements = (0..).map(ElementId).zip(&plan.elements);
        let elements = elements.map(move |(id, each)| {
            (each.name.clone(), Found { instance, part: Part::Element(id) })
        });
        let supervisors = (0..).map(SupervisorId).zip(&plan.supervisors);
        let supervisors = supervisors.map(move |(id, each)| {
            let owner = each.owner.and_then(|owner| plan.elements.get(owner.index()));
            let owner = owner.map_or(String::new(), |owner| format!("{}.", owner.name));
            (format!("{owner}{}", each.name), Found { instance, part: Part::Supervisor(id) })
        });
        supervisors.chain(elements)
    }

    pub fn number(&self, found: Found) -> u32 {
        let plan = self.plan(found.instance);
        found.instance.components
            + match found.part {
                Part::Element(id) => u32::from(id.0),
                Part::Supervisor(id) => plan.elements.len() as u32 + u32::from(id.0),
            }
    }

    /// The numbers of entries that the component's outputs write.
    pub fn written(&self, found: Found) -> Vec<u32> {
        let plan = self.plan(found.instance);
        let outputs = match found.part {
            Part::Element(id) => &plan.elements[id.index()].outputs,
            Part::Supervisor(id) => &plan.supervisors[id.index()].outputs,
        };
        outputs.iter().map(|output| found.instance.entries + u32::from(output.entry.0)).collect()
    }

    pub fn name(&self, found: Found) -> &'a str {
        let plan = self.plan(found.instance);
        match found.part {
            Part::Element(id) => &plan.elements[id.index()].name,
            Part::Supervisor(id) => &plan.supervisors[id.index()].name,
        }
    }

    pub fn supervisors(&self, found: Found) -> Vec<&'a str> {
        let Part::Element(id) = found.part else { return Vec::new() };
        let plan = self.plan(found.instance);
        let own = plan.elements[id.index()].supervisors.iter();
        own.map(|id| plan.supervisors[id.index()].name.as_str()).collect()
    }

    /// The component of an element; `None` for a supervisor.
    pub fn component(&self, found: Found) -> Option<Component> {
        match found.part {
            Part::Element(id) => Some(self.plan(found.instance).elements[id.index()].component),
            Part::Supervisor(_) => None,
        }
    }

    pub fn outcomes(&self, found: Found) -> Vec<&'a str> {
        self.names.outcomes(found.instance.plan_index, found.part)
    }

    /// The name of its implicit outcome.
    pub fn special(&self, found: Found) -> &'static str {
        Resolver::special(found.part)
    }

    pub fn outcome(&self, found: Found, name: &str) -> Option<Outcome> {
        self.names.outcome(found.instance.plan_index, found.part, name)
    }

    /// The target of a state or event; `None` if unconnected.
    pub fn target(&self, found: Found, outcome: Outcome) -> Option<Target> {
        let plan = self.plan(found.instance);
        match (found.part, outcome) {
            (Part::Element(id), Outcome::Declared(index)) => {
                plan.elements[id.index()].states.get(usize::from(index)).copied().flatten()
            }
            (Part::Element(id), Outcome::Special) => plan.elements[id.index()].on_error,
            (Part::Supervisor(id), Outcome::Declared(index)) => {
                plan.supervisors[id.index()].events.get(usize::from(index)).copied()
            }
            (Part::Supervisor(id), Outcome::Special) => plan.supervisors[id.index()].on_miss,
        }
    }

    /// The target while an element of the same plan is active, which may react itself.
    pub fn target_at(&self, found: Found, outcome: Outcome, active: Found) -> Option<Target> {
        let own = self.target(found, outcome);
        let (Part::Supervisor(id), Part::Element(element)) = (found.part, active.part) else {
            return own;
        };
        if found.instance != active.instance {
            return own;
        }
        let element = &self.plan(found.instance).elements[element.index()];
        let here = element.reactions_to(id).and_then(|table| table.target(event(outcome)));
        here.or(own)
    }

    pub fn targets(&self, found: Found, outcome: Outcome) -> Vec<Target> {
        let own = self.target(found, outcome);
        let Part::Supervisor(id) = found.part else { return own.into_iter().collect() };
        let others = self.plan(found.instance).reacting(id);
        let others = others.filter_map(|(_, table)| table.target(event(outcome)));
        own.into_iter().chain(others).collect()
    }

    /// The place of an outcome's edge, or else of the component.
    pub fn edge(&self, found: Found, outcome: Outcome) -> Span {
        let plan = self.plan(found.instance);
        let (edges, span) = match found.part {
            Part::Element(id) => {
                let element = &plan.elements[id.index()];
                (&element.edges, element.span)
            }
            Part::Supervisor(id) => {
                let supervisor = &plan.supervisors[id.index()];
                (&supervisor.edges, supervisor.span)
            }
        };
        let edge = match outcome {
            Outcome::Declared(index) => edges.outcomes.get(usize::from(index)).copied().flatten(),
            Outcome::Special => edges.extra,
        };
        edge.unwrap_or(span)
    }

    /// All causes that can end an element: itself, its supervisors, the global ones of its plan.
    pub fn causes(&self, element: Found) -> Vec<(Found, Outcome)> {
        let Part::Element(id) = element.part else { return Vec::new() };
        let plan = self.plan(element.instance);
        let locals = plan.elements[id.index()].supervisors.iter().copied();
        let globals = (0..plan.globals).map(SupervisorId);
        let supervisors = locals.chain(globals);
        let all = supervisors
            .map(|id| Found { instance: element.instance, part: Part::Supervisor(id) })
            .chain([element]);
        all.flat_map(|found| {
            let declared = 0..u16::try_from(self.outcomes(found).len()).unwrap_or(0);
            declared.map(Outcome::Declared).chain([Outcome::Special]).map(move |o| (found, o))
        })
        .collect()
    }

    /// The first supervisor with that name of another element of the same plan, and that element's
    /// name.
    pub fn of_another(&self, element: Found, name: &str) -> Option<(Span, &'a str)> {
        let plan = self.plan(element.instance);
        plan.elements.iter().find_map(|other| {
            let own = other.supervisors.iter().map(|id| &plan.supervisors[id.index()]);
            let found = own.into_iter().find(|supervisor| supervisor.name == name)?;
            Some((found.span, other.name.as_str()))
        })
    }

    /// The connected outputs of an outcome, see [`outputs`].
    pub fn outputs(
        &self,
        found: Found,
        outcome: u16,
    ) -> Vec<(u16, &'a OutPort, crate::types::Type)> {
        outputs(self.graph, found.instance.plan, found.part, outcome)
    }
}

/// The event of a supervisor; `None` for its `DeadlineMissed`.
fn event(outcome: Outcome) -> Option<u16> {
    match outcome {
        Outcome::Declared(event) => Some(event),
        Outcome::Special => None,
    }
}

/// The connected outputs of an outcome, each with its index and its value's type.
pub(super) fn outputs(
    graph: &Graph,
    plan: PlanId,
    part: Part,
    outcome: u16,
) -> Vec<(u16, &OutPort, crate::types::Type)> {
    let plan = graph.plan(plan);
    let (template, outputs, generic) = match part {
        Part::Element(id) => {
            let element = &plan.elements[id.index()];
            let (Component::Actor(template) | Component::Computation(template)) = element.component
            else {
                return Vec::new();
            };
            (template, &element.outputs, &element.generic)
        }
        Part::Supervisor(id) => {
            let supervisor = &plan.supervisors[id.index()];
            (supervisor.template, &supervisor.outputs, &supervisor.generic)
        }
    };
    let ports = &graph.template(template).outputs;
    outputs
        .iter()
        .filter_map(|output| {
            let port = ports.get(usize::from(output.port))?;
            let ty = match (&port.ty, generic) {
                (
                    crate::types::Type::Any
                    | crate::types::Type::Number
                    | crate::types::Type::Discrete,
                    Some(ty),
                ) => ty.clone(),
                (ty, _) => ty.clone(),
            };
            port.on.contains(&outcome).then_some((output.port, port, ty))
        })
        .collect()
}

/// The component with a dotted path in the trace.
pub(super) fn by_path(graph: &Graph, path: &str) -> Option<(PlanId, Part)> {
    let mut id = graph.main;
    let mut names = path.split('.');
    loop {
        let (name, plan) = (names.next()?, graph.plan(id));
        let Some(element) = (0..).zip(&plan.elements).find(|(_, each)| each.name == name) else {
            let globals = (0..plan.globals).zip(&plan.supervisors);
            let found = { globals }.find(|(_, each)| each.name == name)?;
            let part = Part::Supervisor(SupervisorId(found.0));
            return names.next().is_none().then_some((id, part));
        };
        let (at, element) = (ElementId(element.0), element.1);
        let mut rest = names.clone();
        let Some(next) = rest.next() else { return Some((id, Part::Element(at))) };
        let own = element.supervisors.iter();
        let local = { own }.find(|id| plan.supervisors[id.index()].name == next);
        match (local, element.component) {
            (Some(local), _) => {
                return rest.next().is_none().then_some((id, Part::Supervisor(*local)));
            }
            (None, Component::SubPlan(inner)) => id = inner,
            (None, _) => return None,
        }
    }
}
