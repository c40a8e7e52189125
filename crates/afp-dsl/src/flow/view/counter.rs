//! Computations that count how often a cycle is taken, as far as that is known.

use std::collections::BTreeMap;

use super::View;
use crate::graph::{Component, Element, ElementId, EntryId};
use crate::toolbox::Case;

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

impl<'a> View<'a> {
    /// The states of a computation that formulas declare.
    pub fn cases(&self, element: &Element) -> Option<&'a [Case]> {
        match element.component {
            Component::Computation(id) => self.model.template(id).cases.as_deref(),
            _ => None,
        }
    }
}
