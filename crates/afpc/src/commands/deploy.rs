//! `afpc deploy`: puts a plan on a robot and starts it there, disarmed.

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::process::Command;

use afp_deploy::client::check_version;
use afp_deploy::manifest::{Entry, Kind, Manifest};
use afp_deploy::sha256;
use afp_dsl::graph::Graph;
use afp_project::Robot;
use afp_run::{RunError, say};
use afp_session::Build;
use clap::Args;

use super::agent::{model_of, trace_of};
use super::robot::connect::Remote;
use super::robot::setup::architecture;
use super::robot::{ran, tell};
use crate::no_plan::NoPlan;
use crate::plan_file::{PlanArgument, PlanFile};

/// Arguments of `afpc deploy`.
#[derive(Args, Debug)]
pub struct Arguments {
    #[command(flatten)]
    plan: PlanArgument,
    /// Host of ssh, or 'exec:COMMAND' for an agent on this machine
    #[arg(long, value_name = "HOST")]
    to: String,
    /// Robot of the run on HOST; 'sim' drives no motors
    #[arg(long, value_name = "ROBOT", default_value = "hardware")]
    robot: String,
    /// Set an 'in' entry, with its unit: --set distance=35cm
    #[arg(long, value_name = "ENTRY=VALUE", value_parser = assignment)]
    set: Vec<(String, String)>,
    /// Send this program of 'afpc build' instead of the plan's text
    #[arg(long, value_name = "PROGRAM")]
    built: Option<PathBuf>,
    /// Stop a robot that is armed
    #[arg(long)]
    stop_first: bool,
}

pub const EXAMPLES: &str = "\
Examples:
  afpc deploy plans/patrol.afp --to afp@robot.local
  afpc deploy plans/patrol.afp --to afp@robot.local --robot sim
  afpc deploy plans/clean.afp --to afp@robot.local --built clean

The robot starts disarmed: 'afpc robot arm afp@robot.local' lets it drive.";

fn assignment(text: &str) -> Result<(String, String), String> {
    let (name, value) = text.split_once('=').ok_or("write ENTRY=VALUE")?;
    Ok((name.to_owned(), value.to_owned()))
}

/// The files of a release, by hash.
type Contents = BTreeMap<String, Vec<u8>>;

/// Deploys a plan and returns the exit code.
///
/// # Errors
/// The plan is invalid, the robot cannot be reached or refuses the plan.
pub fn run(arguments: &Arguments) -> Result<u8, NoPlan> {
    let (file, graph) = PlanFile::read(&arguments.plan.plan)?.checked()?;
    let mut contents = Contents::new();
    let mut add = |path: String, content: Vec<u8>| {
        let entry = Entry { path, size: content.len() as u64, sha256: sha256(&content) };
        contents.insert(entry.sha256.clone(), content);
        entry
    };
    let (kind, files) = match &arguments.built {
        Some(path) => {
            let program = std::fs::read(path).map_err(RunError::file("cannot read", path))?;
            let architecture = architecture(&program).to_owned();
            let entries = vec![add("program".to_owned(), program)];
            (Kind::Built { architecture }, entries)
        }
        None => {
            needs_no_rust(&file, &graph)?;
            let texts = file.compiled.plan_texts().into_iter();
            (Kind::Interpreted, texts.map(|(path, text)| add(path, text.into_bytes())).collect())
        }
    };
    let manifest = Manifest {
        plan: graph.main().name.clone(),
        file: files.first().map(|file| file.path.clone()).unwrap_or_default(),
        kind,
        model: model_of(&file.own.project).to_owned(),
        robot: arguments.robot.clone(),
        set: arguments.set.clone(),
        calibration: file.own.project.calibration.as_ref().map(|it| sha256(it.as_bytes())),
        trace: trace(arguments)?,
        files,
    };
    let invalid = |why| RunError::usage(format!("this plan cannot be deployed: {why}"), "");
    manifest.check().map_err(invalid)?;
    let mut remote = Remote::connect(&arguments.to)?;
    let ours = Build::this().to_string();
    let content = |sha256: &str| contents.get(sha256).map(Vec::as_slice);
    let stop_first = arguments.stop_first;
    let done = remote.ask(|robot| {
        check_version(&robot.hello, &manifest, &ours)?;
        robot.deploy(&manifest, &content, stop_first, &mut tell)
    })?;
    let code = ran(done)?;
    say(format_args!("the robot is disarmed: 'afpc robot arm {}' lets it drive", arguments.to));
    Ok(code)
}

/// Refuses a plan whose robot or toolboxes are Rust, which `afpc` on the robot does not have.
fn needs_no_rust(file: &PlanFile, graph: &Graph) -> Result<(), NoPlan> {
    let toolboxes = file.own.used_by(graph)?;
    let robot = file.own.project.project.robot.as_ref().and_then(Robot::rust_type);
    let what = match (toolboxes.first(), robot) {
        (Some(toolbox), _) => format!("the toolbox '{}'", toolbox.name),
        (None, Some(robot)) => format!("the robot '{robot}'"),
        (None, None) => return Ok(()),
    };
    let message = format!("{what} is Rust, which the robot's afpc does not have");
    let help =
        "build a program with 'afpc build --target pi', and deploy it with '--built PROGRAM'";
    Err(RunError::usage(message, help).into())
}

/// The trace of the self-check on this machine.
fn trace(arguments: &Arguments) -> Result<String, RunError> {
    let afpc = std::env::current_exe().map_err(RunError::file("cannot find", "afpc".as_ref()))?;
    let mut command = Command::new(afpc);
    command.args(["run", &arguments.plan.plan]);
    command.args(arguments.set.iter().map(|(name, value)| format!("--set={name}={value}")));
    trace_of(command).map_err(|why| {
        RunError::usage(format!("the plan does not run here: {why}"), "run 'afpc run' for details")
    })
}
