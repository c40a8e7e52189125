//! The static graph: what a checked plan is.
//!
//! Interpreter, Rust back end, drawings, editor and language server read this and nothing else.
//! Everything is resolved: names are indices, conversions are nodes of the formulas, defaults are
//! filled in, polling order is fixed. A plan with errors has no graph.

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
pub(crate) use resume::{chain, resuming};

/// Where an edge leads in a running plan; elements go by their numbers.
pub type Goal = Target<u32, ()>;

/// All plans that one plan needs, itself included.
#[derive(Clone, Debug)]
pub struct Graph {
    /// Sub-plans stand before the plans that use them.
    pub plans: Vec<Plan>,
    pub main: PlanId,
    /// The toolboxes in use, in the order in which the files name them.
    pub toolboxes: Vec<Arc<Toolbox>>,
    /// The tables that the scheduler reads, one for each of [`Graph::plans`].
    pub rows: Vec<Arc<Rows>>,
    /// The plan files, each with the number by which spans name it.
    pub sources: Vec<(u16, Arc<Source>)>,
}

/// One plan: elements, supervisors, entries.
#[derive(Clone, Debug)]
pub struct Plan {
    /// Its name in the text. Plans of one name, from files that do not see each other, have `_2` and
    /// so on behind it, but not the main plan.
    pub name: String,
    /// The file that it stands in, seen from the folder of the main plan's file; `None` in that file
    /// itself.
    pub file: Option<String>,
    /// Its `///` lines, without the slashes.
    pub doc: String,
    pub entries: Vec<Entry>,
    /// Actors, computations and sub-plans as written.
    pub elements: Vec<Element>,
    /// The global supervisors as written, then the local ones, element by element.
    pub supervisors: Vec<Supervisor>,
    /// How many of [`Plan::supervisors`] are global.
    pub globals: u16,
    pub start: ElementId,
    /// Why edges to `fail` end the plan: each text once.
    pub reasons: Vec<String>,
    /// Whether an event or `DeadlineMissed` edge leads to `terminate`, so that the plan can end as
    /// `Interrupted`.
    pub interruptible: bool,
    /// Whether it is meant to run until something happens to it.
    pub forever: bool,
    /// The name in the text.
    pub span: Span,
    /// The name behind `start`.
    pub start_span: Span,
}

/// A named value of the configuration.
#[derive(Clone, Debug)]
pub struct Entry {
    pub name: String,
    /// Its `///` lines.
    pub doc: String,
    /// Who may set it.
    pub kind: EntryKind,
    /// Whether an `in` entry is given its value anew before each step of the sub-plan.
    pub live: bool,
    /// Its type; never `any` or `number`.
    pub ty: Type,
    /// Its initial value, of type [`Entry::ty`].
    pub init: Option<Formula>,
    /// That value, where it is the same in every run; it is of the range.
    pub value: Option<Constant>,
    /// Least and greatest value, in SI units; both belong to it.
    pub range: Option<(f64, f64)>,
    /// The constants that the range is made of.
    pub ranged_by: Vec<EntryId>,
    /// The name in the text.
    pub span: Span,
}

/// An actor, a computation or a sub-plan.
#[derive(Clone, Debug)]
pub struct Element {
    pub name: String,
    /// Its `///` lines.
    pub doc: String,
    /// What it is made from.
    pub component: Component,
    /// The type that stands for `any` or `number` in its template.
    pub generic: Option<Type>,
    /// One formula for each input port of the template (for each `in` entry of a sub-plan), in
    /// their order, of the port's type.
    pub inputs: Vec<Formula>,
    /// The connected outputs.
    pub outputs: Vec<Output>,
    /// One target for each state of the template, in its order; of a sub-plan `OK` and
    /// `Interrupted`, the latter `None` where it cannot happen and was not connected.
    pub states: Vec<Option<Target>>,
    /// Where `Error` leads; unconnected it ends the plan.
    pub on_error: Option<Target>,
    /// Its local supervisors, as written.
    pub supervisors: Vec<SupervisorId>,
    /// Its reactions to global supervisors, as written; at most one set for each.
    pub reactions: Vec<Reactions>,
    /// The name in the text.
    pub span: Span,
    /// Where its edges stand in the text.
    pub edges: EdgeSpans,
}

/// Where the edges of a component stand in the text.
#[derive(Clone, Debug, Default)]
pub struct EdgeSpans {
    /// One place for each state or event, in the order of the targets; `None` where it is not
    /// connected.
    pub outcomes: Vec<Option<Span>>,
    /// The place of `Error` or `DeadlineMissed`.
    pub extra: Option<Span>,
}

/// What an element is made from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Component {
    Actor(TemplateId),
    Computation(TemplateId),
    /// A plan used like an actor.
    SubPlan(PlanId),
}

/// A template of a toolbox.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct TemplateId {
    pub toolbox: ToolboxId,
    /// Which of [`Toolbox::templates`].
    pub index: u16,
}

/// A supervisor, global or local.
#[derive(Clone, Debug)]
pub struct Supervisor {
    pub name: String,
    /// Its `///` lines.
    pub doc: String,
    /// The element it belongs to; `None` for a global one.
    pub owner: Option<ElementId>,
    /// What it is made from.
    pub template: TemplateId,
    /// The type that stands for `any` or `number` in its template.
    pub generic: Option<Type>,
    /// One formula for each input port of the template.
    pub inputs: Vec<Formula>,
    /// The connected outputs.
    pub outputs: Vec<Output>,
    /// One target for each event of the template.
    pub events: Vec<Target>,
    /// Where `DeadlineMissed` leads.
    pub on_miss: Option<Target>,
    /// When it is polled.
    pub timing: Timing,
    /// The constants that its times are.
    pub timed_by: Vec<EntryId>,
    /// Where `every` is written, if it is.
    pub every_span: Option<Span>,
    /// The name in the text.
    pub span: Span,
    /// Where its edges stand in the text.
    pub edges: EdgeSpans,
}

/// An output port bound to an entry.
#[derive(Clone, Debug)]
pub struct Output {
    /// Index of the template's output port (of the sub-plan's `out` entries, counted among
    /// themselves).
    pub port: u16,
    pub entry: EntryId,
    /// How the port's value becomes the entry's.
    pub conversion: Option<Conversion>,
    /// Where the entry is named.
    pub span: Span,
}

impl Element {
    /// Whether it is an actor or a sub-plan, so that supervisors watch it.
    pub(crate) fn takes_time(&self) -> bool {
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

    /// The tables of a plan by index.
    pub fn rows(&self, id: PlanId) -> &Arc<Rows> {
        &self.rows[id.index()]
    }

    pub fn template(&self, id: TemplateId) -> &Template {
        &self.toolboxes[id.toolbox.index()].templates[usize::from(id.index)]
    }
}
