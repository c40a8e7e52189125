//! `afpc studio`: plans drawn and edited in the browser.

use std::env;
use std::path::{Path, PathBuf};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread;
use std::time::Duration;

use afp_debug::Adapter;
use afp_run::{EXIT_OK, RunError, say};
use afp_studio::{Debugging, Options, Studio};
use clap::Args;

use super::dap::{Arrived, Simulator, converse};
use super::disk::Disk;
use super::print;
use crate::Linked;
use crate::plan_file::NoPlan;

/// Arguments of `afpc studio`.
#[derive(Args, Debug)]
pub struct Arguments {
    /// A plan, or a folder of plans: nothing outside of its folder is written
    #[arg(value_name = "FILE|FOLDER", default_value = ".")]
    path: PathBuf,
    /// Port on this machine; 0 is a free one
    #[arg(long, default_value_t = 0)]
    port: u16,
    /// Prints the address and leaves it to you to open it
    #[arg(long)]
    no_open: bool,
    /// A page beside the studio's own that may talk with it: the near end of a tunnel
    #[arg(long, value_name = "ORIGIN")]
    allow_origin: Vec<String>,
}

/// What the help ends with.
pub const EXAMPLES: &str = "\
Examples:
  afpc studio                      the plans of this folder; an empty one is a good beginning
  afpc studio plans/patrol.afp     opens that plan
  afpc studio --port 4712 --no-open

It listens on this machine alone, and its address works once: whoever does not know it is not let in.";

/// Plans to begin with: the shipped ones.
const PLANS: [(&str, &str); 7] = [
    ("wall_following.afp", include_str!("../../../../plans/wall_following.afp")),
    ("patterns.afp", include_str!("../../../../plans/patterns.afp")),
    ("find_infrared.afp", include_str!("../../../../plans/find_infrared.afp")),
    ("avoid_obstacle.afp", include_str!("../../../../plans/avoid_obstacle.afp")),
    ("find_object.afp", include_str!("../../../../plans/find_object.afp")),
    ("navigate_room.afp", include_str!("../../../../plans/navigate_room.afp")),
    ("patrol.afp", include_str!("../../../../plans/patrol.afp")),
];

/// Serves until Ctrl-C; gives the exit code.
///
/// # Errors
/// No such file or folder, the port is taken.
pub fn run(arguments: &Arguments, linked: &Linked<'_>) -> Result<u8, NoPlan> {
    let (folder, open) = folder(&arguments.path)?;
    let options = Options {
        folder,
        open,
        port: arguments.port,
        program: env::current_exe()
            .map_err(RunError::file("cannot find", "this program".as_ref()))?,
        origins: arguments.allow_origin.clone(),
        examples: PLANS.map(|(name, text)| (name.to_owned(), text.to_owned())).into(),
    };
    let failed = |port: u16| format!("127.0.0.1:{port}");
    let name = failed(arguments.port);
    let studio = Studio::new(&options, || Box::new(Disk));
    let studio = studio.map_err(RunError::file("cannot listen on", name.as_ref()))?;
    let address = studio.address();
    print(&format!("{address}\n"))?;
    if arguments.no_open {
        say("open this address in a browser within a minute; Ctrl-C ends the studio\n");
    } else if open::that_detached(&address).is_err() {
        say(
            "no browser could be started: open this address within a minute; Ctrl-C ends the studio\n",
        );
    } else {
        say("the studio opens in your browser; Ctrl-C ends it\n");
    }
    let folder = studio.folder();
    let served = thread::scope(|scope| {
        let (debuggers, arrived) = channel();
        scope.spawn(|| {
            for client in arrived {
                scope.spawn(|| debug(client, Simulator::inside(linked, &folder)));
            }
        });
        studio.serve(debuggers)
    });
    served.map_err(RunError::file("cannot serve on", name.as_ref()))?;
    Ok(EXIT_OK)
}

/// Runs and debugs plans for a client until it is gone.
fn debug(client: Debugging, simulator: Simulator<'_>) {
    let Debugging { said, told } = client;
    let next = |due: Option<Duration>| {
        let message = match due {
            None => said.recv().map_err(|_| RecvTimeoutError::Disconnected),
            Some(due) => said.recv_timeout(due),
        };
        Ok(match message {
            Ok(message) => Arrived::Messages(vec![message]),
            Err(RecvTimeoutError::Timeout) => Arrived::Nothing,
            Err(RecvTimeoutError::Disconnected) => Arrived::End,
        })
    };
    // Who reads too little loses the connection.
    let send = |out: &[String]| out.iter().all(|message| told.try_send(message.clone()).is_ok());
    // It cannot say what is no message: frames are whole.
    let _ = converse(Adapter::new(Box::new(simulator)), next, send);
}

/// The folder of what was named, which is that of its project where there is one, and the file in it.
fn folder(path: &Path) -> Result<(PathBuf, Option<PathBuf>), RunError> {
    let real = path.canonicalize().map_err(RunError::file("cannot open", path))?;
    if real.is_dir() {
        return Ok((real, None));
    }
    let project = real.ancestors().skip(1).find(|folder| folder.join("afp.toml").is_file());
    let folder = project.or(real.parent()).unwrap_or(&real).to_owned();
    Ok((folder, Some(real)))
}
