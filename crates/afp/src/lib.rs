//! What users name in Cargo.toml: the run time, the macros, and plans loaded at run time.
//!
//! A plan known when a program is built is best compiled in, by [`plan!`]; a plan that comes as a
//! file at run time is loaded by [`load()`]. Both are driven by a [`Scheduler`] on a [`Platform`]. A
//! whole program, with a plan that only waits:
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
//! - Time: [`Scheduler::run`], [`Scheduler::run_until`]; in a loop of one's own [`Scheduler::start`] and
//!   [`Scheduler::step`].
//! - What happens: [`Callbacks`] by name, [`trace::Observe`] for every record.
//! - Templates of one's own: [`toolbox!`], [`Actor`], [`Supervisor`], [`Computation`].
//! - Tests: [`scenarios!`].
#![warn(missing_docs)]
#![cfg_attr(not(test), warn(clippy::disallowed_methods))]

pub use afp_core as core;
pub use afp_core::{
    Actor, Clock, Computation, Detail, Duration, ElementId, Ending, EntryId, Environment, Events,
    Failure, Fault, Instant, Job, NamedPlan, Plan, PlanState, Platform, Poll, Reading, Reason, Run,
    Scheduler, SetError, StartError, StillClock, Subject, Supervisor, Text, Ticket, TypedEntry,
    Value, ValueRef, Wake, Worker, WriteError, quantity, trace,
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
/// `afp::plan!("plans/wall_following.afp")`, with a path relative to the crate's manifest, makes a
/// module for each plan of the file that is used, and brings the plan's type (`WallFollowing`)
/// into scope: a typed plan with `new`, a getter for each entry and a setter for each `in` entry,
/// to be driven by a [`Scheduler`]. Toolboxes that are not built in are found through `afp.toml`,
/// beside the manifest or above. The crates of the toolboxes in use (`afp-carbot`, `afp-std`, one's
/// own) must be dependencies. A mistake in the plan is a compile error at its place in the plan.
#[macro_export]
macro_rules! plan {
    ($($arguments:tt)*) => {
        $crate::macros::plan!($crate::core, $($arguments)*);
    };
}

/// Makes a `#[test]` of each scenario of a file or of the files of a folder.
///
/// `afp::scenarios!("plans/tests")`, with a path relative to the crate's manifest, belongs into a test;
/// `afp-test`, and `afp-sim` with its feature `load`, must be dev-dependencies. Behind the path may stand the functions
/// that register the templates of toolboxes of one's own: `afp::scenarios!("tests", gripper::templates::register)`.
/// With `afp::scenarios!("tests", robot = vacuum::Vacuum)` they run on another robot, with the toolboxes that the plans
/// use; `afp-session` with its feature `load` takes the place of `afp-sim`. A
/// mistake in a scenario is a compile error; a failed one panics with what broke and the timeline around
/// it. A new file in the folder is seen when the test is next compiled.
#[macro_export]
macro_rules! scenarios {
    ($($arguments:tt)*) => {
        $crate::macros::scenarios!($($arguments)*);
    };
}

/// Makes typed templates from a toolbox file.
///
/// It belongs into a module beside the types that implement the templates under the templates'
/// names: `pub mod templates { afp::toolbox!("signals.afp", robot: super::Lights); }`.
///
/// Behind the file stand the traits that a robot implements which can use every template, nothing where templates ask
/// for none, or `robot = Bench` where they are implemented for one type alone. What is declared and not implemented for
/// such a robot does not compile:
///
/// ```compile_fail,E0277
/// /// The type is there, the implementation of the template is not.
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
