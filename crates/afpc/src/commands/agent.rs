//! `afpc agent`: the robot's side of `afpc deploy`, and the service that runs releases.

mod control;
mod host;
mod program;
mod service;

use std::io;
use std::path::PathBuf;

use afp_deploy::agent::Agent;
use afp_deploy::disk::ThisDisk;
use afp_deploy::store::Store;
use afp_project::ProjectFile;
use afp_run::{EXIT_OK, RunError};
use clap::Args;

use super::print;
use crate::no_plan::NoPlan;
use host::Robot;

pub(super) use host::model_of;
pub(super) use program::trace_of;

/// Arguments of `afpc agent`.
#[derive(Args, Debug)]
pub struct Arguments {
    /// Folder of the releases, with the robot's afp.toml
    #[arg(long, value_name = "DIR", default_value = "/var/lib/afp")]
    root: PathBuf,
    /// Run the current release, and restart it when it ends
    #[arg(long)]
    serve: bool,
    /// Only stop the robot, as systemd does after the service has ended
    #[arg(long, conflicts_with = "serve")]
    stop: bool,
    /// Print the unit that runs the service under systemd
    #[arg(long, conflicts_with = "serve")]
    unit: bool,
}

pub const EXAMPLES: &str = "\
Examples:
  ssh robot.local afpc agent       run the command that 'afpc deploy' starts
  afpc agent --unit                print the unit for systemd
  afpc agent --serve               run the robot's service in the foreground";

/// Serves one connection on standard input and output, or runs releases.
///
/// # Errors
/// The folder cannot be written, or the other side does not follow the protocol.
pub fn run(arguments: &Arguments) -> Result<u8, NoPlan> {
    if arguments.unit {
        return print(UNIT);
    }
    let root = &arguments.root;
    let store = Store::open(root, &ThisDisk).map_err(|why| {
        RunError::usage(format!("cannot use the folder of releases: {why}"), FOLDER)
    })?;
    if arguments.stop {
        let Some(current) = store.current() else { return Ok(EXIT_OK) };
        let stopped = store.manifest(&current.release).map_err(|why| why.to_string());
        let files = store.files(&current.release);
        let afpc = program::afpc()?;
        let stopped = stopped.and_then(|manifest| program::stop_robot(&afpc, &files, &manifest));
        let help = "switch the robot off: nothing has confirmed that it has stopped";
        stopped.map_err(|why| RunError::usage(why, help))?;
        return Ok(EXIT_OK);
    }
    if arguments.serve {
        let project = ProjectFile::find(root)?;
        service::serve(&store, project.project.robot.as_ref())?;
        return Ok(EXIT_OK);
    }
    let mut robot = Robot::new(root)?;
    let served = Agent::new(store, &mut robot).serve(&mut io::stdin().lock(), &mut io::stdout());
    let failed = RunError::file("cannot talk over", "standard input".as_ref());
    served.map_err(|why| failed(io::Error::other(why)))?;
    Ok(EXIT_OK)
}

/// The service of systemd, with the default folder.
const UNIT: &str = include_str!("agent/afp.service");

const FOLDER: &str = "'--root DIR' names another folder, which this user can write";
