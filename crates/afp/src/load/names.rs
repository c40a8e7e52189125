//! The names of a loaded plan, for traces.

use std::sync::Arc;

use afp_core::trace::{
    ComponentId, ComponentName, DEADLINE_MISSED, ERROR, EntryKind, EntryName, Kind, Names,
    TraceEntryId,
};
use afp_dsl::graph::{self, Graph};
use afp_dsl::types::Type;
use afp_dsl::unfold::{self, ComponentNames, EntryNames, Unfolded};

/// The names behind the ids of a graph's main plan; a copy costs nothing.
#[derive(Clone, Debug)]
pub struct PlanNames(Arc<Tables>);

#[derive(Debug)]
struct Tables {
    all: Unfolded,
    /// Type and SI unit of each entry.
    types: Vec<(String, String)>,
}

impl PlanNames {
    /// The names of the plan that runs.
    pub fn new(graph: &Graph) -> Self {
        let all = unfold::unfold(graph);
        let types = all.entries.iter().map(|entry| (entry.ty.to_string(), unit(&entry.ty)));
        PlanNames(Arc::new(Tables { types: types.collect(), all }))
    }

    fn get(&self, id: ComponentId) -> Option<&ComponentNames> {
        self.0.all.components.get(id.0 as usize)
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
            Some(names) => ComponentName {
                path: &names.path,
                kind: kind(names.kind),
                template: &names.template,
            },
            None => ComponentName::NONE,
        }
    }

    fn outcome(&self, id: ComponentId, outcome: u16) -> &str {
        match outcome {
            DEADLINE_MISSED => "DeadlineMissed",
            ERROR => "Error",
            _ => {
                let names = self.get(id).and_then(|c| c.outcomes.get(usize::from(outcome)));
                names.map_or("", |(name, _)| name)
            }
        }
    }

    fn target(&self, id: ComponentId, outcome: u16) -> &str {
        let Some(names) = self.get(id) else { return "" };
        match outcome {
            DEADLINE_MISSED | ERROR => &names.special,
            _ => names.outcomes.get(usize::from(outcome)).map_or("", |(_, target)| target),
        }
    }

    fn input(&self, id: ComponentId, port: u16) -> &str {
        self.get(id).and_then(|c| c.inputs.get(usize::from(port))).map_or("", String::as_str)
    }

    fn entries(&self) -> u32 {
        self.0.all.entries.len() as u32
    }

    fn entry(&self, id: TraceEntryId) -> EntryName<'_> {
        match self.get_entry(id) {
            Some((names, (ty, unit))) => {
                let (kind, range) = (entry_kind(names.kind), names.range);
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

fn kind(kind: unfold::Kind) -> Kind {
    match kind {
        unfold::Kind::Plan => Kind::Plan,
        unfold::Kind::Actor => Kind::Actor,
        unfold::Kind::Computation => Kind::Computation,
        unfold::Kind::SubPlan => Kind::SubPlan,
        unfold::Kind::Supervisor => Kind::Supervisor,
    }
}

fn entry_kind(kind: graph::EntryKind) -> EntryKind {
    match kind {
        graph::EntryKind::In => EntryKind::In,
        graph::EntryKind::Out => EntryKind::Out,
        graph::EntryKind::Var => EntryKind::Var,
        graph::EntryKind::Const => EntryKind::Const,
    }
}
