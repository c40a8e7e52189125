//! Paths of items: names of a plan, an enum, a table, or an item in a plan.

use std::fmt;

/// An item of a file, by its path.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Item {
    Plan {
        name: String,
    },
    Enum {
        name: String,
    },
    Table {
        name: String,
    },
    /// An entry, an element or a global supervisor; the three share one scope.
    Inner {
        plan: String,
        name: String,
    },
    /// A local supervisor, or the reactions to a supervisor of the plan.
    Local {
        plan: String,
        /// The element.
        owner: String,
        /// Its name; `on NAME` for reactions, because no supervisor has such a name.
        name: String,
    },
}

/// The prefix of the names of reactions.
const ON: &str = "on ";

impl Item {
    pub fn plan(name: impl Into<String>) -> Item {
        Item::Plan { name: name.into() }
    }

    pub fn enumeration(name: impl Into<String>) -> Item {
        Item::Enum { name: name.into() }
    }

    pub fn table(name: impl Into<String>) -> Item {
        Item::Table { name: name.into() }
    }

    /// An entry, an element or a global supervisor of a plan.
    pub fn inner(plan: impl Into<String>, name: impl Into<String>) -> Item {
        Item::Inner { plan: plan.into(), name: name.into() }
    }

    pub fn local(
        plan: impl Into<String>,
        owner: impl Into<String>,
        name: impl Into<String>,
    ) -> Item {
        Item::Local { plan: plan.into(), owner: owner.into(), name: name.into() }
    }

    pub fn reactions(plan: impl Into<String>, owner: impl Into<String>, supervisor: &str) -> Item {
        Item::local(plan, owner, format!("{ON}{supervisor}"))
    }

    /// The supervisor, if the item is reactions.
    pub fn reacts_to(&self) -> Option<&str> {
        match self {
            Item::Local { name, .. } => name.strip_prefix(ON),
            _ => None,
        }
    }

    pub fn name(&self) -> &str {
        match self {
            Item::Plan { name }
            | Item::Enum { name }
            | Item::Table { name }
            | Item::Inner { name, .. }
            | Item::Local { name, .. } => name,
        }
    }

    /// The plan that contains it; for a plan, its own name; empty for an enum or a table.
    pub fn plan_name(&self) -> &str {
        match self {
            Item::Plan { name } => name,
            Item::Enum { .. } | Item::Table { .. } => "",
            Item::Inner { plan, .. } | Item::Local { plan, .. } => plan,
        }
    }

    /// Whether it is `item` or a part of it.
    pub fn lies_in(&self, item: &Item) -> bool {
        match (item, self) {
            (Item::Plan { name }, _) => self.plan_name() == name,
            (Item::Inner { plan, name }, Item::Local { plan: home, owner, .. }) => {
                (plan, name) == (home, owner)
            }
            _ => self == item,
        }
    }

    /// Its path after `from` is renamed to `to`; it may be inside `from`.
    pub fn moved(&self, from: &Item, to: &Item) -> Item {
        match (self, from, to) {
            _ if !self.lies_in(from) => self.clone(),
            _ if self == from => to.clone(),
            (Item::Inner { name, .. }, _, Item::Plan { name: plan }) => Item::inner(plan, name),
            (Item::Local { owner, name, .. }, _, Item::Plan { name: plan }) => {
                Item::local(plan, owner, name)
            }
            (Item::Local { name, .. }, _, Item::Inner { plan, name: owner }) => {
                Item::local(plan, owner, name)
            }
            _ => self.clone(),
        }
    }
}

/// `Plan`, `Enum`, `table`, `Plan.element`, `Plan.element.supervisor` or `Plan.element.on supervisor`
impl fmt::Display for Item {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Item::Plan { name } | Item::Enum { name } | Item::Table { name } => write!(f, "{name}"),
            Item::Inner { plan, name } => write!(f, "{plan}.{name}"),
            Item::Local { plan, owner, name } => write!(f, "{plan}.{owner}.{name}"),
        }
    }
}
