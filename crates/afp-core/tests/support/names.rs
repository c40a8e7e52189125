//! The names of a plan built from data, with its sub-plans.

use afp_core::rt::ElementKind;
use afp_core::trace::{
    ComponentId, ComponentKind, ComponentName, EntryKind, EntryName, Names, Outcome, Reaction,
    TraceEntryId,
};

use super::build::{ElementSpec, Spec};

#[derive(Default)]
pub struct SpecNames {
    components: Vec<Component>,
    entries: Vec<(String, EntryKind)>,
}

struct Component {
    path: String,
    kind: ComponentKind,
    outcomes: Vec<(String, String)>,
    special: (&'static str, &'static str),
    /// Supervisor, event and target.
    reactions: Vec<(ComponentId, u16, &'static str)>,
}

impl SpecNames {
    pub fn new(spec: &Spec) -> Self {
        let mut names = SpecNames::default();
        names.components.push(Component {
            path: spec.name.clone(),
            kind: ComponentKind::Plan,
            outcomes: Vec::new(),
            special: ("", ""),
            reactions: Vec::new(),
        });
        names.add(spec, "");
        names
    }

    fn add(&mut self, spec: &Spec, prefix: &str) {
        let supervisors = self.components.len() + spec.elements.len();
        for entry in &spec.entries {
            self.entries.push((format!("{prefix}{}", entry.name), entry.kind));
        }
        for (index, element) in spec.elements.iter().enumerate() {
            let kind = match element.kind {
                ElementKind::Actor => ComponentKind::Actor,
                ElementKind::Computation => ComponentKind::Computation,
                ElementKind::SubPlan => ComponentKind::SubPlan,
            };
            self.components.push(Component {
                path: format!("{prefix}{}", element.name),
                kind,
                outcomes: owned(&element.states),
                special: ("Error", spec.error_target(index)),
                reactions: reactions(spec, element, supervisors),
            });
        }
        for (index, guard) in spec.supervisors.iter().enumerate() {
            let owner = spec.owner(index as u16).map(|owner| spec.elements[owner].name);
            let path = match owner {
                Some(owner) => format!("{prefix}{owner}.{}", guard.name),
                None => format!("{prefix}{}", guard.name),
            };
            self.components.push(Component {
                path,
                kind: ComponentKind::Supervisor,
                outcomes: owned(&guard.events),
                special: ("DeadlineMissed", spec.miss_target(index)),
                reactions: Vec::new(),
            });
        }
        for element in &spec.elements {
            if let Some(plan) = &element.plan {
                self.add(plan, &format!("{prefix}{}.", element.name));
            }
        }
    }

    fn get(&self, id: ComponentId) -> &Component {
        &self.components[id.0 as usize]
    }
}

fn owned(outcomes: &[(&str, &str)]) -> Vec<(String, String)> {
    outcomes.iter().map(|(name, target)| ((*name).to_owned(), (*target).to_owned())).collect()
}

/// The reactions of an element; `first` is the id of the plan's first supervisor.
fn reactions(
    spec: &Spec,
    element: &ElementSpec,
    first: usize,
) -> Vec<(ComponentId, u16, &'static str)> {
    let reaction = |(guard, event, to): &(&str, &str, &'static str)| {
        let guards = &spec.supervisors[..usize::from(spec.globals)];
        let index = guards.iter().position(|it| it.name == *guard).expect("a global supervisor");
        let event = guards[index].events.iter().position(|it| it.0 == *event).expect("an event");
        (ComponentId((first + index) as u32), event as u16, *to)
    };
    element.reactions.iter().map(reaction).collect()
}

impl Names for SpecNames {
    fn components(&self) -> u32 {
        self.components.len() as u32
    }

    fn component(&self, id: ComponentId) -> ComponentName<'_> {
        let component = self.get(id);
        ComponentName { path: &component.path, kind: component.kind, template: "" }
    }

    fn outcome(&self, id: ComponentId, outcome: Outcome) -> &str {
        match outcome {
            Outcome::Declared(at) => &self.get(id).outcomes[usize::from(at)].0,
            _ => self.get(id).special.0,
        }
    }

    fn target(&self, id: ComponentId, outcome: Outcome) -> &str {
        match outcome {
            Outcome::Declared(at) => &self.get(id).outcomes[usize::from(at)].1,
            _ => self.get(id).special.1,
        }
    }

    fn reaction(&self, element: ComponentId, n: u16) -> Option<Reaction<'_>> {
        let (supervisor, event, to) = *self.get(element).reactions.get(usize::from(n))?;
        Some(Reaction::new(supervisor, Some(event), to))
    }

    fn input(&self, _: ComponentId, _: u16) -> &str {
        ""
    }

    fn entries(&self) -> u32 {
        self.entries.len() as u32
    }

    fn entry(&self, id: TraceEntryId) -> EntryName<'_> {
        let (path, kind) = &self.entries[id.0 as usize];
        EntryName { path, kind: *kind, ty: "int", unit: "", range: None }
    }

    fn choice(&self, _: TraceEntryId, _: u16) -> &str {
        ""
    }
}
