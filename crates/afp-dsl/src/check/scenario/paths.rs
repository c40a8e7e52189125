//! What the dotted names of a scenario mean: components of the plan, sub-plans unfolded.

use crate::check::names::unknown;
use crate::graph::{Component, ElementId, EntryId, Graph, PlanId, SupervisorId, Target};
use crate::scenario::Outcome;
use crate::toolbox::OutPort;
use afp_syntax::ast::Name;
use afp_syntax::diagnostics::{Code, Diagnostic};
use afp_syntax::source::Span;

/// The plan of a scenario, by names.
pub(super) struct Paths<'a> {
    /// Its graph.
    pub graph: &'a Graph,
}

/// One plan or sub-plan at its place among the numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Home {
    plan: PlanId,
    /// The number of its first element.
    components: u32,
    /// The number of its first entry.
    entries: u32,
}

/// A component.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Found {
    /// The plan that it belongs to.
    pub home: Home,
    /// What it is.
    pub part: Part,
}

/// An element or a supervisor of a plan.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Part {
    Element(ElementId),
    Supervisor(SupervisorId),
}

impl Home {
    /// The plan.
    pub fn plan(self) -> PlanId {
        self.plan
    }
}

impl<'a> Paths<'a> {
    pub fn new(graph: &'a Graph) -> Self {
        Paths { graph }
    }

    /// The plan that runs.
    pub fn main(&self) -> Home {
        Home { plan: self.graph.main, components: 1, entries: 0 }
    }

    /// The plan of an element that is a sub-plan.
    fn inside(&self, home: Home, element: usize, plan: PlanId) -> Home {
        let child = self.graph.rows(home.plan).elements[element].child;
        Home {
            plan,
            components: home.components + child.components,
            entries: home.entries + child.entries,
        }
    }

