//! The components of a running plan in its chart.

use afp_core::trace::{ComponentId, Outcome};
use afp_dsl::graph::{Component, Graph, PlanId, TemplateId};

/// A component of a running plan.
pub struct Place {
    /// The id of its state; for a supervisor that of its owner's state.
    pub state: String,
    /// The prefix of its events.
    pub path: String,
    pub kind: Kind,
    /// Its states or events.
    outcomes: Vec<String>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    Plan,
    Actor,
    Computation,
    SubPlan,
    Supervisor,
}

impl Place {
    pub fn event(&self, outcome: Outcome) -> String {
        let name = match outcome {
            Outcome::DeadlineMissed => "DeadlineMissed",
            Outcome::Declared(position) => {
                self.outcomes.get(usize::from(position)).map_or("", String::as_str)
            }
            Outcome::Error => "",
        };
        format!("{}.{name}", self.path)
    }

    pub fn fault(&self) -> String {
        match self.kind {
            Kind::Plan => ":failed".to_owned(),
            _ => format!("{}.Error", self.path),
        }
    }
}

/// All components, by the numbers of the trace.
pub struct Places(Vec<Place>);

impl Places {
    /// A component.
    ///
    /// # Panics
    /// The plan does not have it.
    pub fn get(&self, id: ComponentId) -> &Place {
        &self.0[id.0 as usize]
    }
}

/// The components of a graph: the outermost plan, its elements, its supervisors, and then those of
/// each of its sub-plans.
pub fn places(graph: &Graph) -> Places {
    let name = graph.main().name.clone();
    let (path, outcomes) = (String::new(), Vec::new());
    let plan = Place { state: name.clone(), path, kind: Kind::Plan, outcomes };
    let mut all = vec![plan];
    add(graph, graph.main, &name, "", &mut all);
    Places(all)
}

fn add(graph: &Graph, plan: PlanId, home: &str, prefix: &str, all: &mut Vec<Place>) {
    let plan = graph.plan(plan);
    let outcomes = |id: TemplateId| {
        let outcomes = graph.template(id).outcomes.iter();
        outcomes.map(|outcome| outcome.name.clone()).collect::<Vec<_>>()
    };
    for element in &plan.elements {
        let (kind, outcomes) = match element.component {
            Component::Actor(id) => (Kind::Actor, outcomes(id)),
            Component::Computation(id) => (Kind::Computation, outcomes(id)),
            Component::SubPlan(_) => (Kind::SubPlan, Vec::new()),
        };
        let (state, path) =
            (format!("{home}.{}", element.name), format!("{prefix}{}", element.name));
        all.push(Place { state, path, kind, outcomes });
    }
    for supervisor in &plan.supervisors {
        let owner = supervisor.owner.map(|owner| &plan.elements[owner.index()].name);
        let (state, path) = match owner {
            Some(owner) => {
                (format!("{home}.{owner}"), format!("{prefix}{owner}-{}", supervisor.name))
            }
            None => (home.to_owned(), format!("{prefix}{}", supervisor.name)),
        };
        let (kind, outcomes) = (Kind::Supervisor, outcomes(supervisor.template));
        all.push(Place { state, path, kind, outcomes });
    }
    for element in &plan.elements {
        if let Component::SubPlan(inner) = element.component {
            let (home, prefix) =
                (format!("{home}.{}", element.name), format!("{prefix}{}:", element.name));
            add(graph, inner, &home, &prefix, all);
        }
    }
}
