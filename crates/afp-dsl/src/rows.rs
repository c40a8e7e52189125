//! The tables that the scheduler reads, lowered once from the checked plans.
//!
//! Loaded plans convert them, generated code prints them, so the two back ends cannot disagree. They
//! are plain data with checked sizes: what a table has no room for is refused by the check
//! (`check/size.rs`), and `lower` gives nothing rather than a number that wrapped.

mod ids;
mod lower;
mod order;
mod size;
mod wanted;

pub use afp_types::{Child, ElementKind, Range};
pub(crate) use lower::lower;
pub(crate) use order::polling_order;
pub(crate) use size::{MAX_EVENTS, MAX_ROWS, MAX_STATES, Table, tables};

use crate::graph::{ElementId, SupervisorId, Target};

/// The tables of one plan.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Rows {
    /// The first element.
    pub start: ElementId,
    /// How many supervisors are global.
    pub globals: u16,
    /// How many entries there are.
    pub entries: u16,
    /// The elements.
    pub elements: Vec<ElementRow>,
    /// The supervisors.
    pub supervisors: Vec<SupervisorRow>,
    /// Why edges to `fail` end the plan.
    pub reasons: Vec<String>,
    /// Where states and events lead; `None` where a state cannot be reached.
    pub edges: Vec<Option<Target>>,
    /// For each element, the rows in [`Rows::supervisors`] of its supervisors and of the global ones, in
    /// polling order.
    pub sweeps: Vec<u16>,
}

/// One element.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ElementRow {
    /// What it is.
    pub kind: ElementKind,
    /// Poll period of an actor in nanoseconds; zero for the others.
    pub period: u64,
    /// Its states in [`Rows::edges`].
    pub states: Range,
    /// Its `Error` edge.
    pub on_error: Option<Target>,
    /// Whether it is a computation from which computations alone can lead to `resume`.
    pub resumes: bool,
    /// Its local supervisors in [`Rows::supervisors`].
    pub locals: Range,
    /// The supervisors polled while it is active, in order, in [`Rows::sweeps`].
    pub sweep: Range,
    /// Its ids; zero unless it is a sub-plan.
    pub child: Child,
}

/// One supervisor. The global ones come first, then the local ones, element by element. Behind them
/// stand rows for global ones of which an element wants other events than most do, or whose events
/// lead elsewhere while it is active.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SupervisorRow {
    /// Which supervisor it is.
    pub instance: SupervisorId,
    /// Poll period in nanoseconds.
    pub period: u64,
    /// Deadline after each release in nanoseconds.
    pub deadline: u64,
    /// Declared bound of one poll in nanoseconds; zero where none is declared.
    pub budget: u64,
    /// Where it keeps its releases: its own number for a global one, and for a local one the number
    /// of globals plus its position in its element.
    pub slot: u16,
    /// Its events in [`Rows::edges`].
    pub events: Range,
    /// Its `DeadlineMissed` edge.
    pub on_miss: Option<Target>,
    /// The events that would be taken, those neither ignored nor leading to where the plan is
    /// already: bit `n` is the template's `n`-th.
    pub wanted: u64,
    /// The same in the look, where an element's own supervisors do not start it anew.
    pub wanted_in_look: u64,
}

impl Rows {
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
