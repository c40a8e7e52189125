//! `afpc run`: compiles a plan in memory and drives the project's robot with it, in simulation or
//! for real.

use std::path::Path;

use afp_project::Robot;
use afp_run::options::{OnRobot, RunOptions};
use afp_run::{Extras, Program, RunError, check_apart};
use afp_session::{AnyWorld, Settings};
use clap::Args;

use crate::no_plan::NoPlan;
use crate::picture;
use crate::plan_file::PlanFile;
use crate::{Linked, early, real, runner};

/// Arguments of `afpc run`.
#[derive(Args, Debug)]
pub struct Arguments {
    /// File with the plan; append ':Plan' to select a plan other than the first [default with
    /// '--again': the plan of the log]
    #[arg(value_name = "FILE[:PLAN]", required_unless_present = "again")]
    plan: Option<String>,
    #[command(flatten)]
    options: RunOptions,
}

/// The plan of a log whose run can be repeated.
fn of_log(log: &Path) -> Result<PlanFile, RunError> {
    let file = PlanFile::of_log(&afp_log::read(log)?, log)?;
    let path = log.display();
    let Some(name) = file.foreign.first() else {
        let Some(robot) = file.robot.as_ref().and_then(Robot::rust_type) else { return Ok(file) };
        return Err(RunError::usage(
            format!("the run of '{path}' drove the robot '{robot}', whose Rust code is not here"),
            "repeat it in the folder of its project, or with the built program: '--again'",
        ));
    };
    Err(RunError::usage(
        format!("the run of '{path}' used the toolbox '{name}', whose Rust code is not here"),
        format!(
            "where it is written in Python, Python repeats the run: \
             afp.Log(\"{path}\").simulation(toolboxes=[{name}]).run(); where it is of a project, name it in '[toolboxes]' of afp.toml"
        ),
    ))
}

/// Runs a plan and returns the exit code.
///
/// # Errors
/// The plan is invalid, a file cannot be used.
pub fn run(arguments: &Arguments, linked: &Linked<'_>) -> Result<u8, NoPlan> {
    arguments.options.check()?;
    let file = match (&arguments.plan, &arguments.options.again) {
        (Some(plan), _) => PlanFile::read(plan)?,
        (None, Some(log)) => of_log(log)?,
        (None, None) => return Err(RunError::usage("no plan is named", "name its file").into()),
    };
    early::check(&file, &arguments.options, linked)?;
    let itself = arguments.options.robot == OnRobot::Hardware;
    match &file.compiled.graph {
        Some(graph) if itself => real::link(&file.own, graph, linked)?,
        graph => runner::become_one_for(graph.iter().map(|graph| (&file.own, graph)), linked)?,
    }
    let (file, graph) = file.checked()?;
    let sources = file.compiled.plan_sources().map(|source| Path::new(&source.name));
    check_apart(arguments.options.outputs(), sources)?;
    let path = file.path.display().to_string();
    let texts = file.compiled.plan_texts();
    let texts: Vec<_> = texts.iter().map(|(path, text)| (path.as_str(), text.as_str())).collect();
    let settings = if itself { real::settings(&file.own.project)? } else { Vec::new() };
    let settings: Vec<_> =
        settings.iter().map(|(name, value)| (name.as_str(), value.as_str())).collect();
    let name = &graph.main().name;
    let toolboxes: Vec<_> = file.own.texts().collect();
    let program = Program {
        name,
        file: &path,
        texts: &texts,
        toolboxes: &toolboxes,
        project: &file.own.project.text,
        hardware: &settings,
    };
    let pixels = |svg: &str| picture::pixels(svg, picture::DEFAULT_SCALE);
    let options = &arguments.options;
    #[cfg(all(feature = "dap", unix))]
    let socket = super::dap::Socket { graph: &graph, file: &file };
    let extras = Extras {
        rasterizer: Some(&pixels),
        #[cfg(all(feature = "dap", unix))]
        debugger: (itself || options.attach).then_some(&socket),
        #[cfg(not(all(feature = "dap", unix)))]
        debugger: None,
    };
    if itself {
        let open = |settings: &Settings| real::open(&file.own.project, &graph, settings, linked);
        return Ok(afp_run::run_on_hardware(&program, Box::new(open), options, extras)?);
    }
    let make = |world: &dyn AnyWorld, seed: u64, measures: &[&str]| {
        linked.robot.session(&graph, world, seed, measures)
    };
    Ok(afp_run::run(&program, linked.robot.kind(), Box::new(make), options, extras)?)
}
