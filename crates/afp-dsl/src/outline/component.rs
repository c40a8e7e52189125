//! Elements and supervisors of an outline, with their ports and exits.

use std::sync::Arc;

use super::{ElementId, EntryId, Findings, PlanId};
use crate::toolbox::{Template, Toolbox};
use crate::types::{Constant, Type};
use afp_syntax::ast::Name;
use afp_syntax::item::Item;
use afp_syntax::source::Span;
use afp_types::{Duration, Timing};

/// An element or a supervisor.
#[derive(Clone, Debug)]
pub struct Component {
    pub item: Item,
    /// What its keyword says.
    pub kind: ComponentKind,
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
    /// Its reactions to supervisors of the plan as written: each has the supervisor's name and the
    /// edges that are written, and goes by `on NAME` in its path.
    pub reactions: Vec<Component>,
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
    /// What an element does instead where a supervisor of the plan reports something.
    Reactions,
}

/// What a component is made from.
#[derive(Clone, Debug)]
pub struct TemplateUse {
    /// The name as written, with what qualifies it.
    pub text: String,
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
        toolbox: Arc<Toolbox>,
        /// Which of [`Toolbox::templates`].
        index: usize,
    },
    Plan(PlanId),
}

/// When a supervisor is polled.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Times {
    pub timing: Timing,
    /// Where `every` is written, if it is.
    pub every_span: Option<Span>,
    /// Where `deadline` is written, if it is.
    pub deadline_span: Option<Span>,
}

impl Times {
    /// Times that are not written, in nanoseconds.
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

#[derive(Clone, Debug)]
pub struct Output {
    pub name: Arc<str>,
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
    pub port_span: Span,
    /// The formula, or the entry that takes the value.
    pub value: Option<Value>,
}

#[derive(Clone, Debug)]
pub struct Value {
    /// Its text as written, in one line and without comments.
    pub text: String,
    pub span: Span,
    /// The entry, where it is one and nothing more.
    pub entry: Option<EntryId>,
}

/// A way out of an element or supervisor.
#[derive(Clone, Debug)]
pub struct Exit {
    pub name: Arc<str>,
    /// Which edge of that name it is: 1, unless it is connected several times.
    pub nth: u16,
    pub kind: ExitKind,
    /// Whether the component has it; unknown templates have none.
    pub known: bool,
    /// Its declaration; `None` for those that need none.
    pub declared: Option<Span>,
    /// Whether something is missing while it is not connected.
    pub required: bool,
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
    pub name_span: Span,
    /// Where it leads; `None` while nothing stands there.
    pub target: Option<Target>,
}

/// Where an edge or `start` leads.
#[derive(Clone, Debug)]
pub struct Target {
    /// Its name as written; with the text behind `fail`.
    pub text: String,
    pub span: Span,
    pub to: Destination,
}

impl Target {
    /// The place of the name alone.
    pub(crate) fn name_span(&self) -> Span {
        match self.reason() {
            Some(reason) => Span {
                end: self.span.start + (self.text.len() - reason.len() - 1) as u32,
                ..self.span
            },
            None => self.span,
        }
    }

    /// The text behind `fail`, quotes included.
    pub fn reason(&self) -> Option<&str> {
        self.text.split_once(' ').map(|(_, reason)| reason)
    }
}

/// What a target means. An element is `None` if nothing of the plan has that name.
pub type Destination = afp_types::Target<Option<ElementId>, ()>;
