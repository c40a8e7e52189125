//! `afpc attach`: joins standard input and output to the debug adapter of a run.

use std::io::{self, Write};
use std::os::unix::net::UnixStream;
use std::path::Path;
use std::sync::Arc;
use std::thread;

use afp_output::frames::frame;
use afp_run::{EXIT_OK, RunError};
use clap::Args;

use super::dap::{Begun, Incoming, Link, Tell, connect, connect_to_only};
use super::stream::read;
use crate::no_plan::NoPlan;

/// Arguments of `afpc attach`.
#[derive(Args, Debug)]
pub struct Arguments {
    /// Host of ssh, or socket of a run on this machine [default: the only run of this machine]
    #[arg(value_name = "HOST|SOCKET")]
    at: Option<String>,
}

/// The examples at the end of the help.
pub const EXAMPLES: &str = "\
Examples:
  afpc attach robot.local              as a debug adapter of an editor: attaches to the robot's run
  afpc attach /run/afp/Patrol-7.sock   attaches to a run of this machine

The socket of a run is in the folder of its service (RUNTIME_DIRECTORY), else in XDG_RUNTIME_DIR/afp, else in
/tmp/afp-UID. Its user and group may attach.";

/// Talks until one side ends.
///
/// # Errors
/// There is no run to attach to.
pub fn run(arguments: &Arguments) -> Result<u8, NoPlan> {
    match arguments.at.as_deref() {
        None => join(connect_to_only()?),
        Some(path) if path.contains('/') && !path.starts_with("exec:") => {
            join(connect(Path::new(path))?)
        }
        Some(host) => {
            let mut incoming = Incoming::new(io::stdin());
            let tell: Tell = Arc::new(|message| {
                let mut out = io::stdout().lock();
                out.write_all(&frame(message)).and_then(|()| out.flush()).is_ok()
            });
            let relayed = Link::to(host)?.relay(Begun::default(), |due| incoming.next(due), &tell);
            let failed = RunError::file("cannot talk over", "standard input".as_ref());
            if let Some(why) = relayed.map_err(|why| failed(io::Error::other(why)))? {
                return Err(why.into());
            }
        }
    }
    Ok(EXIT_OK)
}

/// Joins standard input and output to a socket.
fn join(stream: UnixStream) {
    if let Ok(mut to) = stream.try_clone() {
        thread::spawn(move || {
            read(io::stdin(), |bytes| to.write_all(&bytes).is_ok());
            let _ = to.shutdown(std::net::Shutdown::Write);
        });
    }
    let mut out = io::stdout();
    read(stream, |bytes| out.write_all(&bytes).and_then(|()| out.flush()).is_ok());
}
