//! `afpc run`: compiles a plan in memory and drives the simulated robot with it.

use afp_run::Program;
use afp_run::options::RunOptions;
use afp_session::{AnyWorld, Loader};
use clap::Args;

use crate::cli::PlanArgument;
use crate::picture;
use crate::plan_file::{NoPlan, PlanFile};
use crate::{Linked, robot, runner};

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
    runner::become_one_for(file.compiled.graph.iter().map(|graph| (&file.own, graph)), linked)?;
    let (file, graph) = file.checked()?;
    let robot = robot(linked);
    let make = |world: &dyn AnyWorld, seed: u64, measures: &[&str]| {
        robot.session(&graph, world, seed, measures)
    };
    let path = file.path.display().to_string();
    let texts = file.compiled.plan_texts();
    let texts: Vec<_> = texts.iter().map(|(path, text)| (path.as_str(), text.as_str())).collect();
    let program = Program { name: &graph.main().name, file: &path, texts: &texts };
    let pixels = |svg: &str| picture::pixels(svg, picture::DEFAULT_SCALE);
    Ok(afp_run::run(&program, &robot, Box::new(make), &arguments.options, Some(&pixels))?)
}
