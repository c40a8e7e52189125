//! The pictures of a log.

use std::path::{Path, PathBuf};

use afp_log::{LogData, read};
use afp_project::ProjectFile;
use afp_run::{RunError, check_apart, is_of_hardware};
use afp_test::Coverage;

use super::Arguments;
use super::budgets::Measured;
use crate::commands::graph;
use crate::no_plan::NoPlan;
use crate::plan_file::{PlanFile, path_of_log};
use crate::{Linked, picture, runner};

/// Draws the requested pictures, each into its file.
///
/// # Errors
/// The log cannot be read or lacks the data for a picture; a file cannot be written.
pub(super) fn draw(arguments: &Arguments, linked: &Linked<'_>) -> Result<(), NoPlan> {
    let Arguments { svg, sonar, film, coverage, times, .. } = arguments;
    let pictures = [svg, sonar, film, coverage, times];
    if pictures.iter().all(|picture| picture.is_none()) {
        return Ok(());
    }
    let all = pictures.into_iter().flatten().map(PathBuf::as_path);
    check_apart(all, [&*arguments.file])?;
    let log = read(&arguments.file).map_err(RunError::from)?;
    if (svg.is_some() || sonar.is_some()) && !is_of_hardware(&log) {
        // Only the robot of the run's project can read its world.
        let plan = path_of_log(&log, &arguments.file);
        runner::become_one_of(&ProjectFile::of_plan(&plan)?, linked)?;
    }
    let robot = linked.robot.kind();
    if let Some(path) = svg {
        picture::write(path, &afp_run::draw_log(&log, robot)?)?;
    }
    if let Some(path) = sonar {
        picture::write(path, &afp_run::draw_sonar(&log, robot)?)?;
    }
    if let Some(path) = film {
        picture::write(path, &afp_run::draw_film(&log)?)?;
    }
    if let Some(path) = times {
        picture::write(path, &Measured::of(&log, &arguments.file)?.picture())?;
    }
    if let Some(path) = coverage {
        draw_coverage((&log, &arguments.file), path)?;
    }
    Ok(())
}

fn draw_coverage((log, at): (&LogData, &Path), path: &Path) -> Result<(), NoPlan> {
    let (file, graph) = PlanFile::of_log(log, at)?.checked()?;
    let Some(used) = Coverage::of_log(&graph, log) else {
        let message = format!("the log is from another version of '{}'", file.path.display());
        return Err(RunError::usage(message, "run the plan again").into());
    };
    let svg = graph::with_usage(&file, &graph, &used.usage, path)?;
    Ok(picture::write(path, &svg)?)
}
