//! `--set` and `--vary`: values for the plan's `in` entries and for its world.

use afp_core::trace::Names;
use afp_core::{StartError, Value};
use afp_excerpt::words::a;
use afp_session::{AnyRobot, AnySession, NotSet, what_it_takes};

use crate::error::RunError;
use crate::world::{LoadedWorld, change};

/// Changes values of a world.
///
/// # Errors
/// The value does not exist in the world or does not fit.
pub fn change_world(
    world: &mut LoadedWorld,
    set: &[(String, String)],
    robot: &dyn AnyRobot,
) -> Result<(), RunError> {
    let changes = set.iter().filter_map(|(name, text)| Some((change::key(name)?, text.as_str())));
    let changes: Vec<_> = changes.collect();
    if !changes.is_empty() {
        *world = world.with(&changes, robot)?;
    }
    Ok(())
}

/// Sets `in` entries of a plan.
///
/// # Errors
/// An entry does not exist or cannot be set; a value does not fit.
pub fn set_all(session: &mut dyn AnySession, set: &[(String, String)]) -> Result<(), RunError> {
    for (name, text) in set.iter().filter(|(name, _)| change::key(name).is_none()) {
        self::set(session, name, text)?;
    }
    Ok(())
}

/// Sets an `in` entry and returns its new value.
///
/// # Errors
/// The entry does not exist or cannot be set; the value does not fit.
pub fn set(session: &mut dyn AnySession, name: &str, text: &str) -> Result<Value, RunError> {
    session.set(name, text).map_err(|NotSet { why, help, .. }| RunError::usage(why, help))
}

/// Converts the error of a start to an error of the command line.
pub fn missing(error: StartError, names: &dyn Names) -> RunError {
    match error {
        StartError::InputMissing(entry) => {
            let about = names.entry(entry.into());
            let path = about.path;
            RunError::usage(
                format!("the 'in' entry '{path}' has neither a value nor a default"),
                format!("give it one with '--set {path}=VALUE', {}", a(&what_it_takes(about))),
            )
        }
        _ => RunError::usage("the plan already runs", "start a new one"),
    }
}
