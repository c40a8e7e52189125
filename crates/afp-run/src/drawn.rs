//! Pictures of logged runs, and errors for logs without a picture.

use std::sync::Arc;

use afp_core::Instant;
use afp_log::svg::{self, SoFar, follow};
use afp_log::{LogData, WORLD};
use afp_session::{AnyRobot, AnyWorld, NoWorld, WorldError};

use crate::error::RunError;
use crate::run::HARDWARE;
use crate::world::named;

/// Draws the path of a logged run in its world.
///
/// # Errors
/// The log has no world, or one that this release cannot read.
pub fn draw_log(log: &LogData, robot: &dyn AnyRobot) -> Result<String, RunError> {
    let world = world_of(log, robot)?;
    let names = &log.names;
    let (path, marks) = follow(&log.events, &log.poses, names);
    if path.is_empty() && world.scene().is_empty() {
        return Err(nothing_to_draw());
    }
    let fact = |key: &str| log.facts.get(key).map_or("", String::as_str);
    let run = SoFar {
        plan: fact("plan"),
        world: &*world,
        seed: fact("seed"),
        time: log.span.map_or(Instant::ZERO, |(_, last)| last),
        path: &path,
        marks: &marks,
        things: &log.things,
    };
    Ok(svg::draw_run(&run, names))
}

/// Draws the echoes of a logged run and the walls of its world.
///
/// # Errors
/// The log has no echoes, or no world that this release can read.
pub fn draw_sonar(log: &LogData, robot: &dyn AnyRobot) -> Result<String, RunError> {
    let world = world_of(log, robot)?;
    svg::draw_sonar(log, &*world).ok_or_else(|| {
        let help = "log a longer run, with something in reach of the range sensor";
        RunError::usage("the log has no echoes", help)
    })
}

/// Draws the film strip of a logged run.
///
/// # Errors
/// The log has no camera pictures.
pub fn draw_film(log: &LogData) -> Result<String, RunError> {
    svg::draw_film(log).ok_or_else(|| {
        let help = "log a run with them: 'afpc run plan.afp --camera --log run.mcap'";
        RunError::usage("the log has no camera pictures", help)
    })
}

/// Whether a logged run took place on a real robot, whose world no program knows.
pub fn is_of_hardware(log: &LogData) -> bool {
    log.facts.get("robot").is_some_and(|robot| robot == HARDWARE)
}

/// The error for a run without a world on a robot without a pose.
pub(crate) fn nothing_to_draw() -> RunError {
    let message =
        "there is nothing to draw: the run has no world, and the robot reports no position";
    let help = "a robot that reports a signal of type 'pose' has a path";
    RunError::Missing { message: message.to_owned(), help: help.to_owned() }
}

/// The world of a logged run; empty for a real robot.
///
/// # Errors
/// The log has no world, or one that this release cannot read.
fn world_of(log: &LogData, robot: &dyn AnyRobot) -> Result<Arc<dyn AnyWorld>, RunError> {
    if is_of_hardware(log) {
        return Ok(Arc::new(NoWorld));
    }
    let Some(text) = log.attachments.get(WORLD) else {
        let help = "name the log of a run";
        return Err(RunError::usage("the log does not name the world of its run", help));
    };
    // The hint is for files, not for logs.
    let wrong = |why| RunError::content(WORLD, text)(WorldError { help: String::new(), ..why });
    let world = robot.world(text).map_err(wrong)?;
    let recipe = log.recipe();
    let world = named(world, &recipe.world.name);
    match recipe.start {
        None => Ok(world),
        Some(start) => world.started_at(start).map_err(wrong),
    }
}
