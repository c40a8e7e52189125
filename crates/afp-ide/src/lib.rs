//! Plain data for editors of plans, whatever protocol they speak.
//!
//! It does no I/O: texts come in as values, edits of them go out.

pub mod edit;
