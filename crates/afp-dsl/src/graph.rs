//! The static graph: the result of checking a plan.
//!
//! Interpreter, Rust back end, drawings, editor and language server read only this. Everything is
//! resolved: names are indices, conversions are nodes of formulas, defaults are filled in, polling
//! order is fixed. A plan with errors has no graph.

pub(crate) mod constant;
mod dump;
mod formula;
mod reactions;
mod resume;
mod values;

use std::sync::Arc;

use crate::rows::Rows;
use crate::toolbox::{Template, Toolbox};
use crate::types::{Constant, Conversion, Type};
use afp_syntax::source::{Source, Span};

pub use afp_types::{
    ElementId, EntryId, EntryKind, Function, Op, Operator, PlanId, ReasonId, SupervisorId, Target,
    Timing, ToolboxId,
};
pub use formula::{Formula, Node, Note, Part};
pub use reactions::Reactions;
pub(crate) use resume::{chain, resuming, returning};

/// Target of an edge in a running plan, with the element's number.
pub type Goal = Target<u32, ()>;

/// A plan with all of its sub-plans.
#[derive(Clone, Debug)]
pub struct Graph {
    /// Sub-plans before their users.
    pub plans: Vec<Plan>,
    pub main: PlanId,
    /// Used toolboxes, in the order of the files.
    pub toolboxes: Vec<Arc<Toolbox>>,
    /// The scheduler's tables, one for each of [`Graph::plans`].
    pub rows: Vec<Arc<Rows>>,
    /// The plan files, with their numbers in spans.
    pub sources: Vec<(u16, Arc<Source>)>,
    /// The moment of another run at which the next run begins; generated code ignores it.
    pub moment: Option<Moment>,
}

/// A moment of a plan: the values of its entries, and its active element.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Moment {
    /// Values that replace the initial values.
    pub entries: Vec<(EntryId, Constant)>,
    /// The element that starts first, if it is not the plan's first.
    pub element: Option<ElementId>,
    /// The moment inside this element, if it is a sub-plan.
    pub inner: Option<Box<Moment>>,
}

#[derive(Clone, Debug)]
pub struct Plan {
    /// Its name. Equal names from files that do not see each other get a suffix `_2` and so on,
    /// except for the main plan.
    pub name: String,
    /// Its file, relative to the main plan's folder; `None` for the main file.
    pub file: Option<String>,
    /// Its `///` lines, without slashes.
    pub doc: String,
    pub entries: Vec<Entry>,
    /// Actors, computations and sub-plans in source order.
    pub elements: Vec<Element>,
    /// Global supervisors in source order, then the local ones, element by element.
    pub supervisors: Vec<Supervisor>,
    /// Number of global supervisors in [`Plan::supervisors`].
    pub globals: u16,
    pub start: ElementId,
    /// Reasons of `fail`, each once.
    pub reasons: Vec<String>,
    /// Whether an event or `DeadlineMissed` edge leads to `terminate`, so that the plan can end as
    /// `Interrupted`.
    pub interruptible: bool,
    /// Whether it should run until an event ends it.
    pub forever: bool,
    pub span: Span,
    /// The name after `start`.
    pub start_span: Span,
}

#[derive(Clone, Debug)]
pub struct Entry {
    pub name: String,
    /// Its `///` lines.
    pub doc: String,
    pub kind: EntryKind,
    /// Whether an `in` entry is updated before each step of the sub-plan.
    pub live: bool,
    /// Its type; never `any` or `number`.
    pub ty: Type,
    /// Its initial value, of type [`Entry::ty`].
    pub init: Option<Formula>,
    /// The initial value if it is constant; it is in range.
    pub value: Option<Constant>,
    /// Minimum and maximum, inclusive, in SI units.
    pub range: Option<(f64, f64)>,
    /// The constants in the range.
    pub ranged_by: Vec<EntryId>,
    pub span: Span,
}

#[derive(Clone, Debug)]
pub struct Element {
    pub name: String,
    /// Its `///` lines.
    pub doc: String,
    pub component: Component,
    /// The type of `any` or `number` in its template.
    pub generic: Option<Type>,
    /// A formula for each input port of the template (each `in` entry of a sub-plan), in order, of
    /// the port's type.
    pub inputs: Vec<Formula>,
    pub outputs: Vec<Output>,
    /// A target for each state of the template, in order; for a sub-plan `OK` and `Interrupted`,
    /// the latter `None` if it is impossible and unconnected.
    pub states: Vec<Option<Target>>,
    /// Target of `Error`; unconnected it ends the plan.
    pub on_error: Option<Target>,
    /// Its local supervisors, in source order.
    pub supervisors: Vec<SupervisorId>,
    /// Its reactions to global supervisors, in source order; at most one set for each.
    pub reactions: Vec<Reactions>,
    pub span: Span,
    pub edges: EdgeSpans,
}

/// Source places of a component's edges.
#[derive(Clone, Debug, Default)]
pub struct EdgeSpans {
    /// A place for each state or event, in the order of targets; `None` if unconnected.
    pub outcomes: Vec<Option<Span>>,
    /// The place of `Error` or `DeadlineMissed`.
    pub extra: Option<Span>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Component {
    Actor(TemplateId),
    Computation(TemplateId),
    SubPlan(PlanId),
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct TemplateId {
    pub toolbox: ToolboxId,
    /// Index in [`Toolbox::templates`].
    pub index: u16,
}

#[derive(Clone, Debug)]
pub struct Supervisor {
    pub name: String,
    /// Its `///` lines.
    pub doc: String,
    /// Its element; `None` for a global one.
    pub owner: Option<ElementId>,
    pub template: TemplateId,
    /// The type of `any` or `number` in its template.
    pub generic: Option<Type>,
    /// A formula for each input port of the template.
    pub inputs: Vec<Formula>,
    pub outputs: Vec<Output>,
    pub events: Vec<Target>,
    /// Target of `DeadlineMissed`.
    pub on_miss: Option<Target>,
    pub timing: Timing,
    /// The constants in its times.
    pub timed_by: Vec<EntryId>,
    pub every_span: Option<Span>,
    pub span: Span,
    pub edges: EdgeSpans,
}

#[derive(Clone, Debug)]
pub struct Output {
    /// Index of the template's output port, or of the sub-plan's `out` entry among these.
    pub port: u16,
    pub entry: EntryId,
    /// Conversion of the port's value to the entry.
    pub conversion: Option<Conversion>,
    /// The entry's name in the binding.
    pub span: Span,
}

impl Element {
    /// Whether it is an actor or a sub-plan, which supervisors can watch.
    pub fn takes_time(&self) -> bool {
        !matches!(self.component, Component::Computation(_))
    }
}

impl Graph {
    pub fn main(&self) -> &Plan {
        &self.plans[self.main.index()]
    }

    pub fn plan(&self, id: PlanId) -> &Plan {
        &self.plans[id.index()]
    }

    pub fn rows(&self, id: PlanId) -> &Arc<Rows> {
        &self.rows[id.index()]
    }

    pub fn template(&self, id: TemplateId) -> &Template {
        &self.toolboxes[id.toolbox.index()].templates[usize::from(id.index)]
    }
}
