//! The names of a loaded plan, for traces.

use std::sync::Arc;

use afp_core::trace::{
    ComponentId, ComponentName, EntryName, Names, Outcome, PortName, Reaction, TextPlace,
    TraceEntryId,
};
use afp_dsl::graph::Graph;
use afp_dsl::types::Type;
use afp_dsl::unfold::{self, ComponentNames, EntryNames, PortNames, Unfolded};
use afp_syntax::source::Span;

/// The names of a graph's main plan; a copy is free.
#[derive(Clone, Debug)]
pub struct PlanNames(Arc<Unfolded>);

impl PlanNames {
    /// The names of a graph's main plan.
    pub fn new(graph: &Graph) -> Self {
        PlanNames(Arc::new(unfold::unfold(graph)))
    }

    fn get(&self, id: ComponentId) -> Option<&ComponentNames> {
        self.0.components.get(id.0 as usize)
    }

    fn get_input(&self, id: ComponentId, port: u16) -> Option<&PortNames> {
        self.get(id)?.inputs.get(usize::from(port))
    }

    fn get_entry(&self, id: TraceEntryId) -> Option<&EntryNames> {
        self.0.entries.get(id.0 as usize)
    }

    fn port<'a>(&'a self, names: &'a PortNames) -> PortName<'a> {
        PortName {
            name: &names.name,
            ty: names.ty.declared_name(),
            unit: &names.unit,
            range: names.range,
            entry: Some(&*names.entry).filter(|entry| !entry.is_empty()),
            place: self.place(names.span),
        }
    }

    /// A place in the plan's sources; `None` for other sources.
    pub(super) fn place(&self, span: Span) -> Option<TextPlace<'_>> {
        let unfold::TextPlace { file, line, column } = self.0.texts.place(span)?;
        Some(TextPlace { file, line, column })
    }
}

/// The name of an enum value; empty for other types.
fn choice(ty: &Type, value: u16) -> &str {
    ty.choices().get(usize::from(value)).map_or("", String::as_str)
}

impl Names for PlanNames {
    fn components(&self) -> u32 {
        self.0.components.len() as u32
    }

    fn component(&self, id: ComponentId) -> ComponentName<'_> {
        match self.get(id) {
            Some(names) => {
                ComponentName { path: &names.path, kind: names.kind, template: &names.template }
            }
            None => ComponentName::NONE,
        }
    }

    fn outcome(&self, id: ComponentId, outcome: Outcome) -> &str {
        match outcome {
            Outcome::DeadlineMissed => "DeadlineMissed",
            Outcome::Error => "Error",
            Outcome::Declared(position) => {
                let names = self.get(id).and_then(|c| c.outcomes.get(usize::from(position)));
                names.map_or("", |(name, _)| name)
            }
        }
    }

    fn target(&self, id: ComponentId, outcome: Outcome) -> &str {
        let Some(names) = self.get(id) else { return "" };
        match outcome {
            Outcome::DeadlineMissed | Outcome::Error => &names.special,
            Outcome::Declared(position) => {
                names.outcomes.get(usize::from(position)).map_or("", |(_, target)| target)
            }
        }
    }

    fn reaction(&self, element: ComponentId, n: u16) -> Option<Reaction<'_>> {
        let (reaction, target) = self.get(element)?.reactions.get(usize::from(n))?;
        Some(Reaction::new(ComponentId(reaction.supervisor), reaction.event, target))
    }

    fn input(&self, id: ComponentId, port: u16) -> &str {
        self.get_input(id, port).map_or("", |port| &port.name)
    }

    fn input_port(&self, id: ComponentId, port: u16) -> PortName<'_> {
        self.get_input(id, port).map_or(PortName::default(), |names| self.port(names))
    }

    fn input_choice(&self, id: ComponentId, port: u16, value: u16) -> &str {
        self.get_input(id, port).map_or("", |port| choice(&port.ty, value))
    }

    fn output_port(&self, id: ComponentId, port: u16) -> PortName<'_> {
        let all = self.get(id).map_or(&[][..], |names| &names.outputs);
        let bound = all.iter().find(|(position, _)| *position == port);
        bound.map_or(PortName::default(), |(_, names)| self.port(names))
    }

    fn outputs(&self, id: ComponentId) -> u16 {
        let all = self.get(id).map_or(&[][..], |names| &names.outputs);
        all.iter().map(|(position, _)| position.saturating_add(1)).max().unwrap_or(0)
    }

    fn state(&self, id: ComponentId, state: u16) -> Option<TextPlace<'_>> {
        self.place(*self.get(id)?.states.get(usize::from(state))?)
    }

    fn initial(&self, id: TraceEntryId) -> Option<TextPlace<'_>> {
        self.place(self.get_entry(id)?.initial?)
    }

    fn entries(&self) -> u32 {
        self.0.entries.len() as u32
    }

    fn entry(&self, id: TraceEntryId) -> EntryName<'_> {
        match self.get_entry(id) {
            Some(EntryNames { path, kind, type_text: ty, unit, range, .. }) => {
                EntryName { path, kind: *kind, ty, unit, range: *range }
            }
            None => EntryName::NONE,
        }
    }

    fn choice(&self, id: TraceEntryId, value: u16) -> &str {
        self.get_entry(id).map_or("", |entry| choice(&entry.ty, value))
    }
}
