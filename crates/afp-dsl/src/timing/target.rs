//! What a plan shall run on: how fine its time is, how much of the processor plans may use, and how long polls take
//! on it.

use std::collections::BTreeMap;
use std::sync::Arc;

use crate::toolbox::{Template, Toolbox};

/// Share of the processor that plans may use where none is given.
const DEFAULT_CAPACITY: f64 = 0.7;

/// A machine that runs plans.
#[derive(Clone, Debug, PartialEq)]
pub struct Target {
    pub name: String,
    /// The grain of its time in nanoseconds: nothing happens more often, and what is due may be
    /// noticed so much later. `None` where it is not known.
    pub tick: Option<u64>,
    /// The share of the processor that a plan may ask for, more than 0 and at most 1.
    pub capacity: f64,
    /// How many times as long as the toolboxes declare a poll takes on it, more than 0.
    pub slowdown: f64,
    /// What one poll takes at most on it in nanoseconds, by toolbox and template; in place of what is declared.
    pub budgets: Budgets,
}

/// Budgets in nanoseconds: of templates by name, those by the name of their toolbox.
pub type Budgets = BTreeMap<String, BTreeMap<String, u64>>;

/// A target that is known everywhere.
#[derive(Clone, Copy, Debug)]
pub struct BuiltIn {
    pub name: &'static str,
    tick: u64,
    slowdown: f64,
}

/// The targets that are known everywhere.
///
/// On Linux the tick is what a timer of a thread without slack is late by on a machine that is not
/// overloaded; the microcontroller has a timer of its own. Toolboxes declare what a Raspberry Pi takes. The
/// microcontroller is one with a tenth of its clock; one that computes 64-bit numbers by software is slower still.
pub const BUILT_IN: &[BuiltIn] = &[
    BuiltIn { name: "host", tick: 50_000, slowdown: 1.0 },
    BuiltIn { name: "pi", tick: 100_000, slowdown: 1.0 },
    BuiltIn { name: "pi32", tick: 100_000, slowdown: 1.0 },
    BuiltIn { name: "mcu", tick: 10_000, slowdown: 10.0 },
];

impl Target {
    /// The built-in target of that name.
    pub fn built_in(name: &str) -> Option<Target> {
        let known = BUILT_IN.iter().find(|known| known.name == name)?;
        Some(Target {
            tick: Some(known.tick),
            slowdown: known.slowdown,
            ..Target::unknown(known.name)
        })
    }

    /// The target of that name: the built-in one, or one of which nothing is known.
    pub fn named(name: &str) -> Target {
        Target::built_in(name).unwrap_or_else(|| Target::unknown(name))
    }

    fn unknown(name: &str) -> Target {
        Target {
            name: name.to_owned(),
            tick: None,
            capacity: DEFAULT_CAPACITY,
            slowdown: 1.0,
            budgets: Budgets::new(),
        }
    }

    /// The toolbox with the budgets that its templates have on the target.
    pub(super) fn adapted(&self, toolbox: &Arc<Toolbox>) -> Arc<Toolbox> {
        let mut adapted = Arc::clone(toolbox);
        for template in &mut Arc::make_mut(&mut adapted).templates {
            template.budget = self.budget(&toolbox.name, template);
        }
        adapted
    }

    fn budget(&self, toolbox: &str, template: &Template) -> Option<u64> {
        let declared = || template.budget.map(|budget| (budget as f64 * self.slowdown) as u64);
        self.given(toolbox, &template.name).or_else(declared)
    }

    pub(super) fn given(&self, toolbox: &str, template: &str) -> Option<u64> {
        self.budgets.get(toolbox)?.get(template).copied()
    }

    /// What budgets are given for: toolbox and template.
    pub fn budgeted(&self) -> impl Iterator<Item = (&str, &str)> {
        self.budgets.iter().flat_map(|(toolbox, templates)| {
            templates.keys().map(|template| (toolbox.as_str(), template.as_str()))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::Target;

    #[test]
    fn a_name_that_is_not_built_in_is_a_target_of_which_nothing_is_known() {
        assert_eq!(Target::named("pi"), Target::built_in("pi").unwrap());
        let toy = Target::named("toy");
        assert_eq!((toy.tick, toy.capacity, toy.slowdown), (None, 0.7, 1.0));
        assert!(Target::built_in("toy").is_none());
    }
}
