//! The command line of Action Flow Plans: arguments, files, exit codes.
//!
//! It is a library so that a *runner* can be made: the same program with toolboxes of one's own
//! linked in, which `afpc` builds, keeps and becomes when a plan needs them.

mod cargo;
mod cli;
mod commands;
mod crate_folder;
mod origin;
mod picture;
mod plan_file;
mod runner;
mod toolboxes;

use std::process::ExitCode;

use afp::load::Registry;
use afp_session::Loader;
use afp_sim::Simulation;

/// Trees are many small pieces; checking a large plan takes a third less time than with the
/// allocator of the system.
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

/// A toolbox that is linked in beside the built-in ones.
#[derive(Clone, Copy, Debug)]
pub struct Linked {
    /// The name behind `use`.
    pub toolbox: &'static str,
    /// Names its templates to a registry: the function `register` that `toolbox!` makes.
    pub register: fn(&mut Registry<Simulation>),
}

/// The robot that plans run on: the Carbot, with the templates of linked toolboxes.
fn robot(linked: &[Linked]) -> impl Loader {
    afp_sim::carbot(|registry| linked.iter().for_each(|toolbox| (toolbox.register)(registry)))
}

/// The whole program.
pub fn main(linked: &'static [Linked]) -> ExitCode {
    commands::dispatch(&cli::parse(&robot(linked)), linked)
}
