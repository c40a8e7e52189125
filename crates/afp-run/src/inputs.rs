//! `--set` and `--vary`: values for the plan's `in` entries and for its world.

use afp_core::rt::NamedPlan;
use afp_core::trace::{EntryKind, EntryName, Names, TraceEntryId};
use afp_core::{Fault, StartError, Value, WriteError};

use crate::error::RunError;
use crate::world::{LoadedWorld, change};

/// Sets `in` entries of a plan and values of its world as the command line says.
///
/// # Errors
/// An entry that is not there or cannot be set, a value that does not fit.
pub fn set_all(
    plan: &mut impl NamedPlan,
    world: &mut LoadedWorld,
    set: &[(String, String)],
) -> Result<(), RunError> {
    for (name, text) in set {
        match change::key(name) {
            Some(key) => *world = world.with(key, text)?,
            None => {
                self::set(plan, name, text)?;
            }
        }
    }
    Ok(())
}

/// Sets an `in` entry; gives the value that it has now.
///
/// # Errors
/// An entry that is not there or cannot be set, a value that does not fit.
pub fn set(plan: &mut impl NamedPlan, name: &str, text: &str) -> Result<Value, RunError> {
    let names = plan.names();
    let entry = plan.entry_named(name).ok_or_else(|| unknown(name, &names))?;
    let about = names.entry(TraceEntryId(entry.into()));
    if about.kind != EntryKind::In {
        return Err(RunError::usage(
            format!("the entry '{name}' cannot be set from outside: it is no 'in' entry"),
            settable(&names),
        ));
    }
    let value = plan.read(entry, text).map_err(|why| unreadable(text, &about, why, plan, entry))?;
    plan.set_input(entry, &value).map_err(|why: WriteError| {
        RunError::usage(format!("'{name}={text}': {why}"), settable(&names))
    })?;
    Ok(value)
}

/// Why a plan does not start, as an error of the command line.
pub fn missing(error: StartError, names: &dyn Names) -> RunError {
    match error {
        StartError::InputMissing(entry) => {
            let EntryName { path, ty, .. } = names.entry(TraceEntryId(entry.into()));
            RunError::usage(
                format!("the 'in' entry '{path}' has neither a value nor a default"),
                format!("give it one with '--set {path}=VALUE', a {ty}"),
            )
        }
        StartError::AlreadyStarted => RunError::usage("the plan runs already", "start a new one"),
    }
}

fn unknown(name: &str, names: &impl Names) -> RunError {
    RunError::usage(format!("the plan has no entry '{name}'"), settable(names))
}

fn settable(names: &impl Names) -> String {
    let entries = (0..names.entries()).map(|id| names.entry(TraceEntryId(id)));
    let settable = entries.filter(|entry| entry.kind == EntryKind::In && !entry.path.contains('.'));
    let list: Vec<_> = settable.map(|entry| format!("'{}' ({})", entry.path, entry.ty)).collect();
    match list.is_empty() {
        true => "this plan has no 'in' entries".to_owned(),
        false => format!("entries that can be set: {}", list.join(", ")),
    }
}

fn unreadable(
    text: &str,
    entry: &EntryName<'_>,
    why: Fault,
    plan: &impl NamedPlan,
    number: u16,
) -> RunError {
    let EntryName { path, ty, unit, .. } = *entry;
    let names = plan.names();
    let id = TraceEntryId(number.into());
    let choices = (0..u16::MAX).map(|value| names.choice(id, value));
    let choices: Vec<_> = choices.take_while(|choice| !choice.is_empty()).collect();
    let help = if text.parse::<f64>().is_ok() && !unit.is_empty() {
        let unit = plan.units(number).find(|unit| unit.name == "cm" || unit.name == "deg");
        let unit = unit.map_or(entry.unit, |unit| unit.name).to_owned();
        format!("write the unit: '{path}={text}{unit}'")
    } else if !unit.is_empty() {
        let units: Vec<_> = plan.units(number).map(|unit| unit.name.to_owned()).take(8).collect();
        format!("a number and a unit: {}", units.join(", "))
    } else if !choices.is_empty() {
        format!("one of: {}", choices.join(", "))
    } else if why == Fault::TOO_LONG {
        why.to_string()
    } else {
        format!("'{path}' is a {ty}")
    };
    RunError::usage(format!("'{path}={text}': not a {ty}"), help)
}
