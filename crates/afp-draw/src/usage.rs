//! How often the parts of a plan were used: a drawing with it is coloured by use rather than by kind.

use afp_syntax::source::Span;

/// How often the parts of plans were used.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Usage {
    pub plans: Vec<PlanUsage>,
}

/// How often the parts of a plan were used, wherever it is a sub-plan.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PlanUsage {
    /// The plan: the place of its name in the text.
    pub plan: Span,
    /// Its elements, by their place.
    pub elements: Vec<Count>,
    /// Its supervisors, by their place.
    pub supervisors: Vec<Count>,
    /// How often each entry was written.
    pub entries: Vec<u64>,
}

/// How often a component was used.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Count {
    pub starts: u64,
    /// How often each state was reached or event taken, by position.
    pub outcomes: Vec<u64>,
    /// How often its `Error` or `DeadlineMissed` was taken.
    pub special: u64,
    /// How often an element's own edges for events of global supervisors were taken.
    pub reactions: Vec<Reaction>,
}

/// An edge of an element for an event of a global supervisor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Reaction {
    /// The supervisor, by its place.
    pub supervisor: usize,
    /// The event, by position; `None` for `DeadlineMissed`.
    pub event: Option<u16>,
    /// How often it was taken.
    pub count: u64,
}

/// Whether a part was used.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Use {
    /// It was, and so was everything that can come of it.
    Whole,
    /// It was, but something that can come of it never came.
    Partly,
    Never,
}

/// What a thing of a drawing is: it decides on colours and dashes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Class {
    /// The kind of thing.
    pub(super) name: &'static str,
    /// Whether it was used, where that is shown.
    pub(super) usage: Option<Use>,
}

impl Use {
    /// Of something that happened so often.
    pub(super) fn of(count: u64) -> Use {
        if count > 0 { Use::Whole } else { Use::Never }
    }

    /// Of something that was used so often and whose exits were used so often.
    pub(super) fn with_exits(count: u64, mut exits: impl Iterator<Item = u64>) -> Use {
        match Use::of(count) {
            Use::Whole if exits.any(|exit| exit == 0) => Use::Partly,
            other => other,
        }
    }

    /// Its class in the style sheet.
    fn class(self) -> &'static str {
        match self {
            Use::Whole => "used",
            Use::Partly => "partly",
            Use::Never => "unused",
        }
    }
}

/// A count as a drawing says it.
pub(super) fn times(count: u64) -> String {
    match count {
        0 => "never".to_owned(),
        count => format!("×{count}"),
    }
}

impl From<&'static str> for Class {
    fn from(name: &'static str) -> Self {
        Class { name, usage: None }
    }
}

impl std::fmt::Display for Class {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.name)?;
        match self.usage {
            Some(usage) => write!(f, " {}", usage.class()),
            None => Ok(()),
        }
    }
}
