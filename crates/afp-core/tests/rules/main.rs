//! Every rule of the scheduler on plans built by hand; one file for each group of rules.

#[path = "../support/mod.rs"]
mod support;

mod order;
