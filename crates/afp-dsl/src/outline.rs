//! The content of plan files, valid or not, for drawings, editors and completion.
//!
//! A valid plan has a graph; any text has an outline. Everything that parses is in it. An element
//! with an unknown template has its written ports, and an edge without a valid target has no
//! element. An unbound input is a hole. Everything is plain data with its spans and its
//! diagnostics.
//!
//! [`Item`] paths identify items by name. The second item of a name in a scope gets the suffix
//! `#2`, and so on. An item without a name is `#1`, because no name starts with `#`. [`Exit::nth`]
//! and [`Input::nth`] number the states, events and ports of a component.

mod component;
mod findings;
mod identity;
mod look_up;

use std::sync::Arc;

use crate::graph::EntryKind;
use crate::toolbox::Toolbox;
use crate::types::Type;
use afp_syntax::ast::Name;
use afp_syntax::diagnostics::Severity;
use afp_syntax::item::Item;
use afp_syntax::source::Span;

pub(crate) use component::SUSPEND;
pub use component::{
    Binding, Component, ComponentKind, Destination, Edge, Exit, ExitKind, Input, MadeFrom, Output,
    Target, TemplateUse, Times, Value,
};
pub use identity::{Identity, Part};

macro_rules! index {
    ($($(#[$doc:meta])* $name:ident),* $(,)?) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub struct $name(pub u32);

        impl $name {
            /// The index into its list.
            pub fn index(self) -> usize {
                self.0 as usize
            }

            pub(crate) fn new(index: usize) -> $name {
                $name(u32::try_from(index).unwrap_or(u32::MAX))
            }
        }
    )*};
}

index! {
    /// A plan of [`Outline::plans`].
    PlanId,
    /// An entry of [`Plan::entries`].
    EntryId,
    /// An element of [`Plan::elements`].
    ElementId,
}

/// The content of the plan files of a compilation.
#[derive(Clone, Debug, Default)]
pub struct Outline {
    /// The files: first the compiled file, then the files that it uses, directly or indirectly.
    pub files: Vec<File>,
    /// The plans of all files, in source order.
    pub plans: Vec<Plan>,
    /// The requested plan, or the first one.
    pub main: Option<PlanId>,
}

#[derive(Clone, Debug, Default)]
pub struct File {
    /// The file, as in [`Span::file`].
    pub file: u16,
    /// Its normalised path.
    pub path: String,
    /// Its `use` lines, in source order.
    pub uses: Vec<Use>,
    pub enums: Vec<Enum>,
    pub tables: Vec<Table>,
    /// The valid computations that the file and the files that it uses declare: one toolbox without
    /// a name for each file, its own first.
    pub computations: Vec<Arc<Toolbox>>,
    pub plans: Vec<PlanId>,
    pub scenarios: Vec<Scenario>,
    /// Diagnostics that belong to no smaller part.
    pub findings: Findings,
}

/// `use carbot as c` or `use "other.afp"`
#[derive(Clone, Debug)]
pub struct Use {
    pub span: Span,
    pub toolbox: Option<Name>,
    /// The short name after `as`.
    pub alias: Option<Name>,
    /// The file's path, quotes included.
    pub path: Option<Name>,
    /// The used file, if it is readable.
    pub file: Option<u16>,
}

/// An enum of a file.
#[derive(Clone, Debug)]
pub struct Enum {
    pub item: Item,
    pub name: Option<Name>,
    /// Its `///` lines.
    pub doc: String,
    /// The comment above it.
    pub note: String,
    /// Its span, without surrounding comments.
    pub span: Span,
    pub variants: Vec<Name>,
    /// Its diagnostics.
    pub findings: Findings,
}

/// A table of a file, without its rows.
#[derive(Clone, Debug)]
pub struct Table {
    pub item: Item,
    pub name: Option<Name>,
    /// Its `///` lines.
    pub doc: String,
    /// The comment above it.
    pub note: String,
    /// Its span, without surrounding comments.
    pub span: Span,
    pub columns: Vec<Column>,
    /// Its diagnostics.
    pub findings: Findings,
}

/// A column of a table.
#[derive(Clone, Debug)]
pub struct Column {
    pub name: Name,
    /// Its `///` lines.
    pub doc: String,
    pub span: Span,
    /// Its type, if known.
    pub ty: Option<Type>,
}

/// The head of a scenario.
#[derive(Clone, Debug)]
pub struct Scenario {
    /// Its name, quotes included.
    pub name: Option<Name>,
    /// Its span, without surrounding comments.
    pub span: Span,
    /// The plan after `for`, if it exists.
    pub plan: Option<PlanId>,
    /// Its diagnostics.
    pub findings: Findings,
}

#[derive(Clone, Debug)]
pub struct Plan {
    pub item: Item,
    pub name: Option<Name>,
    /// Its `///` lines.
    pub doc: String,
    /// The comment above it.
    pub note: String,
    /// Its span, without surrounding comments.
    pub span: Span,
    pub entries: Vec<Entry>,
    /// Its `start` lines; a valid plan has one.
    pub starts: Vec<Start>,
    /// Global supervisors, in source order.
    pub supervisors: Vec<Component>,
    /// Actors, computations and sub-plans, in source order.
    pub elements: Vec<Component>,
    /// Whether an event or `DeadlineMissed` edge leads to `terminate`, so that the plan can end as
    /// `Interrupted`.
    pub interruptible: bool,
    /// Whether the plan is declared `forever`.
    pub forever: bool,
    /// Diagnostics that belong to no smaller part.
    pub findings: Findings,
}

/// `start first`
#[derive(Clone, Debug)]
pub struct Start {
    pub span: Span,
    pub target: Option<Target>,
    /// Its diagnostics.
    pub findings: Findings,
}

/// An entry of a plan.
#[derive(Clone, Debug)]
pub struct Entry {
    pub item: Item,
    /// The kind, which decides who may write it.
    pub kind: EntryKind,
    /// Whether it is `in live`.
    pub live: bool,
    pub name: Option<Name>,
    /// Its `///` lines.
    pub doc: String,
    /// The comment above it.
    pub note: String,
    /// Its span, without surrounding comments.
    pub span: Span,
    pub written_type: Option<Name>,
    /// Its declared type, or the type of its value, if known.
    pub ty: Option<Type>,
    pub init: Option<Value>,
    /// The limits, in source form.
    pub range: Option<[Value; 2]>,
    /// Its diagnostics.
    pub findings: Findings,
}

/// The diagnostics of an item or of a part of it. An empty list takes no memory.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Findings(Option<Box<Found>>);

/// The diagnostics.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Found {
    worst: Severity,
    list: Vec<u32>,
}

impl Findings {
    pub fn worst(&self) -> Option<Severity> {
        self.0.as_ref().map(|found| found.worst)
    }

    /// The index in the diagnostics of the compilation.
    pub fn list(&self) -> &[u32] {
        self.0.as_ref().map_or(&[], |found| &found.list)
    }
}
