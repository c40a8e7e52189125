//! What components and entries are, said alike by compiler and run time.

/// What a component is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ComponentKind {
    /// The outermost plan.
    Plan,
    /// An actor.
    Actor,
    /// A computation.
    Computation,
    /// A sub-plan.
    SubPlan,
    /// A supervisor.
    Supervisor,
}

/// Who may set an entry.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum EntryKind {
    /// Set by whoever starts the plan.
    In,
    /// A result of the plan.
    Out,
    /// Inner data.
    Var,
    /// Never changes.
    Const,
}

impl EntryKind {
    /// The kinds in the order in which initial values come to be known: one may use entries of the kinds before its own.
    pub const BY_VALUE: [&[EntryKind]; 3] =
        [&[EntryKind::Const], &[EntryKind::In], &[EntryKind::Var, EntryKind::Out]];

    /// The word that declares such an entry.
    pub const fn word(self) -> &'static str {
        match self {
            EntryKind::In => "in",
            EntryKind::Out => "out",
            EntryKind::Var => "var",
            EntryKind::Const => "const",
        }
    }
}
