//! Where faults of a component go, and what its check says about that.

use crate::graph::ElementId;
use crate::outline::{Component, ExitKind};
use afp_syntax::diagnostics::{Code, Diagnostics};

/// What becomes of faults of a component's inputs.
#[derive(Clone, Copy)]
pub(super) enum Faults {
    /// An `Error` edge takes them.
    Taken,
    /// No `Error` edge takes them, but one could.
    Unconnected,
    EndPlan,
}

/// The element that a supervisor stands in.
#[derive(Clone, Copy)]
pub(super) struct Owner {
    /// The element; `None` where there are too many.
    pub id: Option<ElementId>,
    /// What becomes of the supervisor's faults.
    pub faults: Faults,
}

impl Owner {
    /// An element as its check has left it.
    pub fn new(id: Option<ElementId>, draft: &Component) -> Owner {
        let mut exits = draft.exits.iter();
        let taken = exits.any(|exit| exit.kind == ExitKind::Error && exit.edge.is_some());
        Owner { id, faults: if taken { Faults::Taken } else { Faults::Unconnected } }
    }
}

/// Adds what was found about bindings. That a conversion may fail is told by where its fault goes.
pub(super) fn add_remarks(mut remarks: Diagnostics, faults: Faults, diags: &mut Diagnostics) {
    if remarks.is_empty() {
        return;
    }
    match faults {
        Faults::Taken => remarks.retain(|remark| remark.code != Code::E0208),
        Faults::Unconnected => {}
        Faults::EndPlan => remarks.change(|remark| {
            if remark.code == Code::E0208 {
                remark.set_help("use an entry of that type: what fails here ends the plan");
            }
        }),
    }
    diags.extend(remarks);
}
