//! Words of other languages.

use afp_syntax::habits::{ENDS, REACTIONS, TYPES, ours};

#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Leads {
    Start,
    /// A state, or an unknown outcome.
    Edge,
    Event,
}

/// The likely keyword after `->`.
pub(super) fn target(name: &str, leads: Leads) -> Option<&'static str> {
    let of_ends = ours(ENDS, name).filter(|_| leads != Leads::Start);
    of_ends.or_else(|| ours(REACTIONS, name).filter(|_| leads == Leads::Event))
}

/// The likely type.
pub(super) fn ty(name: &str) -> Option<&'static str> {
    ours(TYPES, name)
}
