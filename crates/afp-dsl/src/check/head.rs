//! Facts about a plan before its components are checked.

use crate::check::names::Indices;
use crate::graph::{EntryId, EntryKind, Formula};
use crate::types::{Constant, Type};
use afp_syntax::ast::{self, Name};
use afp_syntax::source::Span;

/// The facts that other plans need.
pub(crate) struct PlanHead {
    pub node: ast::Plan,
    pub name: Option<Name>,
    pub file: usize,
    pub entries: Vec<EntryDraft>,
    pub indices: Indices,
    /// The edge by which it can end as `Interrupted`.
    pub interrupting: Option<Span>,
}

/// An entry, as far as known.
#[derive(Clone, Debug)]
pub(crate) struct EntryDraft {
    pub name: Name,
    /// Its `///` lines.
    pub doc: String,
    pub kind: EntryKind,
    /// Whether a running sub-plan gets new values.
    pub live: bool,
    /// Its type, if known.
    pub ty: Option<Type>,
    pub init: Option<Formula>,
    /// Whether an initial value is written, valid or not.
    pub has_init: bool,
    /// The initial value if it is constant.
    pub value: Option<Constant>,
    /// Minimum and maximum, in SI units.
    pub range: Option<(f64, f64)>,
    /// The constants in the range.
    pub ranged_by: Vec<EntryId>,
}

impl EntryDraft {
    /// A draft for formulas, of an entry or an input port.
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
