//! Targets: time resolution, available share of the processor, and poll times.

use std::collections::BTreeMap;
use std::sync::Arc;

use crate::toolbox::{Template, Toolbox};

/// Default share of the processor.
const DEFAULT_CAPACITY: f64 = 0.7;

#[derive(Clone, Debug, PartialEq)]
pub struct Target {
    pub name: String,
    /// Time resolution in nanoseconds: the shortest interval between events, and the maximum delay
    /// of noticing one. `None` if unknown.
    pub tick: Option<u64>,
    /// A plan's maximum share of the processor, greater than 0 and at most 1.
    pub capacity: f64,
    /// Factor on the toolboxes' poll times, greater than 0.
    pub slowdown: f64,
    /// Maximum time of one poll in nanoseconds, by toolbox and template; replaces the declared one.
    pub budgets: Budgets,
}

/// Budgets in nanoseconds, by toolbox and template.
pub type Budgets = BTreeMap<String, BTreeMap<String, u64>>;

#[derive(Clone, Copy, Debug)]
pub struct BuiltIn {
    pub name: &'static str,
    tick: u64,
    slowdown: f64,
}

/// The built-in targets.
///
/// On Linux the tick is the delay of a timer in a thread without slack on a machine that is not
/// overloaded; the microcontroller has its own timer. Toolboxes declare the times of a Raspberry
/// Pi. The microcontroller has a tenth of its clock rate; with 64-bit arithmetic in software it is
/// even slower.
pub const BUILT_IN: &[BuiltIn] = &[
    BuiltIn { name: "host", tick: 50_000, slowdown: 1.0 },
    BuiltIn { name: "pi", tick: 100_000, slowdown: 1.0 },
    BuiltIn { name: "pi32", tick: 100_000, slowdown: 1.0 },
    BuiltIn { name: "mcu", tick: 10_000, slowdown: 10.0 },
];

impl Target {
    pub fn built_in(name: &str) -> Option<Target> {
        let known = BUILT_IN.iter().find(|known| known.name == name)?;
        Some(Target {
            tick: Some(known.tick),
            slowdown: known.slowdown,
            ..Target::unknown(known.name)
        })
    }

    /// The target with that name: built-in, or with unknown properties.
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

    /// The toolbox with its templates' budgets on the target.
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

    /// Toolbox and template of each given budget.
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
    fn an_unknown_name_is_a_target_without_properties() {
        assert_eq!(Target::named("pi"), Target::built_in("pi").unwrap());
        let toy = Target::named("toy");
        assert_eq!((toy.tick, toy.capacity, toy.slowdown), (None, 0.7, 1.0));
        assert!(Target::built_in("toy").is_none());
    }
}
