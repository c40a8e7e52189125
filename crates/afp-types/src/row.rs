//! The rows that the compiler produces and the scheduler reads.
//!
//! The compiler stores them in vectors, generated code in statics. Both lend them as a
//! [`PlanTable`].

use crate::{Duration, ElementId, SupervisorId, Target};

/// The kind of an element.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ElementKind {
    /// An actor.
    Actor,
    /// A computation.
    Computation,
    /// A sub-plan.
    SubPlan,
}

/// Consecutive rows in another table.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Range {
    /// Index of the first row.
    pub first: u16,
    /// Number of rows.
    pub len: u16,
}

/// First ids of a sub-plan, relative to the first id of the plan that uses it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Child {
    /// Offset of its component ids.
    pub components: u32,
    /// Offset of its entry ids.
    pub entries: u32,
}

/// Period, deadline and budget of a supervisor's polls.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Timing {
    /// Poll period, greater than zero.
    pub period: Duration,
    /// Deadline after each release.
    pub deadline: Duration,
    /// Declared bound of a poll's duration; zero if undeclared.
    pub budget: Duration,
}

/// A set of a supervisor's events, by position in its template.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Events(u64);

/// An element.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ElementRow {
    /// The kind.
    pub kind: ElementKind,
    /// Poll period of an actor; zero for computations and sub-plans.
    pub period: Duration,
    /// The states in [`PlanTable::edges`].
    pub states: Range,
    /// The `Error` edge.
    pub on_error: Option<Target>,
    /// Whether it is a computation that can reach [`Target::Resume`] or [`Target::Suspend`] through
    /// computations only.
    pub resumes: bool,
    /// Whether it is a computation that can reach [`Target::Return`] through computations only.
    pub returns: bool,
    /// Whether some edge is a [`Target::Suspend`] to it.
    pub handler: bool,
    /// The local supervisors in [`PlanTable::supervisors`].
    pub locals: Range,
    /// The supervisors polled while it is active, in order, in [`PlanTable::sweeps`].
    pub sweep: Range,
    /// The ids of a sub-plan; otherwise zero.
    pub child: Child,
}

/// A supervisor. Global supervisors come first, then the local ones, element by element. Extra rows
/// follow for global supervisors with other wanted events or targets at some element.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SupervisorRow {
    /// The supervisor.
    pub instance: SupervisorId,
    /// The timing of its polls.
    pub timing: Timing,
    /// The slot of its releases: the number of a global supervisor; for a local one the number of
    /// globals plus its position in its element.
    pub slot: u16,
    /// The events in [`PlanTable::edges`].
    pub events: Range,
    /// The `DeadlineMissed` edge.
    pub on_miss: Option<Target>,
    /// The events that would be taken: not ignored, and with a target that is not active.
    pub wanted: Events,
    /// The same in the look, in which an element's own supervisors do not restart it.
    pub wanted_in_look: Events,
}

/// All rows of one plan; `R` is the reason of an edge to `fail`. An invalid index gives `None`,
/// never a panic.
#[derive(Clone, Copy, Debug)]
pub struct PlanTable<'a, R> {
    /// The first element.
    pub start: ElementId,
    /// Number of global supervisors.
    pub globals: u16,
    /// Number of entries.
    pub entries: u16,
    /// The elements.
    pub elements: &'a [ElementRow],
    /// The supervisors.
    pub supervisors: &'a [SupervisorRow],
    /// The reasons of edges to `fail`.
    pub reasons: &'a [R],
    /// Targets of states and events; `None` for an unreachable state.
    pub edges: &'a [Option<Target>],
    /// For each element, the rows of its supervisors and of the global supervisors in polling
    /// order.
    pub sweeps: &'a [u16],
}

impl Range {
    /// The indices.
    #[inline]
    pub fn indices(self) -> core::ops::Range<usize> {
        let first = usize::from(self.first);
        first..first + usize::from(self.len)
    }

    /// The supervisors in this range of [`PlanTable::supervisors`].
    #[inline]
    pub fn supervisors(self) -> impl Iterator<Item = SupervisorId> {
        (self.first..self.first.saturating_add(self.len)).map(SupervisorId)
    }
}

impl Events {
    /// Makes a set from bits: bit `n` is the template's `n`-th event.
    pub const fn from_bits(bits: u64) -> Self {
        Events(bits)
    }

    /// The bits.
    pub const fn bits(self) -> u64 {
        self.0
    }

    /// Whether it contains the template's `n`-th event.
    pub const fn contains(self, n: u16) -> bool {
        n < 64 && self.0 >> n & 1 == 1
    }
}

impl<'a, R> PlanTable<'a, R> {
    /// Number of slots for supervisors: globals plus the largest number of locals.
    pub fn slots(&self) -> usize {
        let locals = self.elements.iter().map(|row| row.locals.len).max().unwrap_or(0);
        usize::from(self.globals) + usize::from(locals)
    }

    /// Whether a supervisor is global.
    #[inline]
    pub fn is_global(&self, supervisor: SupervisorId) -> bool {
        supervisor.0 < self.globals
    }

    /// An element's row.
    #[inline]
    pub fn element(&self, element: ElementId) -> Option<&'a ElementRow> {
        self.elements.get(element.index())
    }

    /// A row of a supervisor; the first rows are in the order of the supervisors.
    #[inline]
    pub fn supervisor(&self, row: u16) -> Option<&'a SupervisorRow> {
        self.supervisors.get(usize::from(row))
    }

    /// The target of the `n`-th edge of a run.
    #[inline]
    pub fn edge(&self, edges: Range, n: u16) -> Option<Target> {
        if n >= edges.len {
            return None;
        }
        let index = usize::from(edges.first) + usize::from(n);
        self.edges.get(index).copied().flatten()
    }

    /// The rows of the supervisors polled while an element is active.
    #[inline]
    pub fn sweep(&self, row: &ElementRow) -> &'a [u16] {
        self.sweeps.get(row.sweep.indices()).unwrap_or(&[])
    }
}
