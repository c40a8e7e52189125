//! Indices of the parts of a plan, each with its own type.

macro_rules! ids {
    ($($(#[$doc:meta])* $name:ident),* $(,)?) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub struct $name(pub u16);

        impl $name {
            /// The index in the table.
            #[inline]
            pub fn index(self) -> usize {
                usize::from(self.0)
            }
        }
    )*};
}

ids! {
    /// A plan of a graph.
    PlanId,
    /// An entry of a plan.
    EntryId,
    /// An element of a plan.
    ElementId,
    /// A supervisor of a plan.
    SupervisorId,
    /// A toolbox of a graph.
    ToolboxId,
    /// A reason of `fail`.
    ReasonId,
}
