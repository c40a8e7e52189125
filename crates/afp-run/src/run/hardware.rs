//! One run on the robot itself, which is stopped at every end.

use std::sync::Arc;

use afp_session::{NoWorld, Opened, Recipe, SessionError, Settings};

use super::{Setting, drive, recipe};
use crate::error::RunError;
use crate::options::{OF_ROBOT as PREFIX, RunOptions};
use crate::picture::Rasterizer;
use crate::world::LoadedWorld;
use crate::{Program, inputs};

/// What recipes call the robot itself.
pub(crate) const HARDWARE: &str = "hardware";

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
