//! Elements and supervisors of an outline, with their ports and exits.

use std::sync::Arc;

use super::{ElementId, EntryId, Findings, PlanId};
use crate::toolbox::{Template, Toolbox};
use crate::types::{Constant, Type};
use afp_syntax::ast::Name;
use afp_syntax::item::Item;
use afp_syntax::source::Span;
use afp_types::{Duration, Timing};

#[derive(Clone, Debug)]
pub struct Component {
    pub item: Item,
    /// The kind, by its keyword.
    pub kind: ComponentKind,
    pub name: Option<Name>,
    /// Its `///` lines.
    pub doc: String,
    /// The comment above it.
    pub note: String,
    /// Its span, without surrounding comments.
    pub span: Span,
    pub template: Option<TemplateUse>,
    /// The type of `any` or `number` in its template, if determined.
    pub generic: Option<Type>,
    /// Inputs of its template in order, then unknown bound ones.
    pub inputs: Vec<Input>,
    /// Outputs of its template in order, then unknown bound ones.
    pub outputs: Vec<Output>,
    /// States or events of its template in order, then a connected `Error` or `DeadlineMissed`,
    /// then unknown ones.
    pub exits: Vec<Exit>,
    /// Its local supervisors, in source order.
    pub supervisors: Vec<Component>,
    /// Its reactions to supervisors of the plan, in source order: each has the supervisor's name
    /// and the written edges, and is `on NAME` in its path.
    pub reactions: Vec<Component>,
    /// The polling times of a supervisor.
    pub times: Option<Times>,
    /// The parentheses with its bindings.
    pub args_span: Option<Span>,
    /// Its closing brace.
    pub end_span: Option<Span>,
    /// Diagnostics of no smaller part.
    pub findings: Findings,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ComponentKind {
    Actor,
    Computation,
    SubPlan,
    Supervisor,
    /// An element's reactions to a supervisor of the plan.
    Reactions,
}

#[derive(Clone, Debug)]
pub struct TemplateUse {
    /// The name as written, with its qualifier.
    pub text: String,
    pub span: Span,
    /// The place of the name only.
    pub name_span: Span,
    /// Its meaning; `None` if unknown, ambiguous or unsuitable for the keyword.
    pub made_from: Option<MadeFrom>,
}

#[derive(Clone, Debug)]
pub enum MadeFrom {
    Template {
        toolbox: Arc<Toolbox>,
        /// Index in [`Toolbox::templates`].
        index: usize,
    },
    Plan(PlanId),
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Times {
    pub timing: Timing,
    pub every_span: Option<Span>,
    pub deadline_span: Option<Span>,
}

impl Times {
    /// Unwritten times, in nanoseconds.
    pub(crate) fn new(every: u64, deadline: u64, template: Option<&Template>) -> Times {
        let budget = template.and_then(|template| template.budget).unwrap_or(0);
        let [period, deadline, budget] = [every, deadline, budget].map(Duration::from_nanos);
        let timing = Timing { period, deadline, budget };
        Times { timing, every_span: None, deadline_span: None }
    }
}

#[derive(Clone, Debug)]
pub struct Input {
    pub name: Arc<str>,
    /// Number of this binding of the port, usually 1.
    pub nth: u16,
    /// Its declaration; `None` for an unknown input or template.
    pub declared: Option<Span>,
    pub ty: Option<Type>,
    /// Whether it must be bound.
    pub required: bool,
    /// Its default, if known.
    pub default: Option<Constant>,
    /// Minimum and maximum.
    pub range: Option<(f64, f64)>,
    pub binding: Option<Binding>,
    pub findings: Findings,
}

#[derive(Clone, Debug)]
pub struct Output {
    pub name: Arc<str>,
    /// Number of this binding of the port, usually 1.
    pub nth: u16,
    /// Its declaration; `None` for an unknown output or template.
    pub declared: Option<Span>,
    pub ty: Option<Type>,
    pub binding: Option<Binding>,
    pub findings: Findings,
}

/// `port = formula` or `port => entry`
#[derive(Clone, Debug)]
pub struct Binding {
    pub span: Span,
    pub port_span: Span,
    /// The formula, or the entry that takes the value.
    pub value: Option<Value>,
}

#[derive(Clone, Debug)]
pub struct Value {
    /// Its source in one line without comments.
    pub text: String,
    pub span: Span,
    /// The entry, if it is only an entry.
    pub entry: Option<EntryId>,
}

/// A state or event of an element or supervisor.
#[derive(Clone, Debug)]
pub struct Exit {
    pub name: Arc<str>,
    /// Number of this edge of the exit, usually 1.
    pub nth: u16,
    pub kind: ExitKind,
    /// Whether the component declares it; never for unknown templates.
    pub known: bool,
    /// Its declaration; `None` for implicit exits.
    pub declared: Option<Span>,
    /// Whether it must be connected.
    pub required: bool,
    pub edge: Option<Edge>,
    pub findings: Findings,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ExitKind {
    State,
    Error,
    Event,
    Missed,
}

/// `State -> target`
#[derive(Clone, Debug)]
pub struct Edge {
    pub span: Span,
    pub name_span: Span,
    /// Its target; `None` if missing.
    pub target: Option<Target>,
}

/// Target of an edge or `start`.
#[derive(Clone, Debug)]
pub struct Target {
    /// Its name as written, with the text after `fail`.
    pub text: String,
    pub span: Span,
    pub to: Destination,
}

impl Target {
    /// The place of the name only.
    pub fn name_span(&self) -> Span {
        match self.reason() {
            _ if self.suspends() => Span {
                start: self.span.end - (self.text.len() - SUSPEND.len()) as u32,
                ..self.span
            },
            Some(reason) => Span {
                end: self.span.start + (self.text.len() - reason.len() - 1) as u32,
                ..self.span
            },
            None => self.span,
        }
    }

    /// The text after `fail`, with quotes.
    pub fn reason(&self) -> Option<&str> {
        let parts = self.text.split_once(' ').filter(|_| !self.suspends());
        parts.map(|(_, reason)| reason)
    }

    /// Whether `suspend` is written before the name.
    pub fn suspends(&self) -> bool {
        self.text.starts_with(SUSPEND)
    }
}

/// The beginning of a target that suspends, before the name of the handler.
pub(crate) const SUSPEND: &str = "suspend ";

/// The meaning of a target; `None` for an unknown element.
pub type Destination = afp_types::Target<Option<ElementId>, ()>;
