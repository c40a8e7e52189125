//! Targets of edges.

use core::fmt;

use crate::{ElementId, ReasonId};

/// The target of an edge. `E` is the element and `R` the reason of `fail`, in the form of the
/// compiler phase.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Target<E = ElementId, R = ReasonId> {
    /// An element of the same plan.
    Element(E),
    /// The plan ends.
    Terminate,
    /// The plan ends in `Error`.
    Fail(R),
    /// The event is not taken; events only.
    Ignore,
    /// The active element continues; events, and computations that only events lead to.
    Resume,
    /// The active element is set aside and this handler starts; events, and computations that only
    /// events lead to.
    Suspend(E),
    /// The element that was set aside continues; handlers, and computations that only handlers lead
    /// to.
    Return,
}

impl<E, R> Target<E, R> {
    /// The element, if the edge leads to one, as a handler or not.
    pub fn element(&self) -> Option<&E> {
        match self {
            Target::Element(element) | Target::Suspend(element) => Some(element),
            Target::Terminate
            | Target::Fail(_)
            | Target::Ignore
            | Target::Resume
            | Target::Return => None,
        }
    }

    /// The keyword; `None` for an element that is not suspended to.
    pub fn keyword(&self) -> Option<&'static str> {
        match self {
            Target::Element(_) => None,
            Target::Terminate => Some("terminate"),
            Target::Fail(_) => Some("fail"),
            Target::Ignore => Some("ignore"),
            Target::Resume => Some("resume"),
            Target::Suspend(_) => Some("suspend"),
            Target::Return => Some("return"),
        }
    }

    /// The target as a plan file spells it, without a reason. `name` names the element.
    pub fn text<N: fmt::Display>(&self, name: impl FnOnce(&E) -> N) -> impl fmt::Display {
        let (keyword, name) = (self.keyword(), self.element().map(name));
        fmt::from_fn(move |f| match (keyword, &name) {
            (Some(keyword), Some(name)) => write!(f, "{keyword} {name}"),
            (Some(keyword), None) => f.write_str(keyword),
            (None, Some(name)) => name.fmt(f),
            (None, None) => Ok(()),
        })
    }

    /// Converts element and reason.
    pub fn map<F, S>(
        self,
        element: impl FnOnce(E) -> F,
        reason: impl FnOnce(R) -> S,
    ) -> Target<F, S> {
        match self {
            Target::Element(id) => Target::Element(element(id)),
            Target::Terminate => Target::Terminate,
            Target::Fail(id) => Target::Fail(reason(id)),
            Target::Ignore => Target::Ignore,
            Target::Resume => Target::Resume,
            Target::Suspend(id) => Target::Suspend(element(id)),
            Target::Return => Target::Return,
        }
    }
}
