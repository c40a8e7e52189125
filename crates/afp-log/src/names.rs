//! An owned copy of a plan's names, for threads that outlive the step that made a record.

use afp_core::trace::{
    ComponentId, ComponentKind, ComponentName, EntryKind, EntryName, Names, Outcome, PortName,
    Reaction, TextPlace, TraceEntryId, declared,
};

use crate::proto::afp::{PlanTable, plan_table};

/// A copy of all names of a plan.
#[derive(Clone, Debug, Default)]
pub struct OwnedNames {
    components: Vec<Component>,
    entries: Vec<Entry>,
}

#[derive(Clone, Debug)]
struct Component {
    path: String,
    kind: ComponentKind,
    template: String,
    /// Name and target of each outcome, then those of `DeadlineMissed` and `Error`.
    outcomes: Vec<(String, String)>,
    missed: (String, String),
    error: (String, String),
    inputs: Vec<Port>,
    outputs: Vec<Port>,
    /// Supervisor and event of each edge that holds instead of theirs, and its target.
    reactions: Vec<(ComponentId, Outcome, String)>,
}

#[derive(Clone, Debug, Default)]
struct Port {
    name: String,
    ty: String,
    /// The values of an enum that an input takes.
    choices: Vec<String>,
    unit: String,
    range: Option<(f64, f64)>,
    entry: Option<String>,
    place: Option<Place>,
}

/// File, line and column.
type Place = (String, u32, u32);

#[derive(Clone, Debug)]
struct Entry {
    path: String,
    kind: EntryKind,
    ty: String,
    unit: String,
    range: Option<(f64, f64)>,
    choices: Vec<String>,
    initial: Option<Place>,
}

impl OwnedNames {
    /// Copies the names of a plan.
    pub fn new(names: &(impl Names + ?Sized)) -> Self {
        let components = (0..names.components()).map(|id| Component::copy(names, ComponentId(id)));
        let entries = (0..names.entries()).map(|id| Entry::copy(names, TraceEntryId(id)));
        OwnedNames { components: components.collect(), entries: entries.collect() }
    }

    /// The names that a log keeps: those of components, not of entries.
    pub(crate) fn from_table(table: &PlanTable) -> Self {
        let outcome =
            |outcome: &plan_table::Outcome| (outcome.name.clone(), outcome.target.clone());
        let component = |row: &plan_table::Component| Component {
            path: row.path.clone(),
            kind: match row.kind() {
                plan_table::Kind::Actor => ComponentKind::Actor,
                plan_table::Kind::Computation => ComponentKind::Computation,
                plan_table::Kind::SubPlan => ComponentKind::SubPlan,
                plan_table::Kind::Supervisor => ComponentKind::Supervisor,
                plan_table::Kind::Plan | plan_table::Kind::Unknown => ComponentKind::Plan,
            },
            template: row.template.clone(),
            outcomes: row.outcomes.iter().map(outcome).collect(),
            missed: ("DeadlineMissed".to_owned(), String::new()),
            error: ("Error".to_owned(), String::new()),
            inputs: row.inputs.iter().cloned().map(Port::named).collect(),
            outputs: Vec::new(),
            reactions: row.reactions.iter().map(reaction).collect(),
        };
        OwnedNames { components: table.components.iter().map(component).collect(), entries: vec![] }
    }

    fn get(&self, id: ComponentId) -> Option<&Component> {
        self.components.get(id.0 as usize)
    }

    fn outcomes(&self, id: ComponentId, outcome: Outcome) -> Option<&(String, String)> {
        let component = self.get(id)?;
        match outcome {
            Outcome::DeadlineMissed => Some(&component.missed),
            Outcome::Error => Some(&component.error),
            Outcome::Declared(position) => component.outcomes.get(usize::from(position)),
        }
    }
}

impl Component {
    fn copy(names: &(impl Names + ?Sized), id: ComponentId) -> Self {
        let ComponentName { path, kind, template } = names.component(id);
        let both = |n| (names.outcome(id, n).to_owned(), names.target(id, n).to_owned());
        Component {
            path: path.to_owned(),
            kind,
            template: template.to_owned(),
            outcomes: declared(names, id).map(|(outcome, _)| both(outcome)).collect(),
            missed: both(Outcome::DeadlineMissed),
            error: both(Outcome::Error),
            inputs: (0..u16::MAX)
                .map(|port| Port {
                    choices: until_empty(|value| names.input_choice(id, port, value)),
                    ..Port::copy(&names.input_port(id, port))
                })
                .take_while(|port| !port.name.is_empty())
                .collect(),
            outputs: (0..names.outputs(id))
                .map(|port| Port::copy(&names.output_port(id, port)))
                .collect(),
            reactions: (0..u16::MAX)
                .map_while(|n| names.reaction(id, n))
                .map(|edge| (edge.supervisor, edge.outcome, edge.target.to_owned()))
                .collect(),
        }
    }
}

