//! `afpc calibrate`: measures the robot of a project with its user, step by step.
//!
//! Each finished step is kept in a file, so that the next call continues. The last step writes
//! `calibration.toml`.

mod steps;
mod written;

use std::path::{Path, PathBuf};

use afp_pi::{Calibrated, calibrated};
use afp_project::{CALIBRATION, ProfileRobot, ProjectFile, Realtime};
use afp_run::{EXIT_OK, RunError, StopFlag, hash, say, warn, write_whole};
use afp_session::Settings;
use clap::Args;

use super::print;
use crate::no_plan::NoPlan;
use steps::{Steps, User};
use written::Part;

/// Arguments of `afpc calibrate`.
#[derive(Args, Debug)]
pub struct Arguments {
    /// Serial port of the controller [default: `port` in afp.toml]
    #[arg(long)]
    port: Option<String>,
    /// Measure everything again
    #[arg(long)]
    again: bool,
}

pub const EXAMPLES: &str = "\
Examples:
  afpc calibrate                     the robot of the project in this folder
  afpc calibrate --port /dev/ttyACM1

You need a tape measure, and 3 m of free floor. A robot whose service runs is busy: stop it with
'sudo systemctl stop afp'.";

/// The finished steps of a calibration that is not complete.
const PART: &str = "calibration.part.json";
/// The time in which the toolbox expects a robot to stop: 'stop 300 ms' in carbot.afp.
const STOP: f64 = 0.3;

/// Calibrates a robot.
///
/// # Errors
/// The project has no robot with a profile, the robot cannot be reached, a step is not finished.
pub fn run(arguments: &Arguments) -> Result<u8, NoPlan> {
    let project = ProjectFile::find(Path::new("."))?;
    let robot = uncalibrated(&project)?;
    let files = Files { folder: project.folder.clone() };
    let mut part = match arguments.again {
        true => Part::new(robot.name, hash(&project.text)),
        false => files.part(robot.name, &hash(&project.text))?,
    };
    let stop =
        StopFlag::on_signals().map_err(RunError::file("cannot handle", "signals".as_ref()))?;
    let mut opened = open(&robot, arguments)?;
    let goes = || !stop.is_raised();
    let mut steps = Steps { robot: &mut *opened, user: User, goes: &goes };
    let has_sonar = robot.number("ultrasonic.forward").is_some();
    while steps.next(&mut part, has_sonar)? {
        files.keep(&part)?;
    }
    drop(opened);
    finish(&robot, &part, &files)
}

/// Writes the calibration and reports it.
fn finish(robot: &ProfileRobot, part: &Part, files: &Files) -> Result<u8, NoPlan> {
    let Some(text) = written::calibration(robot, part) else {
        files.forget();
        let help = "measure again; lengths need a unit, such as '201.5 cm'";
        return Err(RunError::usage("the measured numbers are not those of a robot", help).into());
    };
    let path = files.folder.join(CALIBRATION);
    write_whole("cannot write the calibration", &path, &text)?;
    files.forget();
    let stop = part.stop.unwrap_or_default();
    if stop > STOP {
        warn(&format!(
            "the robot needs {:.0} ms to stop, and the toolbox expects {:.0} ms: lower \
             'drive.fastest' or 'drive.ramp'",
            stop * 1000.0,
            STOP * 1000.0
        ));
    }
    print(&text)?;
    say("'afpc robot setup HOST' copies it to a robot");
    Ok(EXIT_OK)
}

/// The robot as afp.toml describes it, without an earlier calibration.
fn uncalibrated(project: &ProjectFile) -> Result<ProfileRobot, RunError> {
    let (project, _) = afp_project::read(&project.text);
    project.profile().cloned().ok_or_else(|| {
        let help = "'afpc new mycar --profile carbot' creates such a project";
        RunError::usage("the project in this folder has no robot with a profile", help)
    })
}

fn open(robot: &ProfileRobot, arguments: &Arguments) -> Result<Box<dyn Calibrated>, RunError> {
    let values = robot.values.iter().map(|(name, value)| (&**name, &**value));
    let values = values.filter(|(name, _)| !name.starts_with(Realtime::PREFIX));
    let port = arguments.port.as_deref().map(|port| ("port", port));
    let settings = Settings::new(values.chain(port));
    let name = robot.name;
    let opened = calibrated(name, &settings)
        .ok_or_else(|| RunError::usage(format!("a '{name}' is not calibrated"), "see the book"))?;
    opened.map_err(|why| {
        RunError::usage(why.to_string(), "switch the robot on, and name its port with '--port'")
    })
}

/// The files of a calibration.
struct Files {
    folder: PathBuf,
}

impl Files {
    /// The finished steps of the same robot.
    fn part(&self, robot: &str, project: &str) -> Result<Part, RunError> {
        let path = self.folder.join(PART);
        let new = Part::new(robot, project.to_owned());
        let Ok(text) = std::fs::read_to_string(&path) else { return Ok(new) };
        let known: Part = serde_json::from_str(&text).map_err(|why| {
            let message = format!("cannot read '{}': {why}", path.display());
            RunError::usage(message, "'afpc calibrate --again' measures everything again")
        })?;
        if !known.is_of(&new) {
            say("afp.toml has changed: everything is measured again");
            return Ok(new);
        }
        say("this continues the last call; '--again' measures everything again");
        Ok(known)
    }

    fn keep(&self, part: &Part) -> Result<(), RunError> {
        let text = serde_json::to_string_pretty(part).unwrap_or_default();
        write_whole("cannot write the finished steps", &self.folder.join(PART), &text)
    }

    /// Removes the finished steps.
    fn forget(&self) {
        std::fs::remove_file(self.folder.join(PART)).ok();
    }
}
