//! The tables of one plan.

use afp_types::{ElementId, ElementRow, PlanTable, Range, SupervisorId, SupervisorRow, Target};

/// The tables of one plan.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Rows {
    pub start: ElementId,
    /// How many supervisors are global.
    pub globals: u16,
    /// How many entries there are.
    pub entries: u16,
    pub elements: Vec<ElementRow>,
    pub supervisors: Vec<SupervisorRow>,
    /// Why edges to `fail` end the plan.
    pub reasons: Vec<String>,
    /// Where states and events lead; `None` where a state cannot be reached.
    pub edges: Vec<Option<Target>>,
    /// For each element, the rows in [`Rows::supervisors`] of its supervisors and of the global ones, in
    /// polling order.
    pub sweeps: Vec<u16>,
}

impl Rows {
    /// The rows as the scheduler reads them; `reasons` are the texts in the form that it needs.
    #[inline]
    pub fn table<'a, R>(&'a self, reasons: &'a [R]) -> PlanTable<'a, R> {
        PlanTable {
            start: self.start,
            globals: self.globals,
            entries: self.entries,
            elements: &self.elements,
            supervisors: &self.supervisors,
            reasons,
            edges: &self.edges,
            sweeps: &self.sweeps,
        }
    }

    /// The edges of an element's states or of a supervisor's events.
    pub fn edges(&self, range: Range) -> &[Option<Target>] {
        self.edges.get(range.indices()).unwrap_or(&[])
    }

    /// The supervisors polled while an element is active, in order.
    pub fn sweep(&self, element: &ElementRow) -> impl ExactSizeIterator<Item = SupervisorId> + '_ {
        let rows = self.sweeps.get(element.sweep.indices()).unwrap_or(&[]);
        rows.iter().map(|row| self.supervisors[usize::from(*row)].instance)
    }
}
