//! The reasons why a command has no plan.

use std::fmt;

use afp_build::NotBuilt;
use afp_project::ProjectError;
use afp_run::RunError;

/// The reason for a missing graph.
pub enum NoPlan {
    /// A file cannot be read.
    File(RunError),
    /// The plan is invalid; the errors were printed.
    Wrong,
    /// The plan's Rust code does not compile. The errors were printed; this is their first line.
    NotBuilt(Option<String>),
}

impl fmt::Display for NoPlan {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            NoPlan::File(error) => error.fmt(f),
            NoPlan::Wrong => f.write_str("the plan has errors"),
            NoPlan::NotBuilt(Some(first)) => f.write_str(first),
            NoPlan::NotBuilt(None) => f.write_str("cargo could not build it"),
        }
    }
}

impl From<RunError> for NoPlan {
    fn from(error: RunError) -> Self {
        NoPlan::File(error)
    }
}

impl From<NotBuilt> for NoPlan {
    fn from(why: NotBuilt) -> Self {
        match why {
            NotBuilt::Why(error) => NoPlan::File(error),
            NotBuilt::Told { first } => NoPlan::NotBuilt(first),
        }
    }
}

impl From<ProjectError> for NoPlan {
    fn from(error: ProjectError) -> Self {
        NoPlan::File(error.into())
    }
}
