//! A place of a plan that can be changed, and how.

use std::fmt;
use std::ops::Range;

/// What kind of change a mutant is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum MutantKind {
    /// A sign is turned round.
    Sign,
    /// An edge, or the start, leads elsewhere.
    Target,
    /// A number or truth value is another one.
    Constant,
    /// Two edges of a component lead where the other one did.
    Swap,
}

/// A change of a text.
pub(super) struct Site {
    pub kind: MutantKind,
    /// What is replaced, by bytes and in order, and by what.
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
