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

/// The names behind the ids of a graph's main plan; a copy costs nothing.
#[derive(Clone, Debug)]
pub struct PlanNames(Arc<Tables>);

#[derive(Debug)]
struct Tables {
    all: Unfolded,
    /// Type and SI unit of each entry.
    types: Vec<(String, String)>,
    /// The SI units of the inputs and bound outputs of each component.
    units: Vec<[Vec<String>; 2]>,
}

impl PlanNames {
    /// The names of the plan that runs.
    pub fn new(graph: &Graph) -> Self {
        let all = unfold::unfold(graph);
        let types = all.entries.iter().map(|entry| (entry.ty.to_string(), unit(&entry.ty)));
        let units = all.components.iter().map(|names| {
            let inputs = names.inputs.iter().map(|port| unit(&port.ty)).collect();
            [inputs, names.outputs.iter().map(|(_, port)| unit(&port.ty)).collect()]
        });
        PlanNames(Arc::new(Tables { types: types.collect(), units: units.collect(), all }))
    }

    fn get(&self, id: ComponentId) -> Option<&ComponentNames> {
        self.0.all.components.get(id.0 as usize)
    }

    /// A port; its unit is the `index`-th of that kind.
    fn port<'a>(
        &'a self,
        id: ComponentId,
        kind: usize,
        index: usize,
        names: &'a PortNames,
    ) -> PortName<'a> {
        let units = self.0.units.get(id.0 as usize).and_then(|units| units.get(kind));
        PortName {
            name: &names.name,
            ty: names.ty.declared_name(),
            unit: units.and_then(|units| units.get(index)).map_or("", String::as_str),
            range: names.range,
            entry: None,
            place: self.place(names.span),
        }
    }

    /// A place in the plan's texts; none where it is in none of them.
    pub(super) fn place(&self, span: Span) -> Option<TextPlace<'_>> {
        let unfold::TextPlace { file, line, column } = self.0.all.texts.place(span)?;
        Some(TextPlace { file, line, column })
    }

    fn get_entry(&self, id: TraceEntryId) -> Option<(&EntryNames, &(String, String))> {
        let index = id.0 as usize;
        Some((self.0.all.entries.get(index)?, self.0.types.get(index)?))
    }
}

/// The SI unit of a type's values.
fn unit(ty: &Type) -> String {
    match ty {
        Type::Quantity(dimension) => dimension.si_unit(),
        _ => String::new(),
    }
}

impl Names for PlanNames {
    fn components(&self) -> u32 {
        self.0.all.components.len() as u32
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
        self.get(id).and_then(|c| c.inputs.get(usize::from(port))).map_or("", |port| &port.name)
    }

    fn input_port(&self, id: ComponentId, port: u16) -> PortName<'_> {
        let index = usize::from(port);
        let names = self.get(id).and_then(|names| names.inputs.get(index));
        names.map_or(PortName::default(), |names| self.port(id, 0, index, names))
    }

    fn input_choice(&self, id: ComponentId, port: u16, value: u16) -> &str {
        match self.get(id).and_then(|names| names.inputs.get(usize::from(port))) {
            Some(PortNames { ty: Type::Enum(choices), .. }) => {
                choices.variants.get(usize::from(value)).map_or("", String::as_str)
            }
            _ => "",
        }
    }

    fn output_port(&self, id: ComponentId, port: u16) -> PortName<'_> {
        let all = self.get(id).map_or(&[][..], |names| &names.outputs);
        let bound = all.iter().enumerate().find(|(_, (position, _))| *position == port);
        bound.map_or(PortName::default(), |(index, (_, names))| PortName {
            entry: Some(&names.entry),
            ..self.port(id, 1, index, names)
        })
    }

    fn outputs(&self, id: ComponentId) -> u16 {
        let all = self.get(id).map_or(&[][..], |names| &names.outputs);
        all.iter().map(|(position, _)| position.saturating_add(1)).max().unwrap_or(0)
    }

    fn initial(&self, id: TraceEntryId) -> Option<TextPlace<'_>> {
        let (entry, _) = self.get_entry(id)?;
        self.place(entry.initial?)
    }

    fn entries(&self) -> u32 {
        self.0.all.entries.len() as u32
    }

    fn entry(&self, id: TraceEntryId) -> EntryName<'_> {
        match self.get_entry(id) {
            Some((names, (ty, unit))) => {
                let (kind, range) = (names.kind, names.range);
                EntryName { path: &names.path, kind, ty, unit, range }
            }
            None => EntryName::NONE,
        }
    }

    fn choice(&self, id: TraceEntryId, value: u16) -> &str {
        match self.get_entry(id) {
            Some((EntryNames { ty: Type::Enum(choices), .. }, _)) => {
                choices.variants.get(usize::from(value)).map_or("", String::as_str)
            }
            _ => "",
        }
    }
}
