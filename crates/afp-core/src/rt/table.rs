//! Access to the rows of a plan.

use crate::fault::Fault;

pub use afp_types::{
    Child, ElementId, ElementKind, ElementRow, Range, ReasonId, SupervisorId, SupervisorRow,
    Target, Timing,
};

/// All rows of one plan. An edge to `fail` ends it with a fault.
pub type PlanTable<'a> = afp_types::PlanTable<'a, Fault>;

/// Gives access to the rows: a zero-sized type for generated plans, so that it folds to constants;
/// a counted pointer for loaded plans.
pub trait Tables {
    /// The rows.
    fn table(&self) -> PlanTable<'_>;
}
