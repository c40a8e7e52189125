//! How the scheduler gets at the rows of a plan.

use crate::fault::Fault;

pub use afp_types::{
    Child, ElementId, ElementKind, ElementRow, Range, ReasonId, SupervisorId, SupervisorRow,
    Target, Timing,
};

/// All rows of one plan. An edge to `fail` ends it with a fault.
pub type PlanTable<'a> = afp_types::PlanTable<'a, Fault>;

/// Gives access to the rows: a zero-sized type for generated plans, so that all of it folds to
/// constants; a counted pointer for loaded ones.
pub trait Tables {
    /// The rows.
    fn table(&self) -> PlanTable<'_>;
}
