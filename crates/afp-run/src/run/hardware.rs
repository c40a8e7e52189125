//! A run on a real robot, which is stopped at every end.

use std::sync::Arc;

use afp_project::Realtime;
use afp_session::{NoWorld, Opened, Recipe, STALL, SessionError, Settings};

use super::{Guards, Setting, armed, drive, recipe};
use crate::error::{EXIT_OK, RunError};
use crate::options::{OF_ROBOT as PREFIX, RunOptions};
use crate::world::LoadedWorld;
use crate::{Extras, Program, inputs};

/// The name of a real robot in recipes.
pub(crate) const HARDWARE: &str = "hardware";

pub type OpenHardware<'a> = dyn Fn(&Settings) -> Result<Opened, SessionError> + 'a;

/// Runs a plan on a real robot; returns the exit code.
///
/// The robot is stopped after every end of the run: normal, by a signal, by a panic, by an output
/// error.
///
/// # Errors
/// Options for simulations only, a robot that cannot be reached, an output that cannot be written.
pub fn run_on_hardware(
    program: &Program<'_>,
    open: Box<OpenHardware<'_>>,
    options: &RunOptions,
    extras: Extras<'_>,
) -> Result<u8, RunError> {
    options.check()?;
    let world =
        LoadedWorld { world: Arc::new(NoWorld), text: String::new(), path: None, start: None };
    let (of_robot, of_plan): (Vec<_>, Vec<_>) =
        options.set.iter().cloned().partition(|(name, _)| name.starts_with(PREFIX));
    let (settings, realtime) = settings(program, &of_robot)?;
    // The robot is opened first, so that one that cannot be reached is noticed before it is armed.
    // It is closed before the run, which begins at zero.
    if options.disarmed && !armed::wait(Some(open(&settings)?.session))? {
        return Ok(EXIT_OK);
    }
    let Opened { mut session, last_resort, watch } = open(&settings)?;
    if options.stop_only {
        session.end();
        return Ok(EXIT_OK);
    }
    let stall = realtime.stall.unwrap_or(STALL);
    session.set_stall(stall);
    let watch = watch.map(|watch| (watch, stall));
    let guards = Guards { last_resort, watch, realtime };
    inputs::set_all(&mut *session, &of_plan)?;
    let recipe = Recipe {
        robot: HARDWARE.to_owned(),
        measures: Vec::new(),
        ..recipe(program, options, &world, None)?
    };
    let (world, facts, again) = (&world, &[][..], None);
    let setting = Setting { program, options, recipe, world, facts, again, extras };
    drive(&mut *session, guards, &setting)
}

/// The settings of the robot and its control loop; the command line overrides the project.
fn settings(
    program: &Program<'_>,
    set: &[(String, String)],
) -> Result<(Settings, Realtime), RunError> {
    let known: Vec<_> = program.hardware.iter().map(|(name, _)| *name).collect();
    let set = set.iter().map(|(name, text)| (name.strip_prefix(PREFIX).unwrap_or(name), &**text));
    let (mut of_driver, mut realtime) = (Vec::new(), Realtime::default());
    for (name, text) in program.hardware.iter().copied().chain(set) {
        let of_loop = name.strip_prefix(Realtime::PREFIX);
        match of_loop.filter(|name| Realtime::NAMES.contains(name)) {
            Some(of_loop) => realtime.set(of_loop, text).map_err(|what| {
                RunError::usage(
                    format!("'{PREFIX}{name}' cannot be '{text}'"),
                    format!("write {what}"),
                )
            })?,
            None if known.contains(&name) => of_driver.push((name, text)),
            None => return Err(unknown(name, &known)),
        }
    }
    Ok((Settings::new(of_driver), realtime))
}

fn unknown(name: &str, known: &[&str]) -> RunError {
    let all: Vec<_> = known.iter().map(|name| format!("'{PREFIX}{name}'")).collect();
    let help = match all.is_empty() {
        true => "'settings' in '[robot.hardware]' of afp.toml lists the settings".to_owned(),
        false => format!("it has {}", all.join(", ")),
    };
    RunError::usage(format!("the robot has no setting '{PREFIX}{name}'"), help)
}
