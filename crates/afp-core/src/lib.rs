//! The run time of Action Flow Plans: time, values, configuration, component traits, scheduler,
//! trace.
//!
//! One scheduler drives compiled plans and plans loaded at run time. It works without the standard
//! library, allocates nothing, and never panics.
#![no_std]
#![forbid(unsafe_code)]
#![warn(missing_docs)]
#![cfg_attr(not(test), warn(clippy::disallowed_methods))]

mod clock;
mod component;
pub mod devices;
mod fault;
mod job;
mod machine;
mod platform;
pub mod quantity;
mod reading;
#[doc(hidden)]
pub mod rt;
mod scheduler;
pub mod trace;

pub use core::task::Poll;

pub use afp_types::{
    Duration, ElementId, EntryId, Instant, MAX_TEXT, MAX_TRANSITIONS_PER_STEP, Text, Value,
    ValueOf, ValueRef,
};
pub use clock::{Clock, StillClock};
pub use component::{
    Actor, ActorTemplate, Computation, ComputationTemplate, Environment, Events, OnReturn,
    Resumable, Supervisor, SupervisorTemplate,
};
pub use fault::{Detail, Failure, Fault, Reason, Subject};
pub use job::{Job, Ticket, Worker};
pub use platform::Platform;
pub use reading::{Invalid, Reading};
pub use rt::{NamedPlan, Plan, PlanState, Run, Scale, Unit, WriteError};
pub use scheduler::{
    MAX_WRITES_PER_STEP, Release, Scheduler, SetError, StartError, TypedEntry, Wake,
};
pub use trace::Ending;
