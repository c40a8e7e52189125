//! The polling order of supervisors.

use crate::graph::{Plan, SupervisorId};

/// Sorts supervisors by polling order: shorter declared deadline first, then global before local,
/// then source order. `ids` has the global ones first, each group in source order.
pub(crate) fn polling_order(
    plan: &Plan,
    ids: impl Iterator<Item = SupervisorId>,
) -> Vec<SupervisorId> {
    let mut order: Vec<_> = ids.collect();
    order.sort_by_key(|id| plan.supervisors[id.index()].timing.deadline);
    order
}
