//! The components of a plan by number, each with its facts from the graph.

mod usage;

use afp_core::Text;
use afp_dsl::graph::{
    Component, Element, ElementId, Graph, Output, Plan, PlanId, Supervisor, SupervisorId,
    TemplateId,
};
use afp_dsl::scenario::{Injection, Outcome};
use afp_dsl::toolbox::{Constant, OutPort};
use afp_dsl::types::Type;
use afp_dsl::unfold::{Goal, Place, Unfolded, places, unfold};

/// A plan by the numbers of its components.
pub(crate) struct Parts<'a> {
    graph: &'a Graph,
    names: Unfolded,
    places: Vec<Place>,
    parts: Vec<Part>,
    /// The plan and its sub-plans.
    homes: Vec<Part>,
}

/// The place of a component in the graph.
#[derive(Clone, Copy)]
struct Part {
    plan: PlanId,
    what: What,
    /// The number of its plan's first entry.
    entries: u32,
    /// The number of its plan.
    home: u32,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum What {
    Plan,
    Element(ElementId),
    Supervisor(SupervisorId),
}

impl<'a> Parts<'a> {
    pub(crate) fn new(graph: &'a Graph) -> Self {
        let main = Part { plan: graph.main, what: What::Plan, entries: 0, home: 0 };
        let mut parts = vec![main];
        let mut homes = Vec::new();
        add(graph, main, &mut parts, &mut homes);
        Parts { graph, names: unfold(graph), places: places(graph), parts, homes }
    }

    /// The number of each entry's plan.
    pub(crate) fn entry_homes(&self) -> Vec<u32> {
        let mut all = Vec::new();
        for home in &self.homes {
            let count = self.graph.plan(home.plan).entries.len();
            all.extend(std::iter::repeat_n(home.home, count));
        }
        all
    }

    /// The elements of the plan and of its sub-plans.
    pub(crate) fn elements(&self) -> impl Iterator<Item = u32> {
        let parts = (0..).zip(&self.parts);
        parts.filter(|(_, part)| matches!(part.what, What::Element(_))).map(|(number, _)| number)
    }

    fn part(&self, number: u32) -> Option<(&Plan, &Part)> {
        let part = self.parts.get(number as usize)?;
        Some((self.graph.plan(part.plan), part))
    }

    fn element(&self, number: u32) -> Option<&Element> {
        match self.part(number)? {
            (plan, Part { what: What::Element(id), .. }) => plan.elements.get(id.index()),
            _ => None,
        }
    }

    pub(crate) fn supervisor(&self, number: u32) -> Option<&Supervisor> {
        match self.part(number)? {
            (plan, Part { what: What::Supervisor(id), .. }) => plan.supervisors.get(id.index()),
            _ => None,
        }
    }

    /// The graph's component of an element.
    pub(crate) fn component(&self, number: u32) -> Option<Component> {
        self.element(number).map(|element| element.component)
    }

    /// The time from the interruption of an actor until it has stopped, if its template declares
    /// one.
    pub(crate) fn stop(&self, number: u32) -> Option<u64> {
        match self.component(number)? {
            Component::Actor(id) => self.graph.template(id).stop,
            Component::Computation(_) | Component::SubPlan(_) => None,
        }
    }

    /// Its dotted name.
    pub(crate) fn path(&self, number: u32) -> &str {
        self.names.components.get(number as usize).map_or("", |names| &names.path)
    }

    /// The name after the last dot.
    pub(crate) fn name(&self, number: u32) -> &str {
        self.path(number).rsplit('.').next().unwrap_or("")
    }

    /// The name of a state or event.
    pub(crate) fn outcome(&self, number: u32, outcome: u16) -> &str {
        let names = self.names.components.get(number as usize);
        let outcome = names.and_then(|names| names.outcomes.get(usize::from(outcome)));
        outcome.map_or("", |(name, _)| name)
    }

    /// The dotted name of an entry.
    pub(crate) fn entry(&self, number: u32) -> &str {
        self.names.entries.get(number as usize).map_or("", |entry| &entry.path)
    }

    /// The place of a component in the plan.
    pub(crate) fn place(&self, number: u32) -> Option<&Place> {
        self.places.get(number as usize)
    }

    /// The target of an outcome.
    pub(crate) fn goal(&self, number: u32, outcome: u16) -> Option<Goal> {
        *self.place(number)?.outcomes.get(usize::from(outcome))?
    }

    /// The target of an element's `Error`.
    pub(crate) fn goal_of_error(&self, element: u32) -> Option<Goal> {
        self.place(element)?.special
    }

    /// The target of a supervisor's event during an element of the same plan.
    pub(crate) fn goal_at(&self, element: u32, supervisor: u32, event: u16) -> Option<Goal> {
        let here = self.place(element)?.reaction(supervisor, Some(event));
        here.or_else(|| self.goal(supervisor, event))
    }

    /// The supervisors that can end an element: its own and those of its plan.
    pub(crate) fn supervisors_over(&self, element: u32) -> Vec<u32> {
        let Some(home) = self.place(element).map(|place| place.plan) else { return Vec::new() };
        let over = |(number, place): (u32, &Place)| {
            let here = place.plan == home && place.owner.is_none_or(|owner| owner == element);
            (here && self.supervisor(number).is_some()).then_some(number)
        };
        (0..).zip(&self.places).filter_map(over).collect()
    }

