//! The scheduler's tables, made once from the checked plans.
//!
//! Loaded plans share them and generated code prints them, so the two back ends cannot differ. The
//! row types are those of `afp-types`. The check rejects plans with too large tables
//! (`check/size.rs`), and `lower` returns `None` instead of wrapping a number.

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
