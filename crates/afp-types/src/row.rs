//! The rows that the compiler lowers and the scheduler reads.
//!
//! The compiler owns them in vectors, generated code in statics. Both lend them as a [`PlanTable`].

use crate::{Duration, ElementId, SupervisorId, Target};

/// What an element is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ElementKind {
    /// An actor.
    Actor,
    /// A computation.
    Computation,
    /// A sub-plan.
    SubPlan,
}

/// A run of rows in another table.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Range {
    /// Index of the first.
    pub first: u16,
    /// How many.
    pub len: u16,
}

/// Where the ids of a sub-plan begin, counted from the first id of the plan that uses it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Child {
    /// Offset of its component ids.
    pub components: u32,
    /// Offset of its entry ids.
    pub entries: u32,
}

/// When a supervisor is polled, and how long a poll may take.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Timing {
    /// Poll period, above zero.
    pub period: Duration,
    /// Deadline after each release.
    pub deadline: Duration,
    /// Declared bound of one poll; zero if none is declared.
    pub budget: Duration,
}

/// Events of a supervisor, by position in its template.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Events(u64);

/// One element.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ElementRow {
    /// What it is.
    pub kind: ElementKind,
    /// Poll period of an actor; zero for computations and sub-plans.
    pub period: Duration,
    /// Its states in [`PlanTable::edges`].
    pub states: Range,
    /// Its `Error` edge.
    pub on_error: Option<Target>,
    /// Whether it is a computation from which computations alone can lead to [`Target::Resume`].
    pub resumes: bool,
    /// Its local supervisors in [`PlanTable::supervisors`].
    pub locals: Range,
    /// The supervisors polled while it is active, in order, in [`PlanTable::sweeps`].
    pub sweep: Range,
    /// Its ids; zero unless it is a sub-plan.
    pub child: Child,
}

/// One supervisor. The global ones come first, then the local ones, element by element. Then follow
/// rows for global ones of which an element wants other events than most do, or whose events lead
/// elsewhere while it is active.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SupervisorRow {
    /// Which supervisor it is.
    pub instance: SupervisorId,
    /// When it is polled.
    pub timing: Timing,
    /// Where it keeps its releases: its own number for a global one, and for a local one the
    /// number of globals plus its position in its element.
    pub slot: u16,
    /// Its events in [`PlanTable::edges`].
    pub events: Range,
    /// Its `DeadlineMissed` edge.
    pub on_miss: Option<Target>,
    /// The events that would be taken: those that are not ignored and do not lead to where the plan
    /// is already.
    pub wanted: Events,
    /// The same in the look, where an element's own supervisors do not start it again.
    pub wanted_in_look: Events,
}

/// All rows of one plan; `R` says why an edge to `fail` ends it. Reading a row that does not exist
/// gives `None`, never a panic.
#[derive(Clone, Copy, Debug)]
pub struct PlanTable<'a, R> {
    /// The first element.
    pub start: ElementId,
    /// How many supervisors are global.
    pub globals: u16,
    /// How many entries there are.
    pub entries: u16,
    /// The elements.
    pub elements: &'a [ElementRow],
    /// The supervisors.
    pub supervisors: &'a [SupervisorRow],
    /// Why edges to `fail` end the plan.
    pub reasons: &'a [R],
    /// Where states and events lead; `None` where a state cannot be reached.
    pub edges: &'a [Option<Target>],
    /// For each element, the rows of its supervisors and of the global ones in polling order.
    pub sweeps: &'a [u16],
}

impl Range {
    /// The indices.
    #[inline]
    pub fn indices(self) -> core::ops::Range<usize> {
        let first = usize::from(self.first);
        first..first + usize::from(self.len)
    }

    /// The supervisors, for a run in [`PlanTable::supervisors`].
    #[inline]
    pub fn supervisors(self) -> impl Iterator<Item = SupervisorId> {
        (self.first..self.first.saturating_add(self.len)).map(SupervisorId)
    }
}

impl Events {
    /// A set from its bits: bit `n` is the template's `n`-th event.
    pub const fn from_bits(bits: u64) -> Self {
        Events(bits)
    }

    /// The bits.
    pub const fn bits(self) -> u64 {
        self.0
    }

    /// Whether the template's `n`-th event is one of them.
    pub const fn contains(self, n: u16) -> bool {
        n < 64 && self.0 >> n & 1 == 1
    }
}

impl<'a, R> PlanTable<'a, R> {
    /// How many slots the supervisors need: the global ones and those of the richest element.
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
