//! Counters of rounds of cycles, as far as known.

use std::collections::BTreeMap;

use super::View;
use crate::graph::{Component, Element, ElementId, EntryId};
use crate::toolbox::Case;

/// A `Count` with a known limit.
#[derive(Clone, Copy)]
pub(crate) struct Counter {
    pub entry: EntryId,
    pub limit: i64,
    /// Least value of its entry before any count: zero, which `Done` writes, or less.
    pub least: i64,
}

#[derive(Default)]
pub(crate) struct Counters(pub BTreeMap<ElementId, Counter>);

impl<'a> View<'a> {
    /// The states of a declared computation.
    pub fn cases(&self, element: &Element) -> Option<&'a [Case]> {
        match element.component {
            Component::Computation(id) => self.model.template(id).cases.as_deref(),
            _ => None,
        }
    }
}
