//! What stands in plan files, whole or broken: what drawings, editors and completion read.
//!
//! The graph is for running and comes without errors alone; the outline comes for any text. An
//! element that parses is in it: one with an unknown template has the ports that are written, an
//! edge to nothing has a target without element, an input that nobody binds is a hole, a file
//! without a plan is an empty list. Everything is plain data with its spans and with what is wrong
//! with it.
//!
//! An item goes by its [`Item`] path, which names say. Where a name is there twice in one scope, the
//! second one has `#2` behind it, and so on; one without a name is `#1`, since no name begins so.
//! States, events and ports of one component are told apart by [`Exit::nth`] and [`Input::nth`].

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
            /// The index, to be used on the list it belongs to.
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

/// What stands in the plan files of a compilation.
#[derive(Clone, Debug, Default)]
pub struct Outline {
    /// The files: the one that was compiled, then those that it uses, directly or through others.
    pub files: Vec<File>,
    /// The plans of all files, file by file, as written.
    pub plans: Vec<Plan>,
    /// The plan that was asked for, or the first one.
    pub main: Option<PlanId>,
}

#[derive(Clone, Debug, Default)]
pub struct File {
    /// The file, as [`Span::file`] says it.
    pub file: u16,
    /// Its normalised path.
    pub path: String,
    /// Its `use` lines as written.
    pub uses: Vec<Use>,
    pub enums: Vec<Enum>,
    pub tables: Vec<Table>,
    /// The valid computations that it and the files that it uses declare: a toolbox without a name
    /// for each of these files, its own first.
    pub computations: Vec<Arc<Toolbox>>,
    pub plans: Vec<PlanId>,
    pub scenarios: Vec<Scenario>,
    /// What there is to say about nothing smaller.
    pub findings: Findings,
}

/// `use carbot as c` or `use "other.afp"`
#[derive(Clone, Debug)]
pub struct Use {
    pub span: Span,
    pub toolbox: Option<Name>,
    /// The short name behind `as`.
    pub alias: Option<Name>,
    /// The file's path, quotes included.
    pub path: Option<Name>,
    /// The file that is used, where it can be read.
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
    /// The whole of it, without comments around it.
    pub span: Span,
    /// The names of its values.
    pub variants: Vec<Name>,
    /// What there is to say about it.
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
    /// The whole of it, without comments around it.
    pub span: Span,
    pub columns: Vec<Column>,
    /// What there is to say about it.
    pub findings: Findings,
}

/// A column of a table.
#[derive(Clone, Debug)]
pub struct Column {
    pub name: Name,
    /// Its `///` lines.
    pub doc: String,
    /// The whole of it.
    pub span: Span,
    /// Its type, where that is known.
    pub ty: Option<Type>,
}

/// The head of a scenario.
#[derive(Clone, Debug)]
pub struct Scenario {
    /// Its name, quotes included.
    pub name: Option<Name>,
    /// The whole of it, without comments around it.
    pub span: Span,
    /// The plan behind `for`, where there is one of that name.
    pub plan: Option<PlanId>,
    /// What there is to say about it.
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
    /// The whole of it, without comments around it.
    pub span: Span,
    pub entries: Vec<Entry>,
    /// Its `start` lines; there should be one.
    pub starts: Vec<Start>,
    /// Global supervisors as written.
    pub supervisors: Vec<Component>,
    /// Actors, computations and sub-plans as written.
    pub elements: Vec<Component>,
    /// Whether an event or `DeadlineMissed` edge leads to `terminate`, so that the plan can end as
    /// `Interrupted`.
    pub interruptible: bool,
    /// Whether it says that it is meant to run on.
    pub forever: bool,
    /// What there is to say about nothing smaller.
    pub findings: Findings,
}

/// `start first`
#[derive(Clone, Debug)]
pub struct Start {
    pub span: Span,
    /// Where it leads.
    pub target: Option<Target>,
    /// What there is to say about it.
    pub findings: Findings,
}

/// An entry of a plan.
#[derive(Clone, Debug)]
pub struct Entry {
    pub item: Item,
    /// Who may set it.
    pub kind: EntryKind,
    /// Whether it is `in live`.
    pub live: bool,
    pub name: Option<Name>,
    /// Its `///` lines.
    pub doc: String,
    /// The comment above it.
    pub note: String,
    /// The whole of it, without comments around it.
    pub span: Span,
    pub written_type: Option<Name>,
    /// Its type, written or that of its value, where it is known.
    pub ty: Option<Type>,
    pub init: Option<Value>,
    /// Least and greatest value as written.
    pub range: Option<[Value; 2]>,
    /// What there is to say about it.
    pub findings: Findings,
}

/// What the compiler has to say about an item or a part of it: mostly nothing, which takes no memory.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Findings(Option<Box<Found>>);

/// What there is to say.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Found {
    worst: Severity,
    list: Vec<u32>,
}

impl Findings {
    pub fn worst(&self) -> Option<Severity> {
        self.0.as_ref().map(|found| found.worst)
    }

    /// Where it stands among the diagnostics of the compilation.
    pub fn list(&self) -> &[u32] {
        self.0.as_ref().map_or(&[], |found| &found.list)
    }
}
