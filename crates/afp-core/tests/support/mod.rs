//! Plans built from data on a scripted platform, for tests of the scheduler.
//!
//! A [`plan`](build) is built from rows, a [`world::World`] scripts the answers of components, and
//! a [`run::Run`] steps the plan and keeps the trace as lines of text.
#![allow(dead_code, reason = "each test binary uses a part")]

pub mod build;
mod handlers;
pub mod names;
pub mod run;
pub mod scripted;
pub mod world;

use afp_core::Instant;

pub fn ms(millis: u64) -> Instant {
    Instant::from_nanos(millis * 1_000_000)
}
