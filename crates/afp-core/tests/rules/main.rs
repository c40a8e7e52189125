//! The rules of the scheduler on plans built by hand, a file for each group.

#[path = "../support/mod.rs"]
mod support;

mod already_there;
mod deadlines;
mod drive;
mod faults;
mod life_cycle;
mod livelock;
mod look;
mod order;
mod outside;
mod panics;
mod random;
mod releases;
mod resume;
mod returns;
mod sub_plans;
mod suspend;
mod trace_order;
