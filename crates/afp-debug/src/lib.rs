//! The debug adapter as a value: the [Debug Adapter Protocol] over a running plan.
//!
//! An [`Adapter`] is handed the messages of a client and gives those that go back, and it is told from time to time
//! how late it is. It has no thread, no socket and no clock. What it debugs is a [`Target`]: [`SessionTarget`] is a
//! session over a simulated robot, whose time stands still while the plan is held, so that a run which was paused,
//! stepped and stepped back has the trace of one which was not; [`LogTarget`] is a run that is over, from its log.
//!
//! How a plan is a program: thread 1 is the flow of action, its stack the active element of each nested plan; every
//! supervisor that is watching is a thread of its own. A breakpoint belongs to a place in the text: an element that
//! starts, an edge that is taken, a supervisor that reports, an entry that is written. A step of the scheduler is never
//! taken apart: the run stands still right after the step in which it happened, before any time has passed.
//!
//! [Debug Adapter Protocol]: https://microsoft.github.io/debug-adapter-protocol/
#![forbid(unsafe_code)]

mod adapter;
mod breakpoints;
mod hit_count;
mod log_target;
mod program;
mod sensed;
mod session_target;
mod state;
mod target;
mod text;
mod watched;

pub use adapter::{Adapter, ClientId, Host, Launch, Outgoing, Surroundings};
pub use log_target::LogTarget;
pub use program::{Entry, Place, Program, Spot, Times, Unit};
pub use sensed::{Cone, Sensed};
pub use session_target::SessionTarget;
pub use state::State;
pub use target::{Advance, Happened, Position, Target};
