//! A place of a plan to change, with the change.

use std::fmt;
use std::ops::Range;

/// The kinds of changes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum MutantKind {
    /// A comparison or a sign is reversed.
    Sign,
    /// A different target of an edge or the start.
    Target,
    /// A different number, boolean or value of an enum.
    Constant,
    /// Two edges of a component with swapped targets.
    Swap,
}

/// A change of a text.
pub(super) struct Site {
    pub kind: MutantKind,
    /// Replaced byte ranges in order, with their new texts.
    pub edits: Vec<(Range<usize>, String)>,
    pub was: String,
    pub is: String,
}

impl fmt::Display for MutantKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            MutantKind::Sign => "sign",
            MutantKind::Target => "target",
            MutantKind::Constant => "constant",
            MutantKind::Swap => "swap",
        })
    }
}
