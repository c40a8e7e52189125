//! Parts of the rows that the compiler lowers and the scheduler reads.

/// What an element is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ElementKind {
    /// An actor.
    Actor,
    /// A computation.
    Computation,
    /// A sub-plan.
    SubPlan,
}

/// A run of rows in another table.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Range {
    /// Index of the first.
    pub first: u16,
    /// How many.
    pub len: u16,
}

/// Where the ids of a sub-plan begin, counted from the first id of the plan that uses it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Child {
    /// Offset of its component ids.
    pub components: u32,
    /// Offset of its entry ids.
    pub entries: u32,
}

impl Range {
    /// The indices.
    #[inline]
    pub fn indices(self) -> core::ops::Range<usize> {
        let first = usize::from(self.first);
        first..first + usize::from(self.len)
    }
}
