//! Scenarios: runs one in the simulator, in virtual time, and returns its verdict.
//!
//! `afp_dsl` parses and checks a scenario. [`run`] starts the plan on a simulated robot and
//! requests the scenario's actions. It compares the trace and the robot's signals with the
//! expectations. `afpc test` and the tests of `afp::scenarios!` are thin layers over this crate.
#![forbid(unsafe_code)]
#![warn(missing_docs)]

mod coverage;
mod drive;
mod generate;
mod macros;
pub mod mutate;
mod parts;
mod setting;
mod stimuli;
mod verdict;
mod watch;

use std::path::Path;

use afp_core::{Ending, Fault};
use afp_dsl::Compiled;
use afp_dsl::scenario::Scenario;
use afp_run::RunError;
use afp_run::panics::{Caught, caught};
use afp_session::Loader;

pub use coverage::{Coverage, Part, PartKind};
pub use generate::{Generated, generate, is_generated};
pub use macros::check;
pub use setting::Setting;
pub use verdict::Verdict;
pub use watch::hits::{Hits, Touched};
pub use watch::{Activation, Broken};

/// The recording of a run, with the inputs that repeat it.
#[derive(Clone, Copy)]
pub struct Recording<'a> {
    /// Its path.
    pub path: &'a Path,
    /// Its plans and scenarios.
    pub compiled: &'a Compiled,
}

/// Runs a scenario on a robot; with `log`, records the run.
///
/// # Errors
/// A missing or invalid world, a template without Rust, an unwritable log, or a panicking robot.
/// Failures of the plan are not errors but part of the [`Verdict`], including panics of a
/// component.
pub fn run(
    scenario: &Scenario,
    setting: &Setting,
    robot: &dyn Loader,
    log: Option<Recording<'_>>,
) -> Result<Verdict, RunError> {
    let came = run_while(scenario, setting, robot, log, &mut || true)?;
    came.ok_or_else(|| RunError::usage("the scenario was cancelled", "run it again"))
}

/// Runs a scenario like [`run`], while `go_on` returns true. It is called whenever time is about to
/// advance. Returns `None` after a cancellation.
///
/// # Errors
/// As [`run`].
pub fn run_while(
    scenario: &Scenario,
    setting: &Setting,
    robot: &dyn Loader,
    log: Option<Recording<'_>>,
    go_on: &mut dyn FnMut() -> bool,
) -> Result<Option<Verdict>, RunError> {
    let Caught { done, said } = caught(|| drive::run(scenario, setting, robot, log, go_on));
    let Some(came) = done else { return Err(RunError::Panicked { said }) };
    let mut came = came?;
    if let Some(verdict) = &mut came
        && verdict.ending == Some(Ending::Error(Fault::PANIC))
    {
        verdict.panic = Some(said).filter(|said| !said.is_empty());
    }
    Ok(came)
}
