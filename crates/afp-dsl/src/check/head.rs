//! What is known of a plan before its components are checked.

use crate::check::names::Indices;
use crate::graph::{EntryId, EntryKind, Formula};
use crate::types::{Constant, Type};
use afp_syntax::ast::{self, Name};
use afp_syntax::source::Span;

/// What other plans need to know of a plan.
pub(crate) struct PlanHead {
    pub node: ast::Plan,
    pub name: Option<Name>,
    /// The file that it stands in.
    pub file: usize,
    pub entries: Vec<EntryDraft>,
    pub indices: Indices,
    /// The edge by which it can end as `Interrupted`.
    pub interrupting: Option<Span>,
}

/// An entry, as far as it is understood.
#[derive(Clone, Debug)]
pub(crate) struct EntryDraft {
    pub name: Name,
    /// Its `///` lines.
    pub doc: String,
    /// Who may set it.
    pub kind: EntryKind,
    /// Whether it is given its value anew while the plan runs as a sub-plan.
    pub live: bool,
    /// Its type, where that is known.
    pub ty: Option<Type>,
    pub init: Option<Formula>,
    /// Whether an initial value is written, right or wrong.
    pub has_init: bool,
    /// The initial value where it is the same in every run.
    pub value: Option<Constant>,
    /// Least and greatest value, in SI units.
    pub range: Option<(f64, f64)>,
    /// The constants that the range is made of.
    pub ranged_by: Vec<EntryId>,
}

impl EntryDraft {
    /// A draft that formulas can read, of an entry or an input port.
    pub fn readable(name: &str, span: Span, kind: EntryKind, ty: &Type) -> EntryDraft {
        EntryDraft {
            name: Name { text: name.to_owned(), span },
            doc: String::new(),
            kind,
            live: false,
            ty: Some(ty.clone()),
            init: None,
            has_init: true,
            value: None,
            range: None,
            ranged_by: Vec::new(),
        }
    }
}
