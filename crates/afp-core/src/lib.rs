//! The run time of Action Flow Plans: time, values, configuration, component traits, scheduler, trace.
//!
//! One scheduler drives plans compiled to Rust and plans loaded at run time alike. It needs no
//! standard library, allocates nothing, and never panics.
#![no_std]
#![forbid(unsafe_code)]

mod component;
mod fault;
pub mod quantity;
mod time;

pub use component::{
    Actor, ActorTemplate, Computation, ComputationTemplate, Environment, Events, Poll, Supervisor,
    SupervisorTemplate,
};
pub use fault::{Fault, Reason};
pub use time::{Duration, Instant};
