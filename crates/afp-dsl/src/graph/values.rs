//! Compile-time values, and the order of initialisation.

use super::constant::evaluate;
use crate::graph::{Entry, EntryId, EntryKind, Formula, Plan};
use crate::types::Constant;

impl Plan {
    /// The entries with initial values, in the order of possible references: `const`, `in`, others.
    pub fn initial(&self) -> impl Iterator<Item = (EntryId, &Entry, &Formula)> {
        let of_kinds = |kinds: &'static [EntryKind]| {
            let all = (0..).map(EntryId).zip(&self.entries);
            all.filter(|(_, entry)| kinds.contains(&entry.kind))
        };
        let all = EntryKind::BY_VALUE.into_iter().flat_map(of_kinds);
        all.filter_map(|(id, entry)| Some((id, entry, entry.init.as_ref()?)))
    }

    pub(crate) fn constant(&self, formula: &Formula) -> Option<Constant> {
        let known = |entry: u16| {
            let entry = self.entries.get(usize::from(entry))?;
            entry.value.clone().filter(|_| entry.kind == EntryKind::Const)
        };
        evaluate(formula, &known).ok()?
    }
}
