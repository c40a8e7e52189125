//! `afpc dap`: the debug adapter on standard input and output, or on a port.

#[cfg(unix)]
mod beside;
#[cfg(unix)]
mod elsewhere;
mod incoming;
#[cfg(unix)]
mod link;
mod listen;
mod senses;
mod simulator;
#[cfg(unix)]
mod sockets;
mod talk;

use std::path::{Path, PathBuf};

use afp_debug::Adapter;
use afp_run::{EXIT_OK, RunError};
use clap::Args;

use super::later::Listen;
use crate::no_plan::NoPlan;
use crate::plan_file::PlanFile;
use crate::{Linked, runner};

#[cfg(unix)]
pub use beside::Socket;
#[cfg(all(feature = "studio", unix))]
pub use elsewhere::Elsewhere;
#[cfg(unix)]
pub use incoming::Incoming;
#[cfg(feature = "studio")]
pub use incoming::{Arrived, wait};
#[cfg(unix)]
pub use link::{Begun, Link, Tell};
pub use simulator::Simulator;
#[cfg(unix)]
pub use sockets::{connect, connect_to_only};
#[cfg(feature = "studio")]
pub use talk::converse;
use talk::serve;

/// Arguments of `afpc dap`.
#[derive(Args, Debug)]
pub struct Arguments {
    /// Plan to debug; builds the robot and toolboxes of its project first
    #[arg(value_name = "FILE[:PLAN]")]
    plan: Option<String>,
    /// Listen on this local port instead of standard input; 0 selects a free port
    #[arg(long, value_name = "PORT", allow_hyphen_values = true)]
    port: Option<u16>,
    /// Run plans and show logs only from this folder
    #[arg(long, value_name = "FOLDER", conflicts_with = "port")]
    inside: Option<PathBuf>,
    #[command(flatten)]
    listen: Listen,
}

/// The examples at the end of the help.
pub const EXAMPLES: &str = "\
Examples:
  afpc dap                         for editors, on standard input and output
  afpc dap --port 4711             waits for editors; 'launch' and 'attach' need the printed token

'launch' takes: program, world, seed, set (values by name), until (seconds), speed (a factor), stopOnEntry; or
log, the log of a finished run";

/// Serves clients and returns the exit code.
///
/// # Errors
/// The plan is invalid, the port is taken, the input does not follow the protocol.
pub fn run(arguments: &Arguments, linked: &Linked<'_>) -> Result<u8, NoPlan> {
    arguments.listen.check()?;
    if let Some(plan) = &arguments.plan {
        let file = PlanFile::read(plan)?;
        runner::become_one_for(file.compiled.graph.iter().map(|graph| (&file.own, graph)), linked)?;
    }
    match arguments.port {
        None => {
            let simulator = match &arguments.inside {
                Some(folder) => Simulator::inside(linked, &opened(folder)?),
                None => Simulator::new(linked),
            };
            let adapter = Adapter::new(Box::new(simulator));
            let served = serve(adapter, std::io::stdin(), std::io::stdout());
            let failed =
                RunError::file("cannot talk to the editor over", "standard input".as_ref());
            served.map_err(|why| failed(std::io::Error::other(why)))?;
        }
        Some(port) => listen::listen(port, linked)?,
    }
    Ok(EXIT_OK)
}

/// The canonical absolute path of a folder.
fn opened(folder: &Path) -> Result<PathBuf, RunError> {
    let path = folder.canonicalize().map_err(RunError::file("cannot open the folder", folder))?;
    match path.is_dir() {
        true => Ok(path),
        false => Err(RunError::usage(
            format!("'{}' is not a folder", folder.display()),
            "name the folder with the plans",
        )),
    }
}
