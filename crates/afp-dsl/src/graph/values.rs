//! Values that are known when a plan is compiled, and the order in which entries get their first ones.

use super::constant::evaluate;
use crate::graph::{Entry, EntryId, EntryKind, Formula, Plan};
use crate::types::Constant;

impl Plan {
    /// The entries with an initial value, in the order in which these may refer to one another: `const`, `in`, the rest.
    pub fn initial(&self) -> impl Iterator<Item = (EntryId, &Entry, &Formula)> {
        let of_kinds = |kinds: &'static [EntryKind]| {
            let all = (0..).map(EntryId).zip(&self.entries);
            all.filter(|(_, entry)| kinds.contains(&entry.kind))
        };
        let all = EntryKind::BY_VALUE.into_iter().flat_map(of_kinds);
        all.filter_map(|(id, entry)| Some((id, entry, entry.init.as_ref()?)))
    }

    /// The value of a formula of constants.
    pub(crate) fn constant(&self, formula: &Formula) -> Option<Constant> {
        let known = |entry: u16| {
            let entry = self.entries.get(usize::from(entry))?;
            entry.value.clone().filter(|_| entry.kind == EntryKind::Const)
        };
        evaluate(formula, &known).ok()?
    }
}
