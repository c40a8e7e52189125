use std::sync::Arc;

use crate::flow::view::{Node, View};
use crate::graph::{Component, Element};

use super::StepParts;
use super::cost::Cost;

/// Costs of a plan while it is active.
#[derive(Clone, Debug, Default)]
pub(super) struct Level {
    /// One poll of each global supervisor.
    pub globals: Cost,
    pub entering: Cost,
    /// Continuing with any of its elements after a suspension.
    pub again: Cost,
    /// Longest step while it is active, including its last but not its first.
    pub longest_step: Cost,
    /// The active element at the start of that step, and the costs of supervisors and element
    /// without entries.
    pub longest: Option<(Node, u64, u64)>,
    /// Maximum interruption of its active elements.
    pub interrupt: Cost,
    /// Maximum time from interruption to standstill.
    pub stop: Cost,
    /// Maximum share of the processor.
    pub demand: f64,
    /// Why the share is unknown.
    pub demand_unknown: Option<Arc<str>>,
    /// The element with the greatest share.
    pub busiest: Option<Node>,
}

/// The levels of all plans, by index.
pub(super) struct Levels {
    pub all: Vec<Level>,
}

impl Levels {
    /// Path of the element with a plan's greatest share.
    pub fn busiest(&self, views: &[View<'_>], plan: usize) -> String {
        let mut path = Vec::new();
        let mut plan = Some(plan);
        while let Some(index) = plan.take() {
            let element = self.all[index].busiest.and_then(|node| views[index].element(node));
            let Some(element) = element else { break };
            path.push(element.name.as_str());
            if let Component::SubPlan(inner) = element.component {
                plan = Some(inner.index());
            }
        }
        path.join(".")
    }

    /// Costs of interrupting an element, and until its standstill.
    pub fn interrupting(&self, view: &View<'_>, element: &Element) -> (Cost, Cost) {
        match element.component {
            Component::SubPlan(id) => {
                let level = &self.all[id.index()];
                (level.interrupt.clone(), level.stop.clone())
            }
            Component::Actor(id) | Component::Computation(id) => {
                let template = view.model.template(id);
                (Cost::budget(template), Cost::stop(template))
            }
        }
    }

    /// Parts of a plan's longest step, possibly its first.
    pub fn step_parts(&self, views: &[View<'_>], plan: usize) -> StepParts {
        let mut parts = StepParts { path: String::new(), supervisors: 0, active: 0, entered: 0 };
        let level = &self.all[plan];
        if level.longest.is_none() || level.entering.exceeds(&level.longest_step) {
            parts.supervisors = level.globals.times(2).time();
            parts.entered = level.entering.time().saturating_sub(parts.supervisors);
            return parts;
        }
        let (mut path, mut next) = (Vec::new(), Some(plan));
        while let Some(index) = next.take() {
            let level = &self.all[index];
            parts.supervisors = parts.supervisors.saturating_add(level.globals.time());
            let Some((node, supervisors, active)) = level.longest else { break };
            parts.supervisors = parts.supervisors.saturating_add(supervisors);
            let Some(element) = views[index].element(node) else { break };
            path.push(element.name.as_str());
            match element.component {
                // The cost is the inner plan's.
                Component::SubPlan(id) if active == self.all[id.index()].longest_step.time() => {
                    next = Some(id.index());
                }
                _ => parts.active = active,
            }
        }
        parts.path = path.join(".");
        let known = parts.supervisors.saturating_add(parts.active);
        parts.entered = self.all[plan].longest_step.time().saturating_sub(known);
        parts
    }
}