    /// The component that the first of the names mean, and the names that are left.
    ///
    /// # Errors
    /// There is none.
    pub fn find<'n>(
        &self,
        mut home: Home,
        mut names: &'n [Name],
    ) -> Result<(Found, &'n [Name]), Box<Diagnostic>> {
        loop {
            let [name, rest @ ..] = names else { return Err(Self::empty()) };
            let Some(found) = self.part(home, &name.text) else {
                return Err(self.unknown_part(home, name));
            };
            let Part::Element(id) = found.part else { return Ok((found, rest)) };
            let Some(next) = rest.first() else { return Ok((found, rest)) };
            if let Some(local) = self.local(found, &next.text) {
                return Ok((local, &rest[1..]));
            }
            let element = &self.graph.plan(home.plan).elements[id.index()];
            let Component::SubPlan(inner) = element.component else { return Ok((found, rest)) };
            if self.outcome(found, &next.text).is_some() {
                return Ok((found, rest));
            }
            home = self.inside(home, id.index(), inner);
            names = rest;
        }
    }

    /// The entry that names mean, by its number, and where it is declared.
    ///
    /// # Errors
    /// There is none.
    pub fn entry(&self, names: &[Name]) -> Result<(u32, PlanId, EntryId), Box<Diagnostic>> {
        let mut home = self.main();
        let mut names = names;
        loop {
            let [name, rest @ ..] = names else { return Err(Self::empty()) };
            let plan = self.graph.plan(home.plan);
            let inner = plan.elements.iter().position(|element| element.name == name.text);
            if let (Some(place), false) = (inner, rest.is_empty())
                && let Component::SubPlan(inner) = plan.elements[place].component
            {
                home = self.inside(home, place, inner);
                names = rest;
                continue;
            }
            let entry = plan.entries.iter().position(|entry| entry.name == name.text);
            let Some(place) = entry.and_then(|place| u16::try_from(place).ok()) else {
                let message = format!("'{}' has no entry '{}'", plan.name, name.text);
                let known = plan.entries.iter().map(|entry| entry.name.as_str());
                let none = "declare it in the plan";
                let error = unknown(Code::E0209, name.span, message, &name.text, known, none);
                return Err(Box::new(error));
            };
            if let Some(more) = rest.first() {
                let message = format!("'{}' is an entry and has no parts", name.text);
                let error = Diagnostic::new(Code::E0209, more.span, message);
                return Err(Box::new(error.help(format!("write '{}'", name.text))));
            }
            return Ok((home.entries + u32::from(place), home.plan, EntryId(place)));
        }
    }

    /// An element or global supervisor of a plan.
    fn part(&self, home: Home, name: &str) -> Option<Found> {
        let plan = self.graph.plan(home.plan);
        let element = plan.elements.iter().position(|element| element.name == name);
        let globals = || plan.supervisors.iter().take(usize::from(plan.globals));
        let part = match element {
            Some(place) => Part::Element(ElementId(u16::try_from(place).ok()?)),
            None => {
                let place = globals().position(|supervisor| supervisor.name == name)?;
                Part::Supervisor(SupervisorId(u16::try_from(place).ok()?))
            }
        };
        Some(Found { home, part })
    }

    /// A local supervisor of an element.
    pub fn local(&self, element: Found, name: &str) -> Option<Found> {
        let Part::Element(id) = element.part else { return None };
        let plan = self.graph.plan(element.home.plan);
        let locals = &plan.elements[id.index()].supervisors;
        let id = *locals.iter().find(|id| plan.supervisors[id.index()].name == name)?;
        Some(Found { home: element.home, part: Part::Supervisor(id) })
    }

    fn unknown_part(&self, home: Home, name: &Name) -> Box<Diagnostic> {
        let plan = self.graph.plan(home.plan);
        let elements = plan.elements.iter().map(|element| element.name.as_str());
        let globals = plan.supervisors.iter().take(usize::from(plan.globals));
        let known = elements.chain(globals.map(|supervisor| supervisor.name.as_str()));
        let message = format!("'{}' has no element or supervisor '{}'", plan.name, name.text);
        Box::new(unknown(Code::E0602, name.span, message, &name.text, known, "write another name"))
    }

    fn empty() -> Box<Diagnostic> {
        let error = Diagnostic::new(Code::E0602, Span::default(), "the name is missing");
        Box::new(error.help("write the name of an element or supervisor"))
    }

    /// The number of a component.
    pub fn number(&self, found: Found) -> u32 {
        let plan = self.graph.plan(found.home.plan);
        found.home.components
            + match found.part {
                Part::Element(id) => u32::from(id.0),
                Part::Supervisor(id) => plan.elements.len() as u32 + u32::from(id.0),
            }
    }

    /// The entries that the component's outputs lead to, by their numbers.
    pub fn written(&self, found: Found) -> Vec<u32> {
        let plan = self.graph.plan(found.home.plan);
        let outputs = match found.part {
            Part::Element(id) => &plan.elements[id.index()].outputs,
            Part::Supervisor(id) => &plan.supervisors[id.index()].outputs,
        };
        outputs.iter().map(|output| found.home.entries + u32::from(output.entry.0)).collect()
    }

    /// The component's name.
    pub fn name(&self, found: Found) -> &'a str {
        let plan = self.graph.plan(found.home.plan);
        match found.part {
            Part::Element(id) => &plan.elements[id.index()].name,
            Part::Supervisor(id) => &plan.supervisors[id.index()].name,
        }
    }

    /// What an element is made from; `None` for a supervisor.
    pub fn component(&self, found: Found) -> Option<Component> {
        match found.part {
            Part::Element(id) => {
                Some(self.graph.plan(found.home.plan).elements[id.index()].component)
            }
            Part::Supervisor(_) => None,
        }
    }

    /// The names of the component's states or events.
    pub fn outcomes(&self, found: Found) -> Vec<&'a str> {
        let template = match (self.component(found), found.part) {
            (Some(Component::SubPlan(_)), _) => return vec!["OK", "Interrupted"],
            (Some(Component::Actor(id) | Component::Computation(id)), _) => id,
            (None, Part::Supervisor(id)) => {
                self.graph.plan(found.home.plan).supervisors[id.index()].template
            }
            (None, Part::Element(_)) => return Vec::new(),
        };
        let outcomes = &self.graph.template(template).outcomes;
        outcomes.iter().map(|outcome| outcome.name.as_str()).collect()
    }

    /// What its undeclared outcome is called.
    pub fn special(&self, found: Found) -> &'static str {
        match found.part {
            Part::Element(_) => "Error",
            Part::Supervisor(_) => "DeadlineMissed",
        }
    }

    /// A state or event of that name.
    pub fn outcome(&self, found: Found, name: &str) -> Option<Outcome> {
        let declared = self.outcomes(found).iter().position(|known| *known == name);
        match declared {
            Some(place) => Some(Outcome::Declared(u16::try_from(place).ok()?)),
            None => (name == self.special(found)).then_some(Outcome::Special),
        }
    }

    /// Where a state or event leads; `None` where it is not connected.
    pub fn target(&self, found: Found, outcome: Outcome) -> Option<Target> {
        let plan = self.graph.plan(found.home.plan);
        match (found.part, outcome) {
            (Part::Element(id), Outcome::Declared(place)) => {
                plan.elements[id.index()].states.get(usize::from(place)).copied().flatten()
            }
            (Part::Element(id), Outcome::Special) => plan.elements[id.index()].on_error,
            (Part::Supervisor(id), Outcome::Declared(place)) => {
                plan.supervisors[id.index()].events.get(usize::from(place)).copied()
            }
            (Part::Supervisor(id), Outcome::Special) => plan.supervisors[id.index()].on_miss,
        }
    }

    /// Where the edge of an outcome stands, or else the component.
    pub fn edge(&self, found: Found, outcome: Outcome) -> Span {
        let plan = self.graph.plan(found.home.plan);
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
            Outcome::Declared(place) => edges.outcomes.get(usize::from(place)).copied().flatten(),
            Outcome::Special => edges.extra,
        };
        edge.unwrap_or(span)
    }

    /// Everything that can end an element: itself, its supervisors, the global ones of its plan.
    pub fn causes(&self, element: Found) -> Vec<(Found, Outcome)> {
        let Part::Element(id) = element.part else { return Vec::new() };
        let plan = self.graph.plan(element.home.plan);
        let locals = plan.elements[id.index()].supervisors.iter().copied();
        let globals = (0..plan.globals).map(SupervisorId);
        let supervisors = locals.chain(globals);
        let all = supervisors
            .map(|id| Found { home: element.home, part: Part::Supervisor(id) })
            .chain([element]);
        all.flat_map(|found| {
            let declared = 0..u16::try_from(self.outcomes(found).len()).unwrap_or(0);
            declared.map(Outcome::Declared).chain([Outcome::Special]).map(move |o| (found, o))
        })
        .collect()
    }

    /// The outputs of a component that an outcome carries and that are connected, each with its
    /// place and the type of its value.
    pub fn outputs(
        &self,
        found: Found,
        outcome: u16,
    ) -> Vec<(u16, &'a OutPort, crate::types::Type)> {
        let plan = self.graph.plan(found.home.plan);
        let (template, outputs, generic) = match found.part {
            Part::Element(id) => {
                let element = &plan.elements[id.index()];
                let (Component::Actor(template) | Component::Computation(template)) =
                    element.component
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
        let ports = &self.graph.template(template).outputs;
        outputs
            .iter()
            .filter_map(|output| {
                let port = ports.get(usize::from(output.port))?;
                let ty = match (&port.ty, generic) {
                    (crate::types::Type::Any | crate::types::Type::Number, Some(ty)) => ty.clone(),
                    (ty, _) => ty.clone(),
                };
                port.on.contains(&outcome).then_some((output.port, port, ty))
            })
            .collect()
    }
}
