//! Plans loaded at run time: the same scheduler with boxed components.
//!
//! A [`Registry`] has the Rust implementation of each template; [`LoadedPlan::new`] makes an
//! instance of a checked graph. It allocates everything; a step allocates nothing.

mod config;
mod declared;
mod error;
mod formula;
mod inject;
mod library;
mod names;
mod outputs;
mod plan;
mod registry;
mod row;
mod slots;
mod tables;

pub use afp_core::rt::{Args, BadValue, Outputs};
pub use afp_dsl::graph::Graph;
pub use error::LoadError;
pub use inject::{Injection, NotInjected};
pub use library::load;
pub use library::{Library, OpenError, Templates};
pub use names::PlanNames;
pub use plan::LoadedPlan;
pub use registry::Registry;
pub use slots::{ActorSlot, ComputationSlot, See, SupervisorSlot};

/// Numbers items with 16 bits, the limit of a plan's tables.
fn numbered<T>(items: impl IntoIterator<Item = T>) -> impl Iterator<Item = (u16, T)> {
    (0..=u16::MAX).zip(items)
}
