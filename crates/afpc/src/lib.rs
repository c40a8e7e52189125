//! The command line of Action Flow Plans: arguments, files, exit codes.
//!
//! It is a library for *runners*: the same program linked with a project's robot and toolboxes.
//! `afpc` builds a runner when a plan needs it, caches it, and becomes it.

mod cli;
mod commands;
mod declared;
mod early;
#[cfg(all(feature = "pi", unix))]
mod in_the_loop;
mod nearby;
mod no_plan;
mod picture;
mod plan_file;
mod reader;
mod real;
mod runner;
mod targets;
mod toolchain;

use std::process::ExitCode;

use afp_build::Parts;
use afp_session::{Loader, Opener};

pub use afp_session::{hardware, only_hardware, simulated};
pub use afp_sim::carbot;

/// The names that runners use of the lower crates.
#[doc(hidden)]
pub mod __private {
    pub use afp_session::__private::afp_core;
    pub use afp_sim::Simulation;
}

/// Trees consist of many small pieces: a check of a large plan takes a third less time than with
/// the system's allocator.
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

/// The enabled optional features. Runners get the same features except the studio, which talks to
/// them over the debug adapter's protocol.
const FEATURES: &[&str] = &[
    #[cfg(feature = "dap")]
    "dap",
    #[cfg(feature = "live")]
    "live",
    #[cfg(feature = "lsp")]
    "lsp",
    #[cfg(feature = "parquet")]
    "parquet",
    #[cfg(feature = "png")]
    "png",
];

/// The parts that are linked into the program.
#[derive(Clone, Copy)]
pub struct Linked<'a> {
    /// The robot for plans, with its templates.
    pub robot: &'a dyn Loader,
    /// The path of the robot's type if a project defines it; `None` for the Carbot.
    pub own_robot: Option<&'a str>,
    /// The hardware robot and the path of its type, if it is linked in.
    pub hardware: Option<(&'a str, &'a dyn Opener)>,
    /// The toolboxes in addition to the built-in ones, by their names in `use`.
    pub toolboxes: &'a [&'a str],
}

impl Linked<'_> {
    fn has(&self, parts: &Parts<'_>) -> bool {
        let hardware = self.hardware.map(|(name, _)| name);
        parts.are_in(self.own_robot, hardware, self.toolboxes)
    }

    /// Whether a part of a project is linked in.
    fn is_runner(&self) -> bool {
        self.own_robot.is_some() || self.hardware.is_some() || !self.toolboxes.is_empty()
    }
}

/// Runs the program.
pub fn main(linked: &Linked<'_>) -> ExitCode {
    cli::run(linked)
}
