//! Handling of a component's faults, and its effect on the check.

use crate::graph::ElementId;
use crate::outline::{Component, ExitKind};
use afp_syntax::diagnostics::{Code, Diagnostics};

/// Handling of faults of a component's inputs.
#[derive(Clone, Copy)]
pub(super) enum Faults {
    /// An `Error` edge handles them.
    Taken,
    /// No `Error` edge handles them, but one could.
    Unconnected,
    EndPlan,
}

#[derive(Clone, Copy)]
pub(super) struct Owner {
    /// The element; `None` if there are too many.
    pub id: Option<ElementId>,
    /// Handling of the supervisor's faults.
    pub faults: Faults,
}

impl Owner {
    pub fn new(id: Option<ElementId>, draft: &Component) -> Owner {
        let mut exits = draft.exits.iter();
        let taken = exits.any(|exit| exit.kind == ExitKind::Error && exit.edge.is_some());
        Owner { id, faults: if taken { Faults::Taken } else { Faults::Unconnected } }
    }
}

/// Adds remarks on bindings. A conversion that may fail is reported depending on its fault
/// handling.
pub(super) fn add_remarks(mut remarks: Diagnostics, faults: Faults, diags: &mut Diagnostics) {
    if remarks.is_empty() {
        return;
    }
    match faults {
        Faults::Taken => remarks.retain(|remark| remark.code != Code::E0208),
        Faults::Unconnected => {}
        Faults::EndPlan => remarks.change(|remark| {
            if remark.code == Code::E0208 {
                remark.set_help("use an entry of that type: a fault here ends the plan");
            }
        }),
    }
    diags.extend(remarks);
}
