//! The rows that the scheduler reads, made from a graph.

use std::sync::Arc;

use afp_core::rt::{
    Child, ElementKind, ElementRow, Events, PlanTable, Range, SupervisorRow, Tables,
};
use afp_core::{Duration, rt};
use afp_dsl::graph::{Component, Element, Graph, Plan, Supervisor, Target};
use afp_dsl::unfold::Block;

/// The rows of one plan, shared by its instances.
#[derive(Clone, Debug)]
pub struct LoadedTables(Arc<Rows>);

#[derive(Debug, Default)]
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
    /// The rows of `plan`, whose block of ids is `block`.
    pub fn new(graph: &Graph, plan: &Plan, block: &Block) -> Self {
        let mut rows = Rows {
            start: plan.start.0,
            globals: plan.globals,
            entries: plan.entries.len() as u16,
            ..Rows::default()
        };
        for (index, element) in plan.elements.iter().enumerate() {
            let child = block.children.get(index).copied().unwrap_or_default();
            rows.add_element(graph, plan, element, child);
        }
        for (index, supervisor) in plan.supervisors.iter().enumerate() {
            rows.add_supervisor(graph, plan, supervisor, index as u16);
        }
        LoadedTables(Arc::new(rows))
    }
}

impl Rows {
    fn add_element(&mut self, graph: &Graph, plan: &Plan, element: &Element, child: (u32, u32)) {
        let (kind, period) = match element.component {
            Component::Actor(id) => (ElementKind::Actor, graph.template(id).every),
            Component::Computation(_) => (ElementKind::Computation, 0),
            Component::SubPlan(_) => (ElementKind::SubPlan, 0),
        };
        let states = self.add_edges(element.states.iter().copied());
        let first = self.sweeps.len() as u16;
        if kind != ElementKind::Computation {
            self.sweeps.extend(plan.sweep(element).iter().map(|id| id.0));
        }
        let locals = element.supervisors.first().map_or(Range::default(), |id| Range {
            first: id.0,
            len: element.supervisors.len() as u16,
        });
        self.elements.push(ElementRow {
            kind,
            period: Duration::from_nanos(period),
            states,
            on_error: target(element.on_error),
            locals,
            sweep: Range { first, len: self.sweeps.len() as u16 - first },
            child: Child { components: child.0, entries: child.1 },
        });
    }

    fn add_supervisor(&mut self, graph: &Graph, plan: &Plan, supervisor: &Supervisor, index: u16) {
        let slot = match supervisor.owner {
            None => index,
            Some(owner) => {
                let first = plan.elements[owner.index()].supervisors.first();
                plan.globals + index - first.map_or(index, |id| id.0)
            }
        };
        let events = self.add_edges(supervisor.events.iter().map(|event| Some(*event)));
        let budget = graph.template(supervisor.template).budget.unwrap_or(0);
        self.supervisors.push(SupervisorRow {
            period: Duration::from_nanos(supervisor.every),
            deadline: Duration::from_nanos(supervisor.deadline),
            budget: Duration::from_nanos(budget),
            slot,
            events,
            on_miss: target(supervisor.on_miss),
            wanted: wanted(supervisor),
        });
    }

    fn add_edges(&mut self, targets: impl Iterator<Item = Option<Target>>) -> Range {
        let first = self.edges.len() as u16;
        self.edges.extend(targets.map(target));
        Range { first, len: self.edges.len() as u16 - first }
    }
}

/// The events that lead to something other than `ignore`.
fn wanted(supervisor: &Supervisor) -> Events {
    let bits = supervisor.events.iter().enumerate().filter(|(_, event)| **event != Target::Ignore);
    Events::from_bits(bits.fold(0, |bits, (index, _)| bits | 1 << index))
}

fn target(target: Option<Target>) -> rt::Target {
    match target {
        Some(Target::Element(id)) => rt::Target::Element(id.0),
        Some(Target::Terminate) => rt::Target::Terminate,
        Some(Target::Ignore) => rt::Target::Ignore,
        None => rt::Target::None,
    }
}