impl Entry {
    fn copy(names: &(impl Names + ?Sized), id: TraceEntryId) -> Self {
        let EntryName { path, kind, ty, unit, range } = names.entry(id);
        Entry {
            path: path.to_owned(),
            kind,
            ty: ty.to_owned(),
            unit: unit.to_owned(),
            range,
            choices: until_empty(|value| names.choice(id, value)),
            initial: names.initial(id).map(copied),
        }
    }
}

impl Port {
    fn named(name: String) -> Self {
        Port { name, ..Port::default() }
    }

    fn copy(port: &PortName<'_>) -> Self {
        Port {
            name: port.name.to_owned(),
            ty: port.ty.to_owned(),
            choices: Vec::new(),
            unit: port.unit.to_owned(),
            range: port.range,
            entry: port.entry.map(str::to_owned),
            place: port.place.map(copied),
        }
    }

    fn get(&self) -> PortName<'_> {
        PortName {
            name: &self.name,
            ty: &self.ty,
            unit: &self.unit,
            range: self.range,
            entry: self.entry.as_deref(),
            place: self.place.as_ref().map(place),
        }
    }
}

fn copied(place: TextPlace<'_>) -> Place {
    (place.file.to_owned(), place.line, place.column)
}

fn place((file, line, column): &Place) -> TextPlace<'_> {
    TextPlace { file, line: *line, column: *column }
}

fn until_empty<'a>(name: impl Fn(u16) -> &'a str) -> Vec<String> {
    (0..u16::MAX).map(name).take_while(|name| !name.is_empty()).map(str::to_owned).collect()
}

fn reaction(row: &plan_table::Reaction) -> (ComponentId, Outcome, String) {
    // Positions are below this; a damaged one is that of nothing.
    let outcome = u16::try_from(row.outcome_id).unwrap_or(u16::MAX);
    (ComponentId(row.supervisor_id), Outcome::from_number(outcome), row.target.clone())
}

fn text(found: Option<&String>) -> &str {
    found.map_or("", String::as_str)
}

impl Names for OwnedNames {
    fn components(&self) -> u32 {
        self.components.len() as u32
    }

    fn component(&self, id: ComponentId) -> ComponentName<'_> {
        match self.get(id) {
            Some(Component { path, kind, template, .. }) => {
                ComponentName { path, kind: *kind, template }
            }
            None => ComponentName::NONE,
        }
    }

    fn outcome(&self, id: ComponentId, outcome: Outcome) -> &str {
        text(self.outcomes(id, outcome).map(|(name, _)| name))
    }

    fn target(&self, id: ComponentId, outcome: Outcome) -> &str {
        text(self.outcomes(id, outcome).map(|(_, target)| target))
    }

    fn reaction(&self, element: ComponentId, n: u16) -> Option<Reaction<'_>> {
        let (supervisor, outcome, target) = self.get(element)?.reactions.get(usize::from(n))?;
        Some(Reaction { supervisor: *supervisor, outcome: *outcome, target })
    }

    fn input(&self, id: ComponentId, port: u16) -> &str {
        self.input_port(id, port).name
    }

    fn input_port(&self, id: ComponentId, port: u16) -> PortName<'_> {
        let port = self.get(id).and_then(|component| component.inputs.get(usize::from(port)));
        port.map_or(PortName::default(), Port::get)
    }

    fn input_choice(&self, id: ComponentId, port: u16, value: u16) -> &str {
        let port = self.get(id).and_then(|component| component.inputs.get(usize::from(port)));
        text(port.and_then(|port| port.choices.get(usize::from(value))))
    }

    fn output_port(&self, id: ComponentId, port: u16) -> PortName<'_> {
        let port = self.get(id).and_then(|component| component.outputs.get(usize::from(port)));
        port.map_or(PortName::default(), Port::get)
    }

    fn outputs(&self, id: ComponentId) -> u16 {
        self.get(id).map_or(0, |component| component.outputs.len() as u16)
    }

    fn initial(&self, id: TraceEntryId) -> Option<TextPlace<'_>> {
        self.entries.get(id.0 as usize)?.initial.as_ref().map(place)
    }

    fn entries(&self) -> u32 {
        self.entries.len() as u32
    }

    fn entry(&self, id: TraceEntryId) -> EntryName<'_> {
        match self.entries.get(id.0 as usize) {
            Some(Entry { path, kind, ty, unit, range, .. }) => {
                EntryName { path, kind: *kind, ty, unit, range: *range }
            }
            None => EntryName::NONE,
        }
    }

    fn choice(&self, id: TraceEntryId, value: u16) -> &str {
        text(self.entries.get(id.0 as usize).and_then(|e| e.choices.get(usize::from(value))))
    }
}
