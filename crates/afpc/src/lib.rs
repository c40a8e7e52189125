//! The command line of Action Flow Plans: arguments, files, exit codes.
//!
//! It is a library so that a *runner* can be made: the same program with a robot and toolboxes of one's own linked
//! in, which `afpc` builds, keeps and becomes when a plan needs them.

mod cli;
mod commands;
mod declared;
mod early;
mod nearby;
mod no_plan;
mod picture;
mod plan_file;
mod reader;
mod runner;
mod targets;
mod toolchain;

use std::process::ExitCode;

use afp_build::Parts;
use afp_session::{Loader, Opener};

pub use afp_session::{hardware, simulated};
pub use afp_sim::carbot;

/// What runners name of the crates below.
#[doc(hidden)]
pub mod __private {
    pub use afp_session::__private::afp_core;
    pub use afp_sim::Simulation;
}

/// Trees are many small pieces; checking a large plan takes a third less time than with the
/// allocator of the system.
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

/// What this program was built with, of what can be left out: the runners that it builds have the same, but for the studio,
/// which asks them over the debug adapter's protocol.
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

/// What is linked into the program.
#[derive(Clone, Copy)]
pub struct Linked<'a> {
    /// The robot that plans run on, with the templates that they may use.
    pub robot: &'a dyn Loader,
    /// The path of the robot's type, where it is one of a project; none for the Carbot.
    pub own_robot: Option<&'a str>,
    /// The robot itself, by the path of its type, where it is linked in.
    pub hardware: Option<(&'a str, &'a dyn Opener)>,
    /// The toolboxes beside the built-in ones, by the names behind `use`.
    pub toolboxes: &'a [&'a str],
}

impl Linked<'_> {
    /// Whether all of these parts are linked in.
    fn has(&self, parts: &Parts<'_>) -> bool {
        let hardware = self.hardware.map(|(name, _)| name);
        parts.are_in(self.own_robot, hardware, self.toolboxes)
    }

    /// Whether anything of a project is linked in.
    fn is_runner(&self) -> bool {
        self.own_robot.is_some() || !self.toolboxes.is_empty()
    }
}

/// The whole program.
pub fn main(linked: &Linked<'_>) -> ExitCode {
    cli::run(linked)
}
