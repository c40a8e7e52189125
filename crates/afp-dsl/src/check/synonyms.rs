//! Words that other languages have for ours.

use afp_syntax::habits::{ENDS, REACTIONS, TYPES, ours};

#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Leads {
    /// The start of the plan.
    Start,
    /// A state, or what is not known to be an event.
    Edge,
    Event,
}

/// The word behind `->` that was meant by a name.
pub(super) fn target(name: &str, leads: Leads) -> Option<&'static str> {
    let of_ends = ours(ENDS, name).filter(|_| leads != Leads::Start);
    of_ends.or_else(|| ours(REACTIONS, name).filter(|_| leads == Leads::Event))
}

/// The type that was meant by a name.
pub(super) fn ty(name: &str) -> Option<&'static str> {
    ours(TYPES, name)
}
