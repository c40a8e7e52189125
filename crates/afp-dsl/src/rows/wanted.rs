//! Wanted events of supervisors.
//!
//! An event of a global supervisor is not taken if it leads to the active element. In the look, an
//! element's own event is not taken if it would restart the element.

use crate::graph::{ElementId, Plan, SupervisorId, Target};
use afp_types::Events;

/// The events that do not lead to `ignore` or to the element `there`; `None` if there are too many
/// for a set.
pub(super) fn wanted(events: &[Target], there: Option<ElementId>) -> Option<Events> {
    let mut bits = 0;
    let taken = |target: &Target| match target {
        Target::Ignore => false,
        Target::Element(to) | Target::Suspend(to) => Some(*to) != there,
        Target::Terminate | Target::Fail(_) | Target::Resume | Target::Return => true,
    };
    for (index, _) in events.iter().enumerate().filter(|(_, target)| taken(target)) {
        bits |= 1_u64.checked_shl(u32::try_from(index).ok()?)?;
    }
    Some(Events::from_bits(bits))
}

/// Global supervisors with the elements that need separate rows: targets of their events, which are
/// not wanted there, and elements with reactions to them.
pub(super) fn elsewhere(plan: &Plan) -> Vec<(SupervisorId, ElementId)> {
    let mut pairs = Vec::new();
    let globals = plan.supervisors.iter().take(usize::from(plan.globals));
    for (supervisor, id) in globals.zip((0..).map(SupervisorId)) {
        let mut there: Vec<_> =
            supervisor.events.iter().filter_map(|to| watched(plan, *to)).collect();
        there.extend(plan.reacting(id).map(|(element, _)| element));
        there.sort_unstable();
        there.dedup();
        pairs.extend(there.into_iter().map(|element| (id, element)));
    }
    pairs
}

/// The target element of an edge, unless it is a computation, during which nothing is polled.
fn watched(plan: &Plan, target: Target) -> Option<ElementId> {
    let (Target::Element(id) | Target::Suspend(id)) = target else { return None };
    plan.elements.get(id.index()).filter(|element| element.takes_time()).map(|_| id)
}
