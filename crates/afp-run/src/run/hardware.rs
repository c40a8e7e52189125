//! One run on the robot itself: its time passes by itself, and it stops at every end.

use std::sync::Arc;

use afp_core::{Duration, Instant, StartError};
use afp_session::{AnySession, Go, NoWorld, Observer, Opened, Recipe, SessionError, Settings};

use super::gate::{Halt, RunGate};
use super::{Setting, drive, recipe};
use crate::error::RunError;
use crate::live::Live;
use crate::options::RunOptions;
use crate::picture::Rasterizer;
use crate::report::StoppedBy;
use crate::world::LoadedWorld;
use crate::{Program, inputs};

/// What recipes call the robot itself.
pub(crate) const HARDWARE: &str = "hardware";

/// What the name of a setting begins with that is one of the robot.
const PREFIX: &str = "robot.";

/// The robot sleeps no longer than this before keys and signals are looked at.
const SLICE: Duration = Duration::from_millis(10);

/// Opens the robot and puts the plan on it.
pub type OpenHardware<'a> = dyn FnOnce(&Settings) -> Result<Opened, SessionError> + 'a;

/// Runs a plan on the robot itself; gives the exit code. A `rasterizer` makes PNG pictures; without one they are SVG
/// alone.
///
/// However the run ends, by itself, by a signal, by a panic, because an output cannot be written, the robot is stopped.
///
/// # Errors
/// Options of the simulation, a robot that cannot be reached, an output that does not work.
pub fn run_on_hardware(
    program: &Program<'_>,
    open: Box<OpenHardware<'_>>,
    options: &RunOptions,
    rasterizer: Option<Rasterizer<'_>>,
) -> Result<u8, RunError> {
    options.check()?;
    let world =
        LoadedWorld { world: Arc::new(NoWorld), text: String::new(), path: None, start: None };
    let (of_robot, of_plan): (Vec<_>, Vec<_>) =
        options.set.iter().cloned().partition(|(name, _)| name.starts_with(PREFIX));
    let settings = settings(program, &of_robot)?;
    let Opened { mut session, last_resort } = open(&settings)?;
    inputs::set_all(&mut *session, &of_plan)?;
    let recipe = Recipe {
        robot: HARDWARE.to_owned(),
        measures: Vec::new(),
        ..recipe(program, options, &world, None)?
    };
    let (world, facts, again) = (&world, &[][..], None);
    let setting = Setting { program, options, recipe, world, facts, again, rasterizer };
    drive(&mut *session, last_resort, &setting)
}

/// What the project says of the robot, and the command line in place of it.
fn settings(program: &Program<'_>, set: &[(String, String)]) -> Result<Settings, RunError> {
    let known = program.hardware.iter().map(|(name, _)| *name);
    for (name, _) in set {
        let name = name.strip_prefix(PREFIX).unwrap_or(name);
        if !known.clone().any(|it| it == name) {
            let all: Vec<_> = known.map(|name| format!("'{PREFIX}{name}'")).collect();
            let help = match all.is_empty() {
                true => "'settings' in '[robot.hardware]' of afp.toml has those that can be set"
                    .to_owned(),
                false => format!("it has {}", all.join(", ")),
            };
            return Err(RunError::usage(
                format!("the robot has no setting '{PREFIX}{name}'"),
                help,
            ));
        }
    }
    let said =
        set.iter().map(|(name, text)| (name.strip_prefix(PREFIX).unwrap_or(name), text.as_str()));
    Ok(Settings::new(program.hardware.iter().copied().chain(said)))
}

/// Runs the plan to its end, or until it is stopped. Keys and signals are looked at every [`SLICE`], however long the
/// plan has nothing to do, and before each step, however late it is.
pub(super) fn run_to_end(
    session: &mut dyn AnySession,
    end: Instant,
    gate: &mut RunGate<'_>,
    live: Option<&Live>,
    observers: &mut [&mut dyn Observer],
) -> Result<Option<StoppedBy>, StartError> {
    let stopped_by = loop {
        let now = session.now();
        if session.ending().is_some() {
            return Ok(None);
        }
        if now >= end {
            break StoppedBy::Until;
        }
        let went = session.tick(end.min(now + SLICE), gate, observers)?;
        match (gate.take_halt(), live) {
            // Nobody can press the robot's own buttons from here: the key stops it.
            (Some((Halt::Escape, _)), _) => break StoppedBy::Signal,
            (Some((Halt::Asked, at)), Some(live)) => live.serve(session, at),
            _ if went == Go::Stop => break StoppedBy::Signal,
            _ => {}
        }
    };
    session.stop(observers);
    Ok(Some(stopped_by))
}
