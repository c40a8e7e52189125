//! The names of a plan in its log.

use afp_core::trace::{
    ComponentId, ComponentKind, ComponentName, EntryName, Names, Outcome, Reaction, TraceEntryId,
};

use crate::proto::afp::{PlanTable, plan_table};

/// The names in a log: those of components, and not of entries.
#[derive(Clone, Debug, Default)]
pub struct LogNames(pub(crate) PlanTable);

impl LogNames {
    fn get(&self, id: ComponentId) -> Option<&plan_table::Component> {
        self.0.components.get(id.0 as usize)
    }

    fn declared(&self, id: ComponentId, position: u16) -> Option<&plan_table::Outcome> {
        self.get(id)?.outcomes.get(usize::from(position))
    }
}

impl Names for LogNames {
    fn components(&self) -> u32 {
        self.0.components.len() as u32
    }

    fn component(&self, id: ComponentId) -> ComponentName<'_> {
        let Some(row) = self.get(id) else { return ComponentName::NONE };
        let kind = match row.kind() {
            plan_table::Kind::Actor => ComponentKind::Actor,
            plan_table::Kind::Computation => ComponentKind::Computation,
            plan_table::Kind::SubPlan => ComponentKind::SubPlan,
            plan_table::Kind::Supervisor => ComponentKind::Supervisor,
            plan_table::Kind::Plan | plan_table::Kind::Unknown => ComponentKind::Plan,
        };
        ComponentName { path: &row.path, kind, template: &row.template }
    }

    fn outcome(&self, id: ComponentId, outcome: Outcome) -> &str {
        match outcome {
            _ if self.get(id).is_none() => "",
            Outcome::DeadlineMissed => "DeadlineMissed",
            Outcome::Error => "Error",
            Outcome::Declared(position) => self.declared(id, position).map_or("", |it| &it.name),
        }
    }

    fn target(&self, id: ComponentId, outcome: Outcome) -> &str {
        match outcome {
            Outcome::Declared(position) => self.declared(id, position).map_or("", |it| &it.target),
            Outcome::DeadlineMissed | Outcome::Error => "",
        }
    }

    fn reaction(&self, element: ComponentId, n: u16) -> Option<Reaction<'_>> {
        let row = self.get(element)?.reactions.get(usize::from(n))?;
        // Positions are below this; a damaged position refers to nothing.
        let outcome = Outcome::from_number(u16::try_from(row.outcome_id).unwrap_or(u16::MAX));
        Some(Reaction { supervisor: ComponentId(row.supervisor_id), outcome, target: &row.target })
    }

    fn input(&self, id: ComponentId, port: u16) -> &str {
        self.get(id).and_then(|row| row.inputs.get(usize::from(port))).map_or("", String::as_str)
    }

    fn entries(&self) -> u32 {
        0
    }

    fn entry(&self, _: TraceEntryId) -> EntryName<'_> {
        EntryName::NONE
    }

    fn choice(&self, _: TraceEntryId, _: u16) -> &str {
        ""
    }
}
