//! Ids of states and names of events.
//!
//! A chart matches events by their leading words between dots. Therefore every event is one path
//! and one outcome with a single dot between them, and all events are distinct.

use afp_dsl::graph::Target;

/// A plan at its place of use: the outermost plan, or the body of a sub-plan.
pub(super) struct Scope {
    /// The id of its state.
    pub(super) id: String,
    /// The prefix of its components' events.
    prefix: String,
}

/// The ending of a plan, as in its final states.
#[derive(Clone, Copy)]
pub(super) enum End {
    Ok,
    Interrupted,
    Error,
}

impl End {
    pub(super) const ALL: [End; 3] = [End::Ok, End::Interrupted, End::Error];
}

impl Scope {
    pub(super) fn outermost(plan: &str) -> Scope {
        Scope { id: plan.to_owned(), prefix: String::new() }
    }

    /// The body of the sub-plan of that name.
    pub(super) fn inner(&self, element: &str) -> Scope {
        Scope { id: self.state(element), prefix: format!("{}:", self.path(element)) }
    }

    /// The id of an element's state.
    pub(super) fn state(&self, element: &str) -> String {
        format!("{}.{element}", self.id)
    }

    /// The id of a final state; element names have no dash.
    pub(super) fn end(&self, end: End) -> String {
        let name = match end {
            End::Ok => "OK",
            End::Interrupted => "Interrupted",
            End::Error => "Error",
        };
        format!("{}-{name}", self.id)
    }

    /// The id of the state around actors and sub-plans, to which computations return.
    pub(super) fn acting(&self) -> String {
        format!("{}-acting", self.id)
    }

    /// The id of the history state for the active one of them.
    pub(super) fn history(&self) -> String {
        format!("{}-acting-history", self.id)
    }

    /// The id of the state around the elements that can be suspended, in a plan with handlers.
    pub(super) fn flowing(&self) -> String {
        format!("{}-flowing", self.id)
    }

    /// The id of the history state for the suspended one of them.
    pub(super) fn suspended(&self) -> String {
        format!("{}-suspended", self.id)
    }

    /// The prefix of an element's or a global supervisor's events.
    pub(super) fn path(&self, name: &str) -> String {
        format!("{}{name}", self.prefix)
    }

    /// The prefix of a local supervisor's events.
    pub(super) fn local(&self, element: &str, supervisor: &str) -> String {
        format!("{}-{supervisor}", self.path(element))
    }
}

/// The target of an edge for a taken event; `None` if it is ignored.
pub(super) fn target<'a>(
    scope: &Scope,
    target: Target,
    end: End,
    element: impl Fn(afp_dsl::graph::ElementId) -> &'a str,
) -> Option<String> {
    match target {
        Target::Element(id) | Target::Suspend(id) => Some(scope.state(element(id))),
        Target::Terminate => Some(scope.end(end)),
        Target::Fail(_) => Some(scope.end(End::Error)),
        // An event that resumes does not leave the state; a computation returns to it.
        Target::Resume => matches!(end, End::Ok).then(|| scope.history()),
        Target::Return => Some(scope.suspended()),
        Target::Ignore => None,
    }
}
