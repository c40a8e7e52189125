//! `--set` and `--vary`: values for the plan's `in` entries and for its world.

use afp_core::trace::{EntryKind, EntryName, Names, TraceEntryId};
use afp_core::{Fault, StartError, Value};
use afp_excerpt::words::a;
use afp_number::number_length;
use afp_session::{AnyRobot, AnySession, SetError, refusal};

use crate::error::RunError;
use crate::units::some;
use crate::world::{LoadedWorld, change};

/// Changes values of a world as the command line says.
///
/// # Errors
/// A value that is not there or does not fit.
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

/// Sets `in` entries of a plan as the command line says.
///
/// # Errors
/// An entry that is not there or cannot be set, a value that does not fit.
pub fn set_all(session: &mut dyn AnySession, set: &[(String, String)]) -> Result<(), RunError> {
    for (name, text) in set.iter().filter(|(name, _)| change::key(name).is_none()) {
        self::set(session, name, text)?;
    }
    Ok(())
}

/// Sets an `in` entry; gives the value that it has now.
///
/// # Errors
/// An entry that is not there or cannot be set, a value that does not fit.
pub fn set(session: &mut dyn AnySession, name: &str, text: &str) -> Result<Value, RunError> {
    session.set(name, text).map_err(|why| refused(session.names(), name, text, why))
}

/// Why an entry cannot be set, as an error of the command line.
fn refused(names: &dyn Names, name: &str, text: &str, why: SetError) -> RunError {
    match why {
        SetError::Unknown => unknown(name, names),
        SetError::NotIn => RunError::usage(
            format!("the entry '{name}' cannot be set from outside: it is no 'in' entry"),
            settable(names),
        ),
        SetError::Unreadable { why, units } => unreadable(names, name, text, why, &units),
        SetError::Refused(why) => {
            let why = refusal(why, names.entry(id(names, name)));
            RunError::usage(format!("'{name}={text}': {why}"), settable(names))
        }
        other => RunError::usage(format!("'{name}={text}': {other}"), settable(names)),
    }
}

/// Why a plan does not start, as an error of the command line.
pub fn missing(error: StartError, names: &dyn Names) -> RunError {
    match error {
        StartError::InputMissing(entry) => {
            let about = names.entry(TraceEntryId(entry.into()));
            let path = about.path;
            RunError::usage(
                format!("the 'in' entry '{path}' has neither a value nor a default"),
                format!("give it one with '--set {path}=VALUE', {}", a(&what_it_takes(about))),
            )
        }
        _ => RunError::usage("the plan runs already", "start a new one"),
    }
}

fn unknown(name: &str, names: &dyn Names) -> RunError {
    RunError::usage(format!("the plan has no entry '{name}'"), settable(names))
}

fn settable(names: &dyn Names) -> String {
    let entries = (0..names.entries()).map(|id| names.entry(TraceEntryId(id)));
    let settable = entries.filter(|entry| entry.kind == EntryKind::In && !entry.path.contains('.'));
    let list: Vec<_> =
        settable.map(|entry| format!("'{}' ({})", entry.path, what_it_takes(entry))).collect();
    match list.is_empty() {
        true => "this plan has no 'in' entries".to_owned(),
        false => format!("entries that can be set: {}", list.join(", ")),
    }
}

/// The type of an entry and its range.
fn what_it_takes(entry: EntryName) -> String {
    let range = entry.range_text().map(|range| format!(" {range}")).unwrap_or_default();
    format!("{}{range}", entry.ty)
}

/// The entry of that name.
fn id(names: &dyn Names, name: &str) -> TraceEntryId {
    let mut ids = (0..names.entries()).map(TraceEntryId);
    ids.find(|id| names.entry(*id).path == name).unwrap_or(TraceEntryId(u32::MAX))
}

fn unreadable(names: &dyn Names, name: &str, text: &str, why: Fault, units: &[String]) -> RunError {
    let id = id(names, name);
    let EntryName { ty, unit, .. } = names.entry(id);
    let choices = (0..u16::MAX).map(|value| names.choice(id, value));
    let choices: Vec<_> = choices.take_while(|choice| !choice.is_empty()).collect();
    let number = text.parse::<f64>().ok().filter(|number| number.is_finite());
    let help = match (ty, number) {
        _ if let Some(text) = with_a_point(text, units) => format!("write '{name}={text}'"),
        (_, Some(_)) if !unit.is_empty() => {
            let handy = units.iter().find(|unit| *unit == "cm" || *unit == "deg");
            let unit = handy.map_or(unit, String::as_str);
            format!("write the unit: '{name}={text}{unit}'")
        }
        _ if !unit.is_empty() => {
            format!("a number and a unit: {}", some(units.iter().map(String::as_str)))
        }
        _ if !choices.is_empty() => format!("one of: {}", choices.join(", ")),
        _ if why == Fault::TOO_LONG => why.to_string(),
        ("bool", _) => format!("write '{name}=true' or '{name}=false'"),
        ("int", Some(number)) if number.fract() == 0.0 && number.abs() <= EXACT => {
            format!("write '{name}={number}'")
        }
        ("int", _) => format!("a whole number, such as '{name}=3'"),
        ("float", _) => format!("a number, such as '{name}=0.5'"),
        _ => format!("'{name}' is {}", a(ty)),
    };
    RunError::usage(format!("'{name}={text}': not {}", a(ty)), help)
}

/// A number with a decimal comma, and one of the units where there are any, with a point.
fn with_a_point(text: &str, units: &[String]) -> Option<String> {
    let (whole, part) = text.split_once(',')?;
    let text = format!("{whole}.{part}");
    let unit = text.get(number_length(&text)..)?.trim();
    let fits = match units {
        [] => unit.is_empty(),
        units => units.iter().any(|known| known == unit),
    };
    fits.then_some(text)
}

/// The greatest whole number up to which floats have each.
const EXACT: f64 = 9_007_199_254_740_992.0;
