//! Kinds of components and entries, for compiler and run time.

/// The kind of a component.
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

/// The kind of an entry, which decides its writers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum EntryKind {
    /// Set when the plan starts.
    In,
    /// A result of the plan.
    Out,
    /// Internal data.
    Var,
    /// Constant.
    Const,
}

impl EntryKind {
    /// The kinds in the order of initialisation: initial values may use entries of earlier kinds.
    pub const BY_VALUE: [&[EntryKind]; 3] =
        [&[EntryKind::Const], &[EntryKind::In], &[EntryKind::Var, EntryKind::Out]];

    /// The keyword of the declaration.
    pub const fn word(self) -> &'static str {
        match self {
            EntryKind::In => "in",
            EntryKind::Out => "out",
            EntryKind::Var => "var",
            EntryKind::Const => "const",
        }
    }
}
