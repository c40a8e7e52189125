//! Scenarios: runs one in the simulator, in virtual time, and says what it came to.
//!
//! `afp_dsl` reads and checks a scenario; [`run`] plays it: it starts the plan on the simulated robot,
//! lets happen what the scenario says, and looks at the trace and at the truth for what is expected.
//! `afpc test` and the tests that `afp::scenarios!` makes are thin over it.
#![forbid(unsafe_code)]

mod coverage;
mod drive;
mod generate;
mod macros;
mod parts;
mod setting;
mod stimuli;
mod verdict;
mod watch;

use std::path::Path;

use afp::load::{LoadedPlan, Registry};
use afp_dsl::graph::Graph;
use afp_dsl::scenario::Scenario;
use afp_run::RunError;
use afp_sim::Simulation;

pub use coverage::{Coverage, Part, PartKind};
pub use generate::{Generated, generate};
pub use macros::check;
pub use setting::Setting;
pub use verdict::{Broken, Verdict};
pub use watch::Activation;
pub use watch::hits::{Hits, Touched};

/// The Rust behind the templates that plans may use.
pub type Templates<'a> = &'a (dyn Fn(&mut Registry<Simulation>) + Sync);

/// Runs a scenario.
///
/// `templates` registers what the plan uses beyond `std` and `carbot`; with `log` the run is recorded
/// there.
///
/// # Errors
/// No world, or one that does not work; a template without Rust; a log that cannot be written. What the
/// plan does wrong is no error but a [`Verdict`].
pub fn run(
    scenario: &Scenario,
    setting: &Setting,
    templates: Templates<'_>,
    log: Option<&Path>,
) -> Result<Verdict, RunError> {
    let came = run_while(scenario, setting, templates, log, &mut || true)?;
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
    templates: Templates<'_>,
    log: Option<&Path>,
    go_on: &mut dyn FnMut() -> bool,
) -> Result<Option<Verdict>, RunError> {
    let plan = load(&scenario.graph, templates)?;
    drive::run(scenario, setting, plan, log, go_on)
}

/// Loads a plan; `templates` registers what it uses beyond `std` and `carbot`.
///
/// # Errors
/// A template without Rust.
pub fn load(graph: &Graph, templates: Templates<'_>) -> Result<LoadedPlan<Simulation>, RunError> {
    let mut registry = Registry::<Simulation>::new();
    afp_std::templates::register(&mut registry);
    afp_carbot::templates::register(&mut registry);
    templates(&mut registry);
    LoadedPlan::new(graph, &registry).map_err(|error| {
        let help = "the toolbox file and the Rust crate behind it do not belong together";
        RunError::usage(error.to_string(), help)
    })
}
