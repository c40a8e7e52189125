//! What users name in Cargo.toml: the run time, the macros, and plans loaded at run time.
//!
//! A plan known when a program is built is best compiled in, by `plan!`; a plan that comes as a
//! file at run time is loaded by the `load` module. Both drive the scheduler of `afp-core`.

pub use afp_core as core;
pub use afp_core::{
    Duration, Ending, Environment, Fault, Instant, Scheduler, StillClock, Text, Value, ValueRef,
    Wake, quantity, trace,
};

#[cfg(feature = "load")]
pub mod load;
