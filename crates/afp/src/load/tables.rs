//! The rows of a loaded plan, converted from those of the graph.

use std::collections::HashMap;
use std::sync::{Arc, LazyLock, Mutex, PoisonError};

use afp_core::rt::{ElementRow, Events, PlanTable, SupervisorRow, Tables};
use afp_core::{Duration, Fault, Reason, rt};
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
    reasons: Vec<Fault>,
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
            reasons: &rows.reasons,
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
            reasons: rows.reasons.iter().map(|text| reason(text)).collect(),
            edges: rows.edges.iter().copied().map(target).collect(),
            sweeps: rows.sweeps.clone(),
        }))
    }
}

fn element(row: &rows::ElementRow) -> ElementRow {
    ElementRow {
        kind: row.kind,
        period: Duration::from_nanos(row.period),
        states: row.states,
        on_error: target(row.on_error),
        resumes: row.resumes,
        locals: row.locals,
        sweep: row.sweep,
        child: row.child,
    }
}

fn supervisor(row: &rows::SupervisorRow) -> SupervisorRow {
    SupervisorRow {
        instance: row.instance.0,
        period: Duration::from_nanos(row.period),
        deadline: Duration::from_nanos(row.deadline),
        budget: Duration::from_nanos(row.budget),
        slot: row.slot,
        events: row.events,
        on_miss: target(row.on_miss),
        wanted: Events::from_bits(row.wanted),
        wanted_in_look: Events::from_bits(row.wanted_in_look),
    }
}

fn target(target: Option<Target>) -> rt::Target {
    match target {
        Some(Target::Element(id)) => rt::Target::Element(id.0),
        Some(Target::Terminate) => rt::Target::Terminate,
        Some(Target::Fail(id)) => rt::Target::Fail(id.0),
        Some(Target::Ignore) => rt::Target::Ignore,
        Some(Target::Resume) => rt::Target::Resume,
        None => rt::Target::None,
    }
}

/// The fault of that reason. A fault is a reference that lasts, so each text is kept once for the life
/// of the process.
fn reason(text: &str) -> Fault {
    static KNOWN: LazyLock<Mutex<HashMap<String, &'static Reason>>> = LazyLock::new(Mutex::default);
    let mut known = KNOWN.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(reason) = known.get(text) {
        return Fault::new(reason);
    }
    let kept: &'static str = Box::leak(text.into());
    let reason = Box::leak(Box::new(Reason { code: Fault::FAILED, text: kept }));
    known.insert(text.to_owned(), reason);
    Fault::new(reason)
}
