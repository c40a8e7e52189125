//! Workers: who does the [`Job`]s of components, in virtual and in real time.
//!
//! [`VirtualWorker`] computes when it is asked and has the result ready after the declared time, so
//! that a run is the same on every machine. [`ThreadWorker`] has a thread of its own and the result
//! ready when it is. A component cannot tell them apart but by the time they take.

mod slots;
mod thread;
mod virtual_time;

pub use thread::ThreadWorker;
pub use virtual_time::VirtualWorker;

use afp_core::{Fault, Job};
use std::panic::{AssertUnwindSafe, catch_unwind};

/// Runs a job and turns a panic into a fault. Whoever gets [`Fault::JOB_PANICKED`] must not use the
/// job's buffers again, which is why no invariant of theirs needs to hold.
fn attempt<J: Job>(job: &mut J) -> Result<(), Fault> {
    catch_unwind(AssertUnwindSafe(|| job.run())).unwrap_or(Err(Fault::JOB_PANICKED))
}
