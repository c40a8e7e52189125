//! `afpc log`: the events of a run, and the state of its log.

mod budgets;
mod info;
mod pictures;
mod timeline;

use std::path::PathBuf;

use afp_log::{doctor, read, read_any, recover, recovered_name};
use afp_run::{EXIT_FAILED, EXIT_OK, RunError, is_same_file, say};
use clap::{Args, ValueEnum};

use super::print;
use crate::Linked;
use crate::no_plan::NoPlan;
use budgets::Measured;

/// Arguments of `afpc log`.
#[derive(Args, Debug)]
pub struct Arguments {
    /// The log
    file: PathBuf,

    /// Action
    #[arg(default_value = "timeline")]
    action: Action,

    /// Also draw the path over the world into this SVG or PNG file
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,

    /// Also draw the range sensor's echoes over the walls into this file
    #[arg(long, value_name = "FILE")]
    sonar: Option<PathBuf>,

    /// Also draw the camera's pictures into this file; for runs with '--camera'
    #[arg(long, value_name = "FILE")]
    film: Option<PathBuf>,

    /// Also draw the plan with the run's coverage into this file
    #[arg(long, value_name = "FILE")]
    coverage: Option<PathBuf>,

    /// Also draw the times of a real robot's control loop into this file
    #[arg(long, value_name = "FILE")]
    times: Option<PathBuf>,

    /// Compare the times of a real robot with the declared budgets
    #[arg(long)]
    budgets: bool,

    /// File for 'recover' [default: <log>.recovered.mcap]
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
}

/// The actions for a log.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Action {
    /// Print the events, then deadlines, interruptions and coverage
    Timeline,
    /// Print the contents of the file
    Info,
    /// Save the intact data into a new file
    Recover,
    /// List the errors in the file
    Doctor,
}

pub const EXAMPLES: &str = "\
Examples:
  afpc log target/afp/runs/wall_following.mcap
  afpc log run.mcap info
  afpc log run.mcap --svg path.svg
  afpc log run.mcap --sonar map.svg --film film.png --coverage cover.png
  afpc log drive.mcap --budgets --times times.svg
  afpc log run.mcap.part recover

Exit codes: 0 done or intact, 1 the file cannot be read or is damaged, 2 wrong usage";

/// The message for an action before the log's name.
pub fn swapped(first: &str, second: &str) -> Option<RunError> {
    let action = Action::from_str(first, false).ok()?.to_possible_value()?;
    let (action, help) = (action.get_name(), format!("write 'afpc log {second} {first}'"));
    Some(RunError::usage(format!("'{action}' must follow the log's name"), help))
}

/// Does the selected action.
///
/// # Errors
/// A file cannot be read or written.
pub fn run(arguments: &Arguments, linked: &Linked<'_>) -> Result<u8, NoPlan> {
    if arguments.output.is_some() && arguments.action != Action::Recover {
        let help =
            "'--svg', '--sonar', '--film', '--coverage' and '--times' name the files of pictures";
        return Err(RunError::usage("'-o' is only for 'recover'", help).into());
    }
    if arguments.budgets && arguments.action != Action::Timeline {
        let help = "call 'afpc log' once for each";
        return Err(RunError::usage("'--budgets' is only for events", help).into());
    }
    pictures::draw(arguments, linked)?;
    match arguments.action {
        Action::Timeline if arguments.budgets => {
            let log = read(&arguments.file).map_err(RunError::from)?;
            print(&Measured::of(&log, &arguments.file)?.text())
        }
        Action::Timeline => {
            let log = read(&arguments.file).map_err(RunError::from)?;
            if let Some(cut) = &log.cut_short {
                let name = arguments.file.display();
                say(format_args!("warning: '{name}' is incomplete: {cut}"));
            }
            print(&timeline::text(&log))
        }
        Action::Info => {
            let log = read_any(&arguments.file).map_err(RunError::from)?;
            print(&info::text(&arguments.file, &log))
        }
        Action::Recover => save(arguments),
        Action::Doctor => {
            let found = doctor(&arguments.file).map_err(RunError::from)?;
            let text: String = found.iter().map(|what| format!("{what}\n")).collect();
            print(if text.is_empty() { "sound\n" } else { &text })?;
            Ok(if found.is_empty() { EXIT_OK } else { EXIT_FAILED })
        }
    }
}

fn save(arguments: &Arguments) -> Result<u8, NoPlan> {
    let to = arguments.output.clone().unwrap_or_else(|| recovered_name(&arguments.file));
    if is_same_file(&to, &arguments.file) {
        let help = "give another name with '-o FILE'";
        return Err(RunError::usage("a log cannot be recovered into itself", help).into());
    }
    let saved = recover(&arguments.file, &to).map_err(RunError::from)?;
    match &saved.damage {
        Some(damage) => say(format_args!("the log is incomplete: {damage}")),
        None => say("the log has no errors"),
    }
    for missing in &saved.missing {
        say(format_args!("missing: {missing}"));
    }
    print(&format!("{} messages saved\n{}\n", saved.messages, saved.path.display()))
}
