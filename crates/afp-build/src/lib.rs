//! Builds generated crates with cargo, and caches those that several commands need.
//!
//! A plan is interpreted, but robots and templates are Rust. Plans of a project with its own robot
//! or toolboxes need a program with them: a *runner*, which is `afpc` linked with them, or a
//! *Python extension*. [`Parts`] are the linked parts. [`Parts::product`] returns the file, cached
//! until one of its sources changes.
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

/// The reason for a missing product.
#[derive(Debug)]
pub enum NotBuilt {
    Why(RunError),
    /// The reason was reported to people or tools.
    Told {
        /// The first error in one line, with its place in Rust; `None` if cargo reported none.
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
