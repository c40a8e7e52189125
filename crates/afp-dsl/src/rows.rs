//! The tables that the scheduler reads, lowered once from the checked plans.
//!
//! Loaded plans share them and generated code prints them, so the two back ends cannot disagree. The
//! types of the rows are those of `afp-types`. The check refuses a plan whose tables would be too large
//! (`check/size.rs`), and `lower` returns nothing rather than a number that wrapped.

mod ids;
mod lower;
mod order;
mod size;
mod table;
mod wanted;

pub(crate) use lower::lower;
pub(crate) use order::polling_order;
pub(crate) use size::{MAX_EVENTS, MAX_ROWS, MAX_STATES, Table, tables};
pub use table::Rows;
