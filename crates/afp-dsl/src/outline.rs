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

mod build;
mod component;
mod findings;
mod identity;
mod look_up;

use std::sync::Arc;

use crate::graph::EntryKind;
use crate::toolbox::{Constant, Toolbox};
use crate::types::Type;
use afp_syntax::ast::Name;
use afp_syntax::diagnostics::Severity;
use afp_syntax::item::Item;
use afp_syntax::source::Span;

pub(crate) use build::{Material, build};
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

            fn new(index: usize) -> $name {
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

/// A plan file.
#[derive(Clone, Debug, Default)]
pub struct File {
    /// The file, as [`Span::file`] says it.
    pub file: u16,
    /// Its normalised path.
    pub path: String,
    /// Its `use` lines as written.
    pub uses: Vec<Use>,
    /// Its enums as written.
    pub enums: Vec<Enum>,
    /// Its plans as written.
    pub plans: Vec<PlanId>,
    /// Its scenarios as written.
    pub scenarios: Vec<Scenario>,
    /// What there is to say about nothing smaller.
    pub findings: Findings,
}

/// `use carbot as c` or `use "other.afp"`
#[derive(Clone, Debug)]
pub struct Use {
    /// The line.
    pub span: Span,
    /// The toolbox's name.
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
    /// Which item it is.
    pub item: Item,
    /// Its name.
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

/// A plan.
#[derive(Clone, Debug)]
pub struct Plan {
    /// Which item it is.
    pub item: Item,
    /// Its name.
    pub name: Option<Name>,
    /// Its `///` lines.
    pub doc: String,
    /// The comment above it.
    pub note: String,
    /// The whole of it, without comments around it.
    pub span: Span,
    /// Entries as written.
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
    /// What there is to say about nothing smaller.
    pub findings: Findings,
}

/// `start first`
#[derive(Clone, Debug)]
pub struct Start {
    /// The line.
    pub span: Span,
    /// Where it leads.
    pub target: Option<Target>,
    /// What there is to say about it.
    pub findings: Findings,
}

/// An entry of a plan.
#[derive(Clone, Debug)]
pub struct Entry {
    /// Which item it is.
    pub item: Item,
    /// Who may set it.
    pub kind: EntryKind,
    /// Its name.
    pub name: Option<Name>,
    /// Its `///` lines.
    pub doc: String,
    /// The comment above it.
    pub note: String,
    /// The whole of it, without comments around it.
    pub span: Span,
    /// Its type as written.
    pub written_type: Option<Name>,
    /// Its type, written or that of its value, where it is known.
    pub ty: Option<Type>,
    /// Its initial value.
    pub init: Option<Value>,
    /// What there is to say about it.
    pub findings: Findings,
}

/// An element or a supervisor.
#[derive(Clone, Debug)]
pub struct Component {
    /// Which item it is.
    pub item: Item,
    /// What its keyword says.
    pub kind: ComponentKind,
    /// Its name.
    pub name: Option<Name>,
    /// Its `///` lines.
    pub doc: String,
    /// The comment above it.
    pub note: String,
    /// The whole of it, without comments around it.
    pub span: Span,
    /// What it is made from.
    pub template: Option<TemplateUse>,
    /// The type that stands for `any` or `number` in its template, where that is decided.
    pub generic: Option<Type>,
    /// The inputs of its template in their order, then what is bound and is none of them.
    pub inputs: Vec<Input>,
    /// The outputs of its template in their order, then what is bound and is none of them.
    pub outputs: Vec<Output>,
    /// The states or events of its template in their order, then `Error` or `DeadlineMissed` where
    /// it is connected, then edges of states and events that are none of them.
    pub exits: Vec<Exit>,
    /// Its local supervisors as written.
    pub supervisors: Vec<Component>,
    /// When it is polled; supervisors only.
    pub times: Option<Times>,
    /// The place of the brackets with its bindings.
    pub args_span: Option<Span>,
    /// The place of its closing brace.
    pub end_span: Option<Span>,
    /// What there is to say about nothing smaller.
    pub findings: Findings,
}

/// What an element or supervisor is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ComponentKind {
    /// Acts over time.
    Actor,
    /// Computes at once.
    Computation,
    /// A plan used like an actor.
    SubPlan,
    /// Watches.
    Supervisor,
}

/// What a component is made from.
#[derive(Clone, Debug)]
pub struct TemplateUse {
    /// The name as written, with what qualifies it.
    pub text: String,
    /// Its place.
    pub span: Span,
    /// The place of the name alone.
    pub name_span: Span,
    /// What it means; `None` where that is unknown, ambiguous or does not fit the keyword.
    pub made_from: Option<MadeFrom>,
}

/// A template or a plan.
#[derive(Clone, Debug)]
pub enum MadeFrom {
    /// A template of a toolbox.
    Template {
        /// The toolbox.
        toolbox: Arc<Toolbox>,
        /// Which of [`Toolbox::templates`].
        index: usize,
    },
    /// A plan.
    Plan(PlanId),
}

/// When a supervisor is polled.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Times {
    /// Poll period in nanoseconds.
    pub every: u64,
    /// Deadline after each release in nanoseconds.
    pub deadline: u64,
    /// Where `every` is written, if it is.
    pub every_span: Option<Span>,
    /// Where `deadline` is written, if it is.
    pub deadline_span: Option<Span>,
}

