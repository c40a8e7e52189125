//! Random worlds: a random room, a plan and random stimuli, for thirty seconds.
//!
//! [`Case::random`] makes one from a number and [`run`] drives it. [`Watch`] lists the rules that
//! are checked during the run. Nothing depends on the machine, so the hash of a case's trace is the
//! same everywhere.
#![forbid(unsafe_code)]

mod case;
mod chance;
mod contact;
mod drive;
mod errand;
mod plans;
mod push;
mod reach;
mod sensor;
mod single;
mod watch;
mod witness;

pub use case::Case;
pub use chance::{Chance, Stimulus};
pub use contact::Contact;
pub use drive::{Outcome, run};
pub use errand::Errand;
pub use plans::{Plan, plan, plan_of, plans};
pub use push::{Push, Pushes};
pub use reach::Reach;
pub use single::{Account, Single};
pub use watch::Watch;
