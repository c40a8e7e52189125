//! `afpc robot`: the state, the releases and the logs of a robot.

pub mod connect;
pub mod setup;
mod wiring;

use std::fs::{self, OpenOptions};
use std::path::{Path, PathBuf};

use afp_deploy::client::{Progress, Ran};
use afp_deploy::wire::{State, Status, Step};
use afp_run::{EXIT_FAILED, EXIT_OK, RunError, say};
use clap::{Args, Subcommand};

use super::print;
use crate::no_plan::NoPlan;
use connect::Remote;

/// Arguments of `afpc robot`.
#[derive(Args, Debug)]
pub struct Arguments {
    #[command(subcommand)]
    verb: Verb,
}

#[derive(Subcommand, Debug)]
enum Verb {
    /// Show the wires of the project's robot
    Wiring(wiring::Arguments),
    /// Prepare a robot's computer, or upgrade it
    Setup(setup::Arguments),
    /// Show the state of the robot and its releases
    Status(Host),
    /// Let the plan drive
    Arm(Host),
    /// Stop the plan; it waits to be armed again
    Stop(Host),
    /// Go back to the release that ran before
    Rollback {
        #[command(flatten)]
        host: Host,
        /// Stop a robot that is armed
        #[arg(long)]
        stop_first: bool,
    },
    /// List the robot's logs, or fetch one
    Logs {
        #[command(flatten)]
        host: Host,
        /// Log to fetch; a part of an earlier call is continued
        name: Option<String>,
        /// File for the log [default: its name]
        #[arg(short, long, value_name = "FILE", requires = "name")]
        output: Option<PathBuf>,
    },
}

#[derive(Args, Debug)]
struct Host {
    /// Host of ssh, or 'exec:COMMAND' for an agent on this machine
    host: String,
}

pub const EXAMPLES: &str = "\
Examples:
  afpc robot wiring -o wiring.svg
  afpc robot setup pi@robot.local
  afpc robot status afp@robot.local
  afpc robot arm afp@robot.local
  afpc robot stop afp@robot.local
  afpc robot rollback afp@robot.local
  afpc robot logs afp@robot.local Patrol-1-1.mcap";

/// Asks the robot's agent, or shows the robot's wires.
///
/// # Errors
/// The project has no such robot, or the robot cannot be reached or refuses the request.
pub fn run(arguments: &Arguments) -> Result<u8, NoPlan> {
    match &arguments.verb {
        Verb::Wiring(arguments) => wiring::run(arguments),
        Verb::Setup(arguments) => setup::run(arguments),
        Verb::Status(host) => {
            let status = Remote::connect(&host.host)?.ask(|robot| robot.status())?;
            print(&shown(&status))
        }
        Verb::Arm(host) => arm(host, true),
        Verb::Stop(host) => arm(host, false),
        Verb::Rollback { host, stop_first } => {
            let mut remote = Remote::connect(&host.host)?;
            ran(remote.ask(|robot| robot.rollback(*stop_first, &mut tell))?)
        }
        Verb::Logs { host, name: None, .. } => {
            let logs = Remote::connect(&host.host)?.ask(|robot| robot.logs())?;
            let lines = logs.iter().map(|(name, size)| format!("{size:>10}  {name}\n"));
            print(&lines.collect::<String>())
        }
        Verb::Logs { host, name: Some(name), output } => {
            fetch(&host.host, name, output.as_deref().unwrap_or(Path::new(name)))
        }
    }
}

fn arm(host: &Host, arm: bool) -> Result<u8, NoPlan> {
    Remote::connect(&host.host)?.ask(|robot| robot.arm(arm))?;
    Ok(EXIT_OK)
}

/// Prints the progress of a deploy.
pub(super) fn tell(progress: Progress) {
    let text = match progress {
        Progress::Differs { files, bytes } => format!("files to send: {files}, with {bytes} bytes"),
        Progress::Step(Step::Check) => "checking the plan on the robot".to_owned(),
        Progress::Step(Step::Switch) => "switching to the release".to_owned(),
        Progress::Step(Step::Start) => "starting the release".to_owned(),
    };
    say(text);
}

/// Prints the release that runs, and returns the exit code.
pub(super) fn ran(ran: Ran) -> Result<u8, NoPlan> {
    let Ran { release, plan, instead } = ran;
    print(&format!("ready: {plan} {release}\n"))?;
    match instead {
        None => Ok(EXIT_OK),
        Some(why) => {
            let help = "the previous release runs; fix the plan and deploy it again";
            say(RunError::usage(why, help).styled());
            Ok(EXIT_FAILED)
        }
    }
}

/// The state of a robot, with a line for each release.
fn shown(status: &Status) -> String {
    let state = match status.state {
        State::Stopped => "stopped",
        State::Disarmed => "disarmed",
        State::Armed => "armed",
    };
    let mut text = match &status.running {
        Some(running) => format!("{state}: {} {}\n", running.plan, running.release),
        None => format!("{state}\n"),
    };
    if let Some(trouble) = &status.trouble {
        text.push_str(&format!("trouble: {trouble}\n"));
    }
    for named in &status.releases {
        let is_current = status.current.as_ref() == Some(named);
        let mark = if is_current { '*' } else { ' ' };
        text.push_str(&format!("{mark} {}  {}\n", named.release, named.plan));
    }
    text
}

/// Fetches a log; the bytes of an earlier call are not sent again.
fn fetch(host: &str, name: &str, path: &Path) -> Result<u8, NoPlan> {
    let part = afp_output::part_of(path);
    let from = fs::metadata(&part).map_or(0, |part| part.len());
    let cannot = |why| RunError::file("cannot write the log", path)(why);
    let mut file = OpenOptions::new().create(true).append(true).open(&part).map_err(cannot)?;
    Remote::connect(host)?.ask(|robot| robot.log(name, from, &mut file))?;
    file.sync_all().map_err(cannot)?;
    fs::rename(&part, path).map_err(cannot)?;
    print(&format!("{}\n", path.display()))
}
