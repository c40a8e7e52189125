use afp_types::{ElementId, ElementRow, PlanTable, Range, SupervisorId, SupervisorRow, Target};

/// The tables of one plan.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Rows {
    pub start: ElementId,
    /// Number of global supervisors.
    pub globals: u16,
    pub entries: u16,
    pub elements: Vec<ElementRow>,
    pub supervisors: Vec<SupervisorRow>,
    /// Reasons of edges to `fail`.
    pub reasons: Vec<String>,
    /// Targets of states and events; `None` for an unreachable state.
    pub edges: Vec<Option<Target>>,
    /// For each element, rows in [`Rows::supervisors`] of its supervisors and of the global ones,
    /// in polling order.
    pub sweeps: Vec<u16>,
}

impl Rows {
    /// Whether an event of the plan sets an element aside.
    pub fn suspends(&self) -> bool {
        self.elements.iter().any(|row| row.handler)
    }

    /// The scheduler's view of the rows; `reasons` are the texts in its own form.
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

    pub fn edges(&self, range: Range) -> &[Option<Target>] {
        self.edges.get(range.indices()).unwrap_or(&[])
    }

    /// The supervisors polled while an element is active, in order.
    pub fn sweep(&self, element: &ElementRow) -> impl ExactSizeIterator<Item = SupervisorId> + '_ {
        let rows = self.sweeps.get(element.sweep.indices()).unwrap_or(&[]);
        rows.iter().map(|row| self.supervisors[usize::from(*row)].instance)
    }
}
