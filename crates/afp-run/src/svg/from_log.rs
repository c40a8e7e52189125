//! The picture of a run from its log alone, and where the robot was from what is told of a run.

use afp_core::Instant;
use afp_core::trace::{ComponentId, ComponentKind, Names};
use afp_log::{LogData, WORLD};
use std::sync::Arc;

use afp_session::{AnyRobot, AnyWorld, EventKind, Mark, Pose2, RunEvent, Waypoint};

use super::{SoFar, draw_run};
use crate::error::RunError;
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

/// The world of a logged run.
///
/// # Errors
/// The log has none, or one that this release does not understand.
pub(super) fn world_of(log: &LogData, robot: &dyn AnyRobot) -> Result<Arc<dyn AnyWorld>, RunError> {
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
    let (mut path, mut marks) = (Vec::new(), Vec::new());
    let (mut actor, mut last) = (None, Pose2::default());
    let mut events = events.into_iter().peekable();
    let after = std::iter::once((Instant::MAX, None));
    for (at, pose) in poses.iter().map(|(at, pose)| (*at, Some(pose))).chain(after) {
        // At an instant the robot is looked at before the step; only the start comes first.
        let before = |event: &&RunEvent| event.at < at || event.at == Instant::ZERO;
        while let Some(event) = events.next_if(before) {
            if event.kind == EventKind::Event {
                marks.push(mark(event, last));
            } else if names.component(event.component_id).kind == ComponentKind::Actor {
                actor = active(event).unwrap_or(actor);
            }
        }
        if let Some(pose) = pose {
            last = *pose;
            path.push(Waypoint { at, pose: last, actor });
        }
    }
    (path, marks)
}

/// Which actor is active after an actor's event; `None` when it says nothing about that.
fn active(event: &RunEvent) -> Option<Option<ComponentId>> {
    match event.kind {
        EventKind::Started => Some(Some(event.component_id)),
        EventKind::Interrupted | EventKind::Finished | EventKind::Faulted => Some(None),
        _ => None,
    }
}

fn mark(event: &RunEvent, pose: Pose2) -> Mark {
    Mark { pose, at: event.at, supervisor: event.component_id, event: event.outcome_id }
}
