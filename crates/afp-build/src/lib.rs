//! Builds generated crates with cargo, and keeps those that more than one command needs.
//!
//! A plan is interpreted, but robots and templates are Rust. So whoever runs plans of a project with a robot or
//! toolboxes of its own needs them linked: into a *runner*, which is `afpc` with them, or into a *Python
//! extension*. [`Parts`] are what is linked; [`Parts::product`] gives the file that has them, built where it is not
//! there yet and kept until something that it was built from changes.
#![forbid(unsafe_code)]

pub mod cargo;
pub mod crate_folder;
mod kept;
pub mod origin;
mod parts;

use afp_project::ProjectError;
use afp_run::RunError;

pub use kept::{Product, cache};
pub use parts::{Parts, no_hardware};

/// Why something was not built.
#[derive(Debug)]
pub enum NotBuilt {
    Why(RunError),
    /// It has been told, to people or to tools.
    Told {
        /// The first error in a line, with its place in Rust; `None` where cargo got to none.
        first: Option<String>,
    },
}

impl From<RunError> for NotBuilt {
    fn from(why: RunError) -> Self {
        NotBuilt::Why(why)
    }
}

impl From<ProjectError> for NotBuilt {
    fn from(why: ProjectError) -> Self {
        NotBuilt::Why(why.into())
    }
}
