//! Plans made from data, on a scripted platform: what the tests of the scheduler are written with.
//!
//! A [`plan`](build) is put together from rows, a [`world::World`] says what each component answers
//! when, and a [`run::Run`] steps the one on the other and keeps the trace as lines of text.
#![allow(dead_code, reason = "each test binary uses a part")]

pub mod build;
pub mod names;
pub mod run;
pub mod scripted;
pub mod world;

use afp_core::Instant;

/// An instant in milliseconds.
pub fn ms(millis: u64) -> Instant {
    Instant::from_nanos(millis * 1_000_000)
}
