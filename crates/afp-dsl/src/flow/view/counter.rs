//! Computations that count how often a cycle is taken, as far as that is known.

use std::collections::BTreeMap;

use crate::graph::{ElementId, EntryId};

/// A `Count` of which is known how far it counts.
#[derive(Clone, Copy)]
pub(crate) struct Counter {
    /// What it counts in.
    pub entry: EntryId,
    pub limit: i64,
    /// The least value that its entry has before anything counts in it: zero, which `Done` writes, or less.
    pub least: i64,
}

/// The counters of a plan.
#[derive(Default)]
pub(crate) struct Counters(pub BTreeMap<ElementId, Counter>);
