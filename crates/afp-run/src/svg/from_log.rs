//! The picture of a run from its log alone, and where the robot was from what is told of a run.

use afp_core::Instant;
use afp_core::trace::Names;
use afp_log::{LogData, WORLD};
use std::sync::Arc;

use afp_session::{AnyRobot, AnyWorld, Mark, NoWorld, Pose2, RunEvent, Track, Waypoint};

use super::{SoFar, draw_run};
use crate::error::RunError;
use crate::run::HARDWARE;
use crate::world::named;

/// Draws the path of a logged run over its world.
///
/// # Errors
/// The log has no world, or one that this release does not understand.
pub fn draw_log(log: &LogData, robot: &dyn AnyRobot) -> Result<String, RunError> {
    let world = world_of(log, robot)?;
    let names = &log.names;
    let (path, marks) = follow(&log.events, &log.poses, names);
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
    Ok(draw_run(&run, names))
}

/// Whether a logged run was one of the robot itself, which is in no world that a program knows.
pub fn is_of_hardware(log: &LogData) -> bool {
    log.facts.get("robot").is_some_and(|robot| robot == HARDWARE)
}

/// The world of a logged run; an empty one where that was one of the robot itself.
///
/// # Errors
/// The log has none, or one that this release does not understand.
pub(super) fn world_of(log: &LogData, robot: &dyn AnyRobot) -> Result<Arc<dyn AnyWorld>, RunError> {
    if is_of_hardware(log) {
        return Ok(Arc::new(NoWorld));
    }
    let content = |message: String, span, text: &str| RunError::Content {
        path: WORLD.into(),
        span,
        text: text.to_owned(),
        message,
        help: String::new(),
    };
    let Some(text) = log.attachments.get(WORLD) else {
        let help = "name the log of a run, which begins with its world";
        return Err(RunError::usage("the log does not say in which world the plan ran", help));
    };
    let world = robot.world(text).map_err(|error| content(error.message, error.span, text))?;
    let recipe = log.recipe();
    let world = named(world, &recipe.world.name);
    match recipe.start {
        None => Ok(world),
        Some(start) => world.started_at(start).map_err(|why| content(why, None, text)),
    }
}

/// The path with the actor at each point, and the events on it, from what happened and where the robot was when, both in the
/// order of time.
pub fn follow<'a>(
    events: impl IntoIterator<Item = &'a RunEvent>,
    poses: &[(Instant, Pose2)],
    names: &dyn Names,
) -> (Vec<Waypoint>, Vec<Mark>) {
    let mut track = Track::new(&[]);
    let mut poses = poses.iter().copied().peekable();
    for event in events {
        // At an instant the robot is looked at before the step.
        while let Some((at, pose)) = poses.next_if(|(at, _)| *at <= event.at) {
            track.note_pose(at, pose);
        }
        if let Some(record) = event.record() {
            track.note_record(event.at, &record, names);
        }
    }
    poses.for_each(|(at, pose)| track.note_pose(at, pose));
    (track.path, track.marks)
}