    /// Whether `inner` is `outer` or a part of it.
    pub(crate) fn is_within(&self, inner: u32, outer: u32) -> bool {
        let mut number = inner;
        loop {
            match self.place(number) {
                _ if number == outer => return true,
                Some(place) if place.plan != number => number = place.plan,
                _ => return false,
            }
        }
    }

    fn outputs(&self, number: u32) -> &[Output] {
        match (self.element(number), self.supervisor(number)) {
            (Some(element), _) => &element.outputs,
            (_, Some(supervisor)) => &supervisor.outputs,
            _ => &[],
        }
    }

    /// All entries that a component writes, by number.
    pub(crate) fn written(&self, number: u32) -> Vec<u32> {
        let first = self.part(number).map_or(0, |(_, part)| part.entries);
        self.outputs(number).iter().map(|out| first + u32::from(out.entry.0)).collect()
    }

    /// The connected outputs that an actor or supervisor writes with an outcome: the entry, and the
    /// port with the type of its value.
    pub(crate) fn brought(&self, number: u32, outcome: u16) -> Vec<(u32, u16, &OutPort, Type)> {
        let Some((template, generic)) = self.template(number) else { return Vec::new() };
        let ports = &self.graph.template(template).outputs;
        let first = self.part(number).map_or(0, |(_, part)| part.entries);
        let with_port = |out: &Output| {
            let port = ports.get(usize::from(out.port))?;
            let ty = match (&port.ty, generic) {
                (Type::Any | Type::Number | Type::Discrete, Some(ty)) => ty.clone(),
                (ty, _) => ty.clone(),
            };
            let entry = first + u32::from(out.entry.0);
            port.on.contains(&outcome).then_some((entry, out.port, port, ty))
        };
        self.outputs(number).iter().filter_map(with_port).collect()
    }

    fn template(&self, number: u32) -> Option<(TemplateId, Option<&Type>)> {
        if let Some(supervisor) = self.supervisor(number) {
            return Some((supervisor.template, supervisor.generic.as_ref()));
        }
        let element = self.element(number)?;
        match element.component {
            Component::Actor(id) => Some((id, element.generic.as_ref())),
            Component::Computation(_) | Component::SubPlan(_) => None,
        }
    }

    /// An outcome to inject, with zeros for its values, and its text in a scenario; `None` if a
    /// value is an object.
    pub(crate) fn injection(&self, number: u32, outcome: u16) -> Option<(Injection, String)> {
        let (mut outputs, mut texts) = (Vec::new(), Vec::new());
        for (_, place, port, ty) in self.brought(number, outcome) {
            let (value, text) = zero(&ty)?;
            outputs.push((place, value));
            texts.push(format!("{} = {text}", port.name));
        }
        let verb = if self.supervisor(number).is_some() { "fire" } else { "finish" };
        let values =
            if texts.is_empty() { String::new() } else { format!("({})", texts.join(", ")) };
        let text =
            format!("{verb} {}.{}{values}", self.path(number), self.outcome(number, outcome));
        let outcome = Outcome::Declared(outcome);
        Some((Injection { component: number, outcome, outputs }, text))
    }

    /// The `Error` of an element to inject, and its text in a scenario.
    pub(crate) fn failure(&self, number: u32) -> (Injection, String) {
        let text = format!("fire {}.Error", self.path(number));
        (Injection { component: number, outcome: Outcome::Special, outputs: Vec::new() }, text)
    }
}

fn add(graph: &Graph, home: Part, parts: &mut Vec<Part>, homes: &mut Vec<Part>) {
    homes.push(home);
    let plan = graph.plan(home.plan);
    let part = |what| Part { what, ..home };
    let first = parts.len() as u32;
    parts.extend((0..plan.elements.len()).map(|id| part(What::Element(ElementId(id as u16)))));
    parts.extend(
        (0..plan.supervisors.len()).map(|id| part(What::Supervisor(SupervisorId(id as u16)))),
    );
    let rows = &graph.rows(home.plan).elements;
    for ((element, row), number) in plan.elements.iter().zip(rows).zip(first..) {
        if let Component::SubPlan(child) = element.component {
            let entries = home.entries + row.child.entries;
            let inner = Part { plan: child, what: What::Plan, entries, home: number };
            add(graph, inner, parts, homes);
        }
    }
}

/// A value of a type, and its text; `None` for an object.
fn zero(ty: &Type) -> Option<(Constant, String)> {
    Some(match ty {
        Type::Bool => (Constant::Bool(false), "false".to_owned()),
        Type::Int => (Constant::Int(0), "0".to_owned()),
        Type::Quantity(dimension) => {
            let text = format!("0.0 {}", dimension.usual_unit()).trim_end().to_owned();
            (Constant::Float(0.0), text)
        }
        Type::Text => (Constant::Text(Text::new()), "\"\"".to_owned()),
        Type::Enum(home) => {
            (Constant::Choice(0), format!("{}.{}", home.name, home.variants.first()?))
        }
        Type::Object(_) | Type::Any | Type::Number | Type::Discrete => return None,
    })
}
