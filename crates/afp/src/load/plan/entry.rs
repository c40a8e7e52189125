//! The entries of a loaded plan, apart from their values.

use afp_core::Value;
use afp_core::rt::{Scale, int_to_float};
use afp_dsl::graph::{self, EntryKind};
use afp_dsl::types::Type;
use afp_dsl::types::converter::spellings;

/// An entry of a loaded plan.
pub(super) struct EntryInfo {
    pub name: String,
    pub kind: EntryKind,
    /// Whether it is a live input.
    pub live: bool,
    /// Minimum and maximum.
    pub range: Option<(f64, f64)>,
    /// The accepted units of values from outside.
    pub units: Vec<(String, Scale)>,
}

impl EntryInfo {
    pub fn new(entry: &graph::Entry) -> Self {
        let units = match (&entry.ty, entry.kind) {
            (Type::Quantity(dimension), EntryKind::In | EntryKind::Var) => spellings(*dimension),
            _ => Vec::new(),
        };
        let graph::Entry { name, kind, live, range, .. } = entry;
        EntryInfo { name: name.clone(), kind: *kind, live: *live, range: *range, units }
    }
}

/// Converts a value to the entry's type: an `int` becomes a `float`.
pub(super) fn fit(ty: Option<&Type>, value: &Value) -> Value {
    match (ty, value) {
        (Some(Type::Quantity(_)), Value::Int(int)) => Value::Float(int_to_float(*int)),
        _ => value.clone(),
    }
}
