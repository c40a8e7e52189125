//! The static part of a plan: rows of numbers that the scheduler reads.

use afp_types::Duration;

use crate::component::Events;
use crate::fault::Fault;

pub use afp_types::{Child, ElementKind, Range};

/// Where an edge leads.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Target {
    /// To an element of the same plan.
    Element(u16),
    /// The plan ends.
    Terminate,
    /// The plan ends in `Error`, for a reason of [`PlanTable::reasons`].
    Fail(u16),
    /// The event is not taken.
    Ignore,
    /// The active element goes on.
    Resume,
    /// Nothing is connected.
    None,
}

/// One element.
#[derive(Clone, Copy, Debug)]
pub struct ElementRow {
    /// What it is.
    pub kind: ElementKind,
    /// Poll period; of no meaning for computations and sub-plans.
    pub period: Duration,
    /// Its states in [`PlanTable::edges`].
    pub states: Range,
    /// Its `Error` edge.
    pub on_error: Target,
    /// Whether it is a computation from which computations alone can lead to [`Target::Resume`].
    pub resumes: bool,
    /// Its local supervisors in [`PlanTable::supervisors`].
    pub locals: Range,
    /// The supervisors polled while it is active, in order, in [`PlanTable::sweeps`].
    pub sweep: Range,
    /// Its ids, when it is a sub-plan.
    pub child: Child,
}

/// One supervisor. The global ones come first, then the local ones, element by element. Behind them
/// stand rows for global ones of which an element wants other events than most do, or whose events
/// lead elsewhere while it is active.
#[derive(Clone, Copy, Debug)]
pub struct SupervisorRow {
    /// Which supervisor it is.
    pub instance: u16,
    /// Poll period, above zero.
    pub period: Duration,
    /// Deadline after each release.
    pub deadline: Duration,
    /// Declared bound of one poll; zero where none is declared.
    pub budget: Duration,
    /// Where it keeps its releases: its own number for a global one, and for a local one the
    /// number of globals plus its position in its element.
    pub slot: u16,
    /// Its events in [`PlanTable::edges`].
    pub events: Range,
    /// Its `DeadlineMissed` edge.
    pub on_miss: Target,
    /// The events that would be taken.
    pub wanted: Events,
    /// The events that would be taken in the look.
    pub wanted_in_look: Events,
}

/// All rows of one plan. Reading a row that does not exist gives `None`, never a panic.
#[derive(Clone, Copy, Debug)]
pub struct PlanTable<'a> {
    /// The first element.
    pub start: u16,
    /// How many supervisors are global.
    pub globals: u16,
    /// How many entries there are.
    pub entries: u16,
    /// The elements.
    pub elements: &'a [ElementRow],
    /// The supervisors.
    pub supervisors: &'a [SupervisorRow],
    /// Why edges to `fail` end the plan.
    pub reasons: &'a [Fault],
    /// Targets of states and events.
    pub edges: &'a [Target],
    /// For each element, the rows of its supervisors and of the global ones in polling order.
    pub sweeps: &'a [u16],
}

/// Gives access to the rows: a zero-sized type for generated plans, so that all of it folds to
/// constants; a counted pointer for loaded ones.
pub trait Tables {
    /// The rows.
    fn table(&self) -> PlanTable<'_>;
}

impl PlanTable<'_> {
    /// How many slots the supervisors need: the global ones and those of the richest element.
    pub fn slots(&self) -> usize {
        let locals = self.elements.iter().map(|row| row.locals.len).max().unwrap_or(0);
        usize::from(self.globals) + usize::from(locals)
    }
}

impl<'a> PlanTable<'a> {
    /// An element's row.
    #[inline]
    pub fn element(&self, element: u16) -> Option<&'a ElementRow> {
        self.elements.get(usize::from(element))
    }

    /// A supervisor's row.
    #[inline]
    pub fn supervisor(&self, supervisor: u16) -> Option<&'a SupervisorRow> {
        self.supervisors.get(usize::from(supervisor))
    }

    /// The target of the `n`-th edge of a run.
    #[inline]
    pub fn edge(&self, edges: Range, n: u16) -> Target {
        if n >= edges.len {
            return Target::None;
        }
        let index = usize::from(edges.first) + usize::from(n);
        self.edges.get(index).copied().unwrap_or(Target::None)
    }

    /// Why an edge to `fail` ends the plan.
    pub fn reason(&self, reason: u16) -> Fault {
        self.reasons.get(usize::from(reason)).copied().unwrap_or(Fault::INTERNAL)
    }

    /// The supervisors polled while an element is active.
    #[inline]
    pub fn sweep(&self, row: &ElementRow) -> &'a [u16] {
        self.sweeps.get(row.sweep.indices()).unwrap_or(&[])
    }
}
