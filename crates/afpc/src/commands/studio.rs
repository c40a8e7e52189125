//! `afpc studio`: draws and edits plans in the browser.

mod debug;

use std::env;
use std::path::{Path, PathBuf};
use std::sync::mpsc::channel;
use std::thread;

use afp_run::{EXIT_OK, RunError, say};
use afp_studio::{Example, Opened, Options, Studio};
use clap::Args;

use super::disk::Disk;
use super::later::Listen;
use super::print;
use crate::Linked;
use crate::no_plan::NoPlan;
use debug::DebugService;

/// Arguments of `afpc studio`.
#[derive(Args, Debug)]
pub struct Arguments {
    /// Plan or folder of plans; the studio writes only in this folder
    #[arg(value_name = "FILE|FOLDER", default_value = ".")]
    path: PathBuf,
    /// Local port; 0 selects a free port
    #[arg(long, default_value_t = 0, allow_hyphen_values = true)]
    port: u16,
    /// Print the address without opening the browser
    #[arg(long)]
    no_open: bool,
    /// Allow another page to connect, for example through a tunnel
    #[arg(long, value_name = "ORIGIN")]
    allow_origin: Vec<String>,
    #[command(flatten)]
    listen: Listen,
}

/// The examples at the end of the help.
pub const EXAMPLES: &str = "\
Examples:
  afpc studio                      opens the plans of this folder, which may be empty
  afpc studio plans/patrol.afp     opens that plan
  afpc studio --port 4712 --no-open

The studio only listens on this machine. Its address has a secret that works once.";

/// A file with plans that AFP ships: its name and its text.
macro_rules! shipped {
    ($name:literal) => {
        (concat!($name, ".afp"), include_str!(concat!("../../../../plans/", $name, ".afp")))
    };
}

/// A shipped plan with its world and all files that it uses, directly or indirectly.
macro_rules! example {
    ($name:literal $(, $uses:literal)*) => {
        (
            shipped!($name),
            include_str!(concat!("../../../../worlds/", $name, ".toml")),
            &[$(shipped!($uses)),*],
        )
    };
}

/// Name and text of a file.
type File = (&'static str, &'static str);

/// The example plans.
const EXAMPLES_TO_COPY: [(File, &str, &[File]); 7] = [
    example!("wall_following"),
    example!("patterns"),
    example!("find_infrared", "parts/explore", "parts/go_to", "parts/boundary", "avoid_obstacle"),
    example!("avoid_obstacle", "parts/boundary"),
    example!("find_object", "parts/explore", "parts/go_to", "parts/boundary", "avoid_obstacle"),
    example!("navigate_room", "parts/go_to"),
    example!("patrol", "avoid_obstacle", "navigate_room", "parts/boundary", "parts/go_to"),
];

/// The examples in the studio's form.
fn examples() -> Vec<Example> {
    let made = EXAMPLES_TO_COPY.into_iter().map(|((name, plan), world, uses)| Example {
        name: name.to_owned(),
        plan: plan.to_owned(),
        // The schema exists only in the checkout.
        world: Some(world.lines().filter(|line| !line.starts_with("#:")).map(with_end).collect()),
        uses: uses.iter().map(|&(path, text)| (path.to_owned(), text.to_owned())).collect(),
    });
    made.collect()
}

fn with_end(line: &str) -> String {
    format!("{line}\n")
}

/// Serves until Ctrl-C and returns the exit code.
///
/// # Errors
/// The file or folder does not exist, the port is taken.
pub fn run(arguments: &Arguments, linked: &Linked<'_>) -> Result<u8, NoPlan> {
    arguments.listen.check()?;
    let (folder, open) = folder(&arguments.path)?;
    let options = Options {
        folder,
        open,
        port: arguments.port,
        program: env::current_exe()
            .map_err(RunError::file("cannot find", "this program".as_ref()))?,
        origins: arguments.allow_origin.clone(),
        examples: examples(),
        own: afp_studio::own_folder(),
    };
    let failed = |port: u16| format!("127.0.0.1:{port}");
    let name = failed(arguments.port);
    let opened = Studio::open(&options, || Box::new(Disk));
    let studio = match opened.map_err(RunError::file("cannot listen on", name.as_ref()))? {
        Opened::Here(studio) => studio,
        Opened::Elsewhere(address) => {
            say("a studio already serves this folder; it opens its page again\n");
            show(&address, arguments.no_open)?;
            return Ok(EXIT_OK);
        }
    };
    show(&studio.address(), arguments.no_open)?;
    say("Ctrl-C ends the studio\n");
    let (folder, trusted) = (studio.folder(), studio.trusted());
    let debugging = DebugService { linked, folder: &folder, trusted };
    let served = thread::scope(|scope| {
        let (debuggers, arrived) = channel();
        scope.spawn(|| {
            for client in arrived {
                scope.spawn(|| debugging.serve(client));
            }
        });
        studio.serve(debuggers)
    });
    served.map_err(RunError::file("cannot serve on", name.as_ref()))?;
    Ok(EXIT_OK)
}

/// Prints an address, and opens it in the browser unless `no_open` is set.
fn show(address: &str, no_open: bool) -> Result<(), NoPlan> {
    print(&format!("{address}\n"))?;
    if no_open {
        say("open this address in a browser within a minute\n");
    } else if open::that_detached(address).is_err() {
        say("no browser could be started: open this address within a minute\n");
    } else {
        say("the studio opens in your browser\n");
    }
    Ok(())
}

/// The folder of the given path, or the folder of its project, and the file in it.
fn folder(path: &Path) -> Result<(PathBuf, Option<PathBuf>), RunError> {
    let real = path.canonicalize().map_err(RunError::file("cannot open", path))?;
    if real.is_dir() {
        return Ok((real, None));
    }
    let project = real.ancestors().skip(1).find(|folder| folder.join("afp.toml").is_file());
    let folder = project.or(real.parent()).unwrap_or(&real).to_owned();
    Ok((folder, Some(real)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_example_is_a_valid_plan_with_its_world() {
        for example in examples() {
            let place = tempfile::tempdir().unwrap();
            let plans = place.path().join("plans");
            std::fs::create_dir_all(plans.join("parts")).unwrap();
            let Example { name, plan, world, uses } = example;
            for (path, text) in uses.iter().chain([&(name.clone(), plan)]) {
                std::fs::write(plans.join(path), text).unwrap();
            }
            let file = crate::plan_file::PlanFile::read(plans.join(&name).to_str().unwrap());
            assert!(file.unwrap().compiled.graph.is_some(), "{name}");
            let world = world.unwrap();
            assert!(world.contains("version = ") && !world.contains("#:schema"), "{name}");
        }
    }
}
