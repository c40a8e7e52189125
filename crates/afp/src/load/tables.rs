//! The rows of a loaded plan, converted from those of the graph.

use std::sync::Arc;

use afp_core::rt::{
    Child, ElementKind, ElementRow, Events, PlanTable, Range, SupervisorRow, Tables,
};
use afp_core::{Duration, rt};
use afp_dsl::graph::Target;
use afp_dsl::rows;

/// The rows of one plan, shared by its instances.
#[derive(Clone, Debug)]
pub struct LoadedTables(Arc<Rows>);

#[derive(Debug)]
struct Rows {
    start: u16,
    globals: u16,
    entries: u16,
    elements: Vec<ElementRow>,
    supervisors: Vec<SupervisorRow>,
    edges: Vec<rt::Target>,
    sweeps: Vec<u16>,
}

impl Tables for LoadedTables {
    #[inline]
    fn table(&self) -> PlanTable<'_> {
        let rows = &*self.0;
        PlanTable {
            start: rows.start,
            globals: rows.globals,
            entries: rows.entries,
            elements: &rows.elements,
            supervisors: &rows.supervisors,
            edges: &rows.edges,
            sweeps: &rows.sweeps,
        }
    }
}

impl LoadedTables {
    /// The rows of a plan.
    pub fn new(rows: &rows::Rows) -> Self {
        LoadedTables(Arc::new(Rows {
            start: rows.start.0,
            globals: rows.globals,
            entries: rows.entries,
            elements: rows.elements.iter().map(element).collect(),
            supervisors: rows.supervisors.iter().map(supervisor).collect(),
            edges: rows.edges.iter().copied().map(target).collect(),
            sweeps: rows.sweeps.iter().map(|id| id.0).collect(),
        }))
    }
}

fn element(row: &rows::ElementRow) -> ElementRow {
    ElementRow {
        kind: match row.kind {
            rows::ElementKind::Actor => ElementKind::Actor,
            rows::ElementKind::Computation => ElementKind::Computation,
            rows::ElementKind::SubPlan => ElementKind::SubPlan,
        },
        period: Duration::from_nanos(row.period),
        states: range(row.states),
        on_error: target(row.on_error),
        locals: range(row.locals),
        sweep: range(row.sweep),
        child: Child { components: row.child.components, entries: row.child.entries },
    }
}

fn supervisor(row: &rows::SupervisorRow) -> SupervisorRow {
    SupervisorRow {
        period: Duration::from_nanos(row.period),
        deadline: Duration::from_nanos(row.deadline),
        budget: Duration::from_nanos(row.budget),
        slot: row.slot,
        events: range(row.events),
        on_miss: target(row.on_miss),
        wanted: Events::from_bits(row.wanted),
    }
}

fn range(range: rows::Range) -> Range {
    Range { first: range.first, len: range.len }
}

fn target(target: Option<Target>) -> rt::Target {
    match target {
        Some(Target::Element(id)) => rt::Target::Element(id.0),
        Some(Target::Terminate) => rt::Target::Terminate,
        Some(Target::Ignore) => rt::Target::Ignore,
        None => rt::Target::None,
    }
}
