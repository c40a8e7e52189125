//! The dependency for users: the run time, the macros, and plans loaded at run time.
//!
//! [`plan!`] compiles a plan into the program; [`load()`] loads a plan file at run time. A
//! [`Scheduler`] drives both on a [`Platform`]. A whole program, with a plan that only waits:
//!
//! ```text
#![doc = include_str!("../examples/patience.afp")]
//! ```
//!
#![cfg_attr(feature = "load", doc = "```")]
#![cfg_attr(not(feature = "load"), doc = "```text")]
#![doc = include_str!("../examples/patience.rs")]
//! ```
//!
//! - Values of entries: [`Scheduler::set`], [`Scheduler::set_named`], [`Scheduler::get`].
//! - Time: [`Scheduler::run`], [`Scheduler::run_until`]; in your own loop [`Scheduler::start`] and
//!   [`Scheduler::step`].
//! - Events: [`Callbacks`] by name, [`trace::Observe`] for every record.
//! - Your own templates: [`toolbox!`], [`Actor`], [`Supervisor`], [`Computation`].
//! - Tests: [`scenarios!`].
#![warn(missing_docs)]
#![cfg_attr(not(test), warn(clippy::disallowed_methods))]

pub use afp_core as core;
pub use afp_core::{
    Actor, Clock, Computation, Detail, Duration, ElementId, Ending, EntryId, Environment, Events,
    Failure, Fault, Instant, Job, NamedPlan, OnReturn, Plan, PlanState, Platform, Poll, Reading,
    Reason, Resumable, Run, Scheduler, SetError, StartError, StillClock, Subject, Supervisor, Text,
    Ticket, TypedEntry, Value, ValueRef, Wake, Worker, WriteError, quantity, trace,
};

mod callbacks;
#[cfg(feature = "load")]
pub mod load;

pub use callbacks::{Callbacks, UnknownName};
#[cfg(feature = "load")]
pub use load::load;

#[doc(hidden)]
pub use afp_macros as macros;

/// Compiles the first plan of a file into the program.
///
/// `afp::plan!("plans/wall_following.afp")`, with a path relative to the crate's manifest,
/// generates a module for each used plan of the file, and brings the plan's type (`WallFollowing`)
/// into scope: a typed plan with `new`, a getter for each entry and a setter for each `in` entry.
/// Drive it with a [`Scheduler`]. Other toolboxes than the built-in ones are found through the
/// `afp.toml` in the manifest's folder or above. The crates of the used toolboxes (`afp-carbot`,
/// `afp-std`, your own) must be dependencies. An error in the plan is a compile error with its
/// place in the plan.
#[macro_export]
macro_rules! plan {
    ($($arguments:tt)*) => {
        $crate::macros::plan!($crate::core, $($arguments)*);
    };
}

/// Generates a `#[test]` for each scenario of a file or folder.
///
/// `afp::scenarios!("plans/tests")`, with a path relative to the crate's manifest, belongs into a
/// test. `afp-test`, and `afp-sim` with its feature `load`, must be dev-dependencies. Functions
/// that register your own toolboxes follow the path: `afp::scenarios!("tests",
/// gripper::templates::register)`. `afp::scenarios!("tests", robot = vacuum::Vacuum)` uses another
/// robot, with the toolboxes that the plans use; `afp-session` with its feature `load` then
/// replaces `afp-sim`. An error in a scenario is a compile error; a failed scenario panics with its
/// violations and their timeline. New files in the folder are found at the next compilation.
#[macro_export]
macro_rules! scenarios {
    ($($arguments:tt)*) => {
        $crate::macros::scenarios!($($arguments)*);
    };
}

/// Generates typed templates from a toolbox file.
///
/// Use it in a submodule of the module whose types implement the templates under the same names:
/// `pub mod templates { afp::toolbox!("signals.afp", robot: super::Lights); }`.
///
/// After the file, list the traits that the templates need from a robot, or `robot = Bench` if they
/// are implemented only for this type. Omit it if no template needs a trait. A template that is not
/// implemented for such a robot does not compile:
///
/// ```compile_fail,E0277
/// /// The type exists, but does not implement the template.
/// #[derive(Clone)]
/// pub struct Announce;
///
/// pub mod templates {
///     afp::toolbox!("../../examples/embed/shop.afp");
/// }
/// ```
#[macro_export]
macro_rules! toolbox {
    ($($arguments:tt)*) => {
        $crate::macros::toolbox!($crate::core, $($arguments)*);
    };
}
