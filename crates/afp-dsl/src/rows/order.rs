//! In which order supervisors are polled.

use crate::graph::{Plan, SupervisorId};

/// Supervisors of a plan in polling order: shorter declared deadline first, then global before local,
/// then as written. `ids` has the global ones first, each group as written.
pub(crate) fn polling_order(
    plan: &Plan,
    ids: impl Iterator<Item = SupervisorId>,
) -> Vec<SupervisorId> {
    let mut order: Vec<_> = ids.collect();
    order.sort_by_key(|id| plan.supervisors[id.index()].timing.deadline);
    order
}
