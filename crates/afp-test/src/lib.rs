//! Scenarios: runs one in the simulator, in virtual time, and says what it came to.
//!
//! `afp_dsl` reads and checks a scenario; [`run`] plays it: it starts the plan on a simulated robot,
//! asks for what the scenario says, and looks at the trace and at the robot's signals for what is expected.
//! `afpc test` and the tests that `afp::scenarios!` makes are thin over it.
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

/// Where a run is recorded, with what it takes to repeat it.
#[derive(Clone, Copy)]
pub struct Recording<'a> {
    /// The file of the log.
    pub path: &'a Path,
    /// What the scenario was read from.
    pub compiled: &'a Compiled,
}

/// Runs a scenario on a robot; with `log` the run is recorded there.
///
/// # Errors
/// No world, or one that does not work; a template without Rust; a log that cannot be written; a robot that panics. What
/// the plan does wrong is no error but a [`Verdict`], and that a component panics, too.
pub fn run(
    scenario: &Scenario,
    setting: &Setting,
    robot: &dyn Loader,
    log: Option<Recording<'_>>,
) -> Result<Verdict, RunError> {
    let came = run_while(scenario, setting, robot, log, &mut || true)?;
    came.ok_or_else(|| RunError::usage("the scenario was called off", "run it again"))
}

/// Runs a scenario as [`run`] does, as long as `go_on` says so: it is asked whenever time is about to pass.
/// `None` when it was called off.
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
