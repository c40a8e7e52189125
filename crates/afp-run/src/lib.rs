//! The common part of `afpc run` and all generated binaries: options, timeline, summary, pictures.
//!
//! [`main()`] is the complete main function of a generated binary; [`run`] drives the session of
//! any plan on any simulated robot. Neither depends on the language or a robot.

mod again;
mod beside;
mod drawn;
mod error;
mod hash;
pub mod inputs;
mod keys;
mod live;
pub mod options;
mod output;
mod pace;
pub mod panics;
mod picture;
mod report;
pub mod requests;
mod run;
mod stderr;
mod stop;
mod version;
mod watchdog;
pub mod world;

use std::process::ExitCode;

use afp_core::rt::{NamedPlan, Plan};
use afp_session::{
    AnyRobot, AnySession, AnyWorld, Hardware, Opened, Robot, Session, Settings, Simulated,
    TextFile, kind,
};
use clap::{Args, Command, FromArgMatches};

use crate::options::{OnRobot, RunOptions};

pub use beside::{Beside, Debugger, Extras};
pub use drawn::{draw_film, draw_log, draw_sonar, is_of_hardware};
pub use error::{EXIT_FAILED, EXIT_OK, EXIT_PLAN_ERROR, EXIT_USAGE, RunError};
pub use hash::hash;
pub use output::{check_apart, check_writable, is_same_file, write_whole};
pub use picture::{PictureFormat, Rasterizer};
pub use report::{event_line, line, timeline};
pub use run::{MakeSession, OpenHardware, hashes, notify, run, run_on_hardware};
pub use stderr::{say, warn};
pub use stop::StopFlag;
pub use version::{build_line, version};

/// A plan and its sources.
#[derive(Clone, Copy, Debug)]
pub struct Program<'a> {
    pub name: &'a str,
    /// The plan's file, as given; the default world is found relative to its folder.
    pub file: &'a str,
    /// Path and text of the plan's file, then of the files that it uses, for the log.
    pub texts: &'a [(&'a str, &'a str)],
    /// Name and text of the project's toolboxes, for the log.
    pub toolboxes: &'a [(&'a str, &'a str)],
    /// The text of the project file, for the log; empty without a project.
    pub project: &'a str,
    /// The hardware settings of the project: name and value.
    pub hardware: &'a [(&'a str, &'a str)],
}

impl Program<'_> {
    /// The texts of the plan, and the texts of toolboxes by name.
    pub(crate) fn text_files(&self) -> (Vec<TextFile>, Vec<TextFile>) {
        let files = |texts: &[(&str, &str)]| {
            let file = |(name, text): &(&str, &str)| TextFile {
                name: (*name).to_owned(),
                text: (*text).to_owned(),
            };
            texts.iter().map(file).collect()
        };
        (files(self.texts), files(self.toolboxes))
    }
}

/// The main function of a generated binary: reads the command line, runs the plan, reports the
/// result.
pub fn main<R, P>(program: Program<'static>, new: impl FnOnce() -> P) -> ExitCode
where
    R: Simulated,
    P: NamedPlan + Plan<R> + 'static,
    Session<P, R>: AnySession,
{
    let options = match options_of(&program, &kind::<R>(), "simulated") {
        Ok(options) => options,
        Err(error) => error.exit(),
    };
    finish(simulate::<R, P>(&program, new, &options))
}

/// As [`main()`], with the real robot linked in: `--robot hardware` runs the plan on it.
pub fn main_with<R, H, P>(program: Program<'static>, new: impl Fn() -> P) -> ExitCode
where
    R: Simulated,
    H: Hardware + Robot<Devices = R::Devices>,
    P: NamedPlan + Plan<R> + Plan<H> + 'static,
    Session<P, R>: AnySession,
    Session<P, H>: AnySession,
{
    let options = match options_of(&program, &kind::<R>(), "simulated, hardware") {
        Ok(options) => options,
        Err(error) => error.exit(),
    };
    finish(match options.robot {
        OnRobot::Sim => simulate::<R, P>(&program, new, &options),
        OnRobot::Hardware => {
            let open = |settings: &Settings| Opened::new::<P, H>(new(), settings);
            run_on_hardware(&program, Box::new(open), &options, Extras::default())
        }
    })
}

fn simulate<R, P>(
    program: &Program<'_>,
    new: impl FnOnce() -> P,
    options: &RunOptions,
) -> Result<u8, RunError>
where
    R: Simulated,
    P: NamedPlan + Plan<R> + 'static,
    Session<P, R>: AnySession,
{
    let make = |world: &dyn AnyWorld, seed: u64, measures: &[&str]| {
        let session = Session::<P, R>::in_world(new(), world, seed, measures)?;
        Ok(Box::new(session) as Box<dyn AnySession>)
    };
    run(program, &kind::<R>(), Box::new(make), options, Extras::default())
}

/// Parses the command line of a generated binary. `robots` names the linked kinds of robots.
fn options_of(
    program: &Program<'static>,
    robot: &dyn AnyRobot,
    robots: &str,
) -> Result<RunOptions, clap::Error> {
    let about = format!("Runs the plan {}.", program.name);
    // The help must be that of the program and not of the struct of options.
    let command = RunOptions::augment_args(Command::new(program.name)).about(about);
    let command = command.long_about(None).after_help(EXAMPLES);
    let command = command.version(&*version(program, robots).leak());
    let command = options::for_robot(command, robot);
    RunOptions::from_arg_matches(&command.get_matches())
}

pub fn finish(result: Result<u8, RunError>) -> ExitCode {
    match result {
        Ok(code) => ExitCode::from(code),
        Err(error) => error.report(),
    }
}

/// The end of the help.
pub const EXAMPLES: &str = "\
Examples:
  --seed 7                        different noise
  --set distance=35cm             another value for an 'in' entry
  --until 2min --json             two minutes; lines for machines
  --speed 1x                      in real time; the Escape key stops the robot
  --again run.mcap                the run of a log once more, with the same trace

Exit codes: 0 done, 1 a file cannot be read or written or a run does not repeat, 2 wrong options, 3 the plan ended in
Error, 143 stopped by SIGTERM";
