//! Numbers of rows in a plan's tables.

use crate::graph::Plan;
use crate::rows::wanted::elsewhere;

/// Maximum number of rows of one table.
pub(crate) const MAX_ROWS: usize = u16::MAX as usize;

/// Maximum number of events of a supervisor, since wanted events are a bit set.
pub(crate) const MAX_EVENTS: usize = 64;
/// Maximum number of states of an actor or computation: the two greater numbers are `Error` and
/// `DeadlineMissed`.
pub(crate) const MAX_STATES: usize = MAX_ROWS - 1;

/// A table of a plan, in source terms.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Table {
    Entries,
    Elements,
    Supervisors,
    /// Supervisors, with global ones again for each element that their events lead to or that
    /// reacts to them.
    Watches,
    /// States of elements and events of supervisors.
    Edges,
    /// Reasons after `fail`.
    Reasons,
    /// Pairs of an element and a supervisor that is polled while it is active.
    Sweeps,
}

/// Number of rows of each table.
pub(crate) fn tables(plan: &Plan) -> [(Table, usize); 7] {
    let states = plan.elements.iter().map(|element| element.states.len());
    let events = plan.supervisors.iter().map(|supervisor| supervisor.events.len());
    let reactions = plan.elements.iter().flat_map(|element| &element.reactions);
    let reactions = reactions.map(|table| table.events.len());
    let watched = plan.elements.iter().filter(|element| element.takes_time());
    let polled = watched.map(|element| usize::from(plan.globals) + element.supervisors.len());
    [
        (Table::Entries, plan.entries.len()),
        (Table::Elements, plan.elements.len()),
        (Table::Supervisors, plan.supervisors.len()),
        (Table::Watches, plan.supervisors.len() + elsewhere(plan).len()),
        (Table::Edges, states.chain(events).chain(reactions).sum()),
        (Table::Reasons, plan.reasons.len()),
        (Table::Sweeps, polled.sum()),
    ]
}