/// An input port.
#[derive(Clone, Debug)]
pub struct Input {
    /// The port's name.
    pub name: String,
    /// Which binding of that port it is: 1, unless it is bound several times.
    pub nth: u16,
    /// Its declaration; `None` where the template has no such input, or is unknown.
    pub declared: Option<Span>,
    /// Its type in this component.
    pub ty: Option<Type>,
    /// Whether something is missing while it is not bound.
    pub required: bool,
    /// Its value when it is not bound, where that is known.
    pub default: Option<Constant>,
    /// Least and greatest value.
    pub range: Option<(f64, f64)>,
    /// What it is bound to.
    pub binding: Option<Binding>,
    /// What there is to say about it.
    pub findings: Findings,
}

/// An output port.
#[derive(Clone, Debug)]
pub struct Output {
    /// The port's name.
    pub name: String,
    /// Which binding of that port it is: 1, unless it is bound several times.
    pub nth: u16,
    /// Its declaration; `None` where the template has no such output, or is unknown.
    pub declared: Option<Span>,
    /// Its type in this component.
    pub ty: Option<Type>,
    /// What it is bound to.
    pub binding: Option<Binding>,
    /// What there is to say about it.
    pub findings: Findings,
}

/// `port = formula` or `port => entry`
#[derive(Clone, Debug)]
pub struct Binding {
    /// The whole of it.
    pub span: Span,
    /// The port's name.
    pub port_span: Span,
    /// The formula, or the entry that takes the value.
    pub value: Option<Value>,
}

/// A formula.
#[derive(Clone, Debug)]
pub struct Value {
    /// Its text as written, in one line and without comments.
    pub text: String,
    /// Its place.
    pub span: Span,
    /// The entry, where it is one and nothing more.
    pub entry: Option<EntryId>,
}

/// A way out of an element or supervisor.
#[derive(Clone, Debug)]
pub struct Exit {
    /// The state or event.
    pub name: String,
    /// Which edge of that name it is: 1, unless it is connected several times.
    pub nth: u16,
    /// What it is.
    pub kind: ExitKind,
    /// Whether the component has it; unknown templates have none.
    pub known: bool,
    /// Its declaration; `None` for those that need none.
    pub declared: Option<Span>,
    /// Whether something is missing while it is not connected.
    pub required: bool,
    /// The edge.
    pub edge: Option<Edge>,
    /// What there is to say about it.
    pub findings: Findings,
}

/// What makes control leave.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ExitKind {
    /// A state of an element.
    State,
    /// `Error` of an element.
    Error,
    /// An event of a supervisor.
    Event,
    /// `DeadlineMissed` of a supervisor.
    Missed,
}

/// `State -> target`
#[derive(Clone, Debug)]
pub struct Edge {
    /// The whole of it.
    pub span: Span,
    /// The state or event.
    pub name_span: Span,
    /// Where it leads; `None` while nothing stands there.
    pub target: Option<Target>,
}

/// Where an edge or `start` leads.
#[derive(Clone, Debug)]
pub struct Target {
    /// Its name as written.
    pub text: String,
    /// Its place.
    pub span: Span,
    /// What it means.
    pub to: Destination,
}

/// What a target means.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Destination {
    /// An element of the plan.
    Element(ElementId),
    /// The plan ends.
    Terminate,
    /// The event is not taken.
    Ignore,
    /// Nothing of the plan has that name.
    Unknown,
}

/// What the compiler has to say about an item or a part of it.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Findings {
    /// The worst of it.
    pub worst: Option<Severity>,
    /// Where it stands among the diagnostics of the compilation.
    pub list: Vec<u32>,
}
