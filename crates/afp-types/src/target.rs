//! Targets of edges.

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
}

impl<E, R> Target<E, R> {
    /// The element, if the edge leads to one.
    pub fn element(&self) -> Option<&E> {
        self.keyword().err()
    }

    /// The keyword of the target, or the element.
    ///
    /// # Errors
    /// The element.
    pub fn keyword(&self) -> Result<&'static str, &E> {
        match self {
            Target::Element(element) => Err(element),
            Target::Terminate => Ok("terminate"),
            Target::Fail(_) => Ok("fail"),
            Target::Ignore => Ok("ignore"),
            Target::Resume => Ok("resume"),
        }
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
        }
    }
}
