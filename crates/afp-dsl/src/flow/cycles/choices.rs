//! Endless cycles of computations, whatever their inputs.

use std::collections::BTreeSet;

use super::{decided, holding};
use crate::flow::view::{Cause, Edge, View};
use crate::graph::{EntryId, Formula};

/// Whether the computations of a cycle repeat their choices: nothing on it writes their inputs, so
/// none fails later. If two of them read the same entry, their choices may contradict each other,
/// and the cycle may be impossible.
pub(super) fn never_change(view: &View<'_>, cycle: &[Edge]) -> bool {
    let outputs = cycle.iter().flat_map(|edge| view.may_write(edge.cause));
    let written: BTreeSet<EntryId> = outputs.map(|output| output.entry).collect();
    let mut read_by_others = BTreeSet::new();
    cycle.iter().all(|edge| {
        let Cause::State(id, state) = edge.cause else { return false };
        let element = &view.plan.elements[id.index()];
        let is_caught = element.on_error.is_some() && !holding::never_fails(view, element);
        let is_choice = decided::is_choice(element, state);
        let mut read = BTreeSet::new();
        read.extend(element.inputs.iter().flat_map(Formula::entries).map(|(entry, _)| entry));
        let stays = written.is_disjoint(&read);
        let fails_by_inputs = || holding::is_known(view, element);
        let is_open = is_choice && !read_by_others.is_disjoint(&read);
        if is_choice {
            read_by_others.extend(read);
        }
        (!is_caught || stays && fails_by_inputs())
            && (!is_choice || stays && !is_open && decided::chooses_by_inputs(view, element))
    })
}
