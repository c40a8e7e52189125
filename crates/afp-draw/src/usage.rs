//! The usage of a plan's parts, for drawings that are coloured by use.

use afp_syntax::source::Span;

/// The usage of the parts of plans.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Usage {
    pub plans: Vec<PlanUsage>,
}

/// The usage of a plan's parts, over all its uses as a sub-plan.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PlanUsage {
    /// The plan: the place of its name in the text.
    pub plan: Span,
    /// Its elements, by index.
    pub elements: Vec<Count>,
    /// Its supervisors, by index.
    pub supervisors: Vec<Count>,
    /// The number of writes of each entry.
    pub entries: Vec<u64>,
}

/// The usage of a component.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Count {
    pub starts: u64,
    /// The number of times that each state was reached or event was taken, by position.
    pub outcomes: Vec<u64>,
    /// The number of times that its `Error` or `DeadlineMissed` was taken.
    pub special: u64,
    /// The number of times that an element's own edges for global supervisors' events were taken.
    pub reactions: Vec<Reaction>,
}

/// An edge of an element for an event of a global supervisor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Reaction {
    /// The supervisor, by index.
    pub supervisor: usize,
    /// The event, by position; `None` for `DeadlineMissed`.
    pub event: Option<u16>,
    /// The number of times that it was taken.
    pub count: u64,
}

/// Whether a part was used.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Use {
    /// Used, and with all its outcomes.
    Whole,
    /// Used, but without some of its outcomes.
    Partly,
    Never,
}

/// The class of a part: it determines colours and dashes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Class {
    /// The kind of thing.
    pub(super) name: &'static str,
    /// Whether it was used, in a drawing by use.
    pub(super) usage: Option<Use>,
}

impl Use {
    pub(super) fn of(count: u64) -> Use {
        if count > 0 { Use::Whole } else { Use::Never }
    }

    /// The use of a part with this count and these counts of its exits.
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

/// A count as text in a drawing.
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
