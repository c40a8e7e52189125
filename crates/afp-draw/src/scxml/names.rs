//! Ids of states and names of events.
//!
//! A chart matches events by their leading words between dots, so every event is one path and one
//! outcome with a single dot between them, and no two of them can be taken for each other.

use afp_dsl::graph::Target;

/// A plan where it is used: the outermost one, or the body of a sub-plan.
pub(super) struct Scope {
    /// The id of its state.
    pub(super) id: String,
    /// What the events of its components begin with.
    prefix: String,
}

/// How a plan ends, as its final states are named.
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

    /// The id of a final state; names hold no dash, so no element has it.
    pub(super) fn end(&self, end: End) -> String {
        let name = match end {
            End::Ok => "OK",
            End::Interrupted => "Interrupted",
            End::Error => "Error",
        };
        format!("{}-{name}", self.id)
    }

    /// The id of the state around actors and sub-plans, where computations come back to them.
    pub(super) fn acting(&self) -> String {
        format!("{}-acting", self.id)
    }

    /// The id of what remembers which of them was active.
    pub(super) fn history(&self) -> String {
        format!("{}-acting-history", self.id)
    }

    /// What the events of an element or of a global supervisor begin with.
    pub(super) fn path(&self, name: &str) -> String {
        format!("{}{name}", self.prefix)
    }

    /// What the events of a local supervisor begin with.
    pub(super) fn local(&self, element: &str, supervisor: &str) -> String {
        format!("{}-{supervisor}", self.path(element))
    }
}

/// Where an edge leads when the event is taken; `None` where it is ignored.
pub(super) fn target<'a>(
    scope: &Scope,
    target: Target,
    end: End,
    element: impl Fn(afp_dsl::graph::ElementId) -> &'a str,
) -> Option<String> {
    match target {
        Target::Element(id) => Some(scope.state(element(id))),
        Target::Terminate => Some(scope.end(end)),
        Target::Fail(_) => Some(scope.end(End::Error)),
        // What an event resumes has not been left; a computation goes back to it.
        Target::Resume => matches!(end, End::Ok).then(|| scope.history()),
        Target::Ignore => None,
    }
}
