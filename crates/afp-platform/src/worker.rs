//! Workers for the [`Job`]s of components, in virtual and in real time.
//!
//! [`VirtualWorker`] computes on demand and delivers the result after the declared time, so that a
//! run is the same on every machine. [`ThreadWorker`] computes on its own thread. Components see a
//! difference only in time.

mod slots;
mod thread;
mod virtual_time;

pub use thread::ThreadWorker;
pub use virtual_time::VirtualWorker;

use afp_core::{Fault, Job};
use std::panic::{AssertUnwindSafe, catch_unwind};

/// Runs a job and converts a panic to a fault. After [`Fault::JOB_PANICKED`] the job's buffers must
/// not be used again, so their invariants do not matter.
fn attempt<J: Job>(job: &mut J) -> Result<(), Fault> {
    catch_unwind(AssertUnwindSafe(|| job.run())).unwrap_or(Err(Fault::JOB_PANICKED))
}
