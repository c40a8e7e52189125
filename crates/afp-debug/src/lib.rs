//! The debug adapter as a value: the [Debug Adapter Protocol] over a running plan.
//!
//! An [`Adapter`] takes messages of clients and returns messages to them. Its owner also calls it
//! regularly with the time. It has no thread, no socket and no clock. It debugs a [`Target`]. A
//! [`SessionTarget`] is a session over a simulated robot. Its time stops while the plan is paused,
//! so pausing and stepping do not change the trace. A [`LogTarget`] is a recorded run.
//!
//! A plan maps to a program as follows. Thread 1 is the flow of action, and its stack is the active
//! element of each nested plan. Every watching supervisor is a separate thread. A breakpoint
//! belongs to a place in the text: an element that starts, an edge, a supervisor's report, or a
//! write to an entry. The run stops right after the scheduler step of the hit, before time passes.
//! It never stops inside a step.
//!
//! [Debug Adapter Protocol]: https://microsoft.github.io/debug-adapter-protocol/
#![forbid(unsafe_code)]

mod adapter;
mod breakpoints;
mod hit_count;
mod live_target;
mod log_target;
mod moment;
mod plotted;
mod program;
mod sensed;
mod session_target;
mod state;
mod target;
mod text;
mod watched;

pub use adapter::{Adapter, ClientId, Fork, Host, Launch, Outgoing, Surroundings};
pub use live_target::{LiveTarget, Relay};
pub use log_target::LogTarget;
pub use moment::{FoundMoment, moment};
pub use plotted::Plotted;
pub use program::{Entry, Place, Program, Spot, Times, Unit};
pub use sensed::{Cone, Sensed};
pub use session_target::SessionTarget;
pub use state::State;
pub use target::{Advance, Happened, Position, Target};
