//! `afpc run`: compiles a plan in memory and drives the simulated robot with it.

use afp::load::{LoadedPlan, Registry};
use afp_run::options::RunOptions;
use afp_run::{Program, RunError};
use afp_sim::Simulation;
use clap::Args;

use crate::cli::PlanArgument;
use crate::plan_file::{NoPlan, PlanFile};
use crate::{Linked, runner};

/// Arguments of `afpc run`.
#[derive(Args, Debug)]
pub struct Arguments {
    #[command(flatten)]
    plan: PlanArgument,
    #[command(flatten)]
    options: RunOptions,
}

/// Runs a plan; gives the exit code.
///
/// # Errors
/// The plan is wrong, a file does not work.
pub fn run(arguments: &Arguments, linked: &[Linked]) -> Result<u8, NoPlan> {
    arguments.options.check()?;
    let file = PlanFile::read(&arguments.plan.plan)?;
    if let Some(graph) = &file.compiled.graph {
        let toolboxes = file.own.used_by(graph)?;
        runner::become_one_with(&toolboxes, linked, &file.own.project)?;
    }
    let (file, graph) = file.checked()?;
    let mut registry = Registry::<Simulation>::new();
    afp_std::templates::register(&mut registry);
    afp_carbot::templates::register(&mut registry);
    for toolbox in linked {
        (toolbox.register)(&mut registry);
    }
    let plan = LoadedPlan::new(&graph, &registry).map_err(|error| {
        let help = "the toolbox file and the Rust crate behind it do not belong together";
        RunError::usage(error.to_string(), help)
    })?;
    let path = file.path.display().to_string();
    let texts = file.compiled.plan_texts();
    let texts: Vec<_> = texts.iter().map(|(path, text)| (path.as_str(), text.as_str())).collect();
    let program = Program { name: &graph.main().name, file: &path, texts: &texts };
    Ok(afp_run::run(&program, plan, &arguments.options)?)
}
