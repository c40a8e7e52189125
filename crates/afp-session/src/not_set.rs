//! Explains why an entry cannot be set: one wording for all callers.

use afp_core::trace::{EntryKind, EntryName, Names, TraceEntryId};
use afp_core::{Fault, SetError, WriteError};
use afp_excerpt::words::a;
use afp_types::{EXACT, number_length};

use crate::units::some_units;

/// The reason why an entry cannot be set, and a hint.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{why} (help: {help})")]
pub struct NotSet {
    /// The error of the scheduler, which knows positions only.
    #[source]
    pub cause: SetError,
    /// The reason.
    pub why: String,
    /// The hint.
    pub help: String,
}

/// The reason why an entry refuses a value, with the range if the value is out of range.
pub fn refusal(why: WriteError, entry: EntryName<'_>) -> String {
    match entry.range_text().filter(|_| why == WriteError::Range) {
        Some(range) => format!("{why}, {range}"),
        None => why.to_string(),
    }
}

impl NotSet {
    /// Explains why a plan refused a text for an entry. `units` are the units of the entry.
    pub(crate) fn new(
        cause: SetError,
        names: &dyn Names,
        started: bool,
        (name, text): (&str, &str),
        units: &[&str],
    ) -> Self {
        let id = id(names, name);
        let entry = names.entry(id);
        let is_object = names.holds_object(id);
        let why = match cause {
            SetError::Unknown if entry.path.is_empty() => no_entry(name),
            SetError::Unknown => {
                format!("the entry '{name}' of a sub-plan cannot be set from outside")
            }
            _ if is_object => {
                format!("the entry '{name}' has an object, which only templates can make")
            }
            SetError::Refused(WriteError::NotStarted) => format!(
                "the entry '{name}' cannot be set before the start: its initial value would replace it"
            ),
            SetError::Refused(WriteError::ReadOnly) => format!(
                "the entry '{name}' cannot be set from outside: it is declared '{}'",
                entry.kind.word()
            ),
            SetError::Refused(why) => format!("'{name}={text}': {}", refusal(why, entry)),
            _ => format!("'{name}={text}': not {}", a(entry.ty)),
        };
        let help = match cause {
            SetError::Unreadable { why, .. } if !is_object => {
                readable(names, id, (name, text), why, units)
            }
            _ => settable(names, started),
        };
        NotSet { cause, why, help }
    }
}

fn id(names: &dyn Names, name: &str) -> TraceEntryId {
    let mut ids = (0..names.entries()).map(TraceEntryId);
    ids.find(|id| names.entry(*id).path == name).unwrap_or(TraceEntryId(u32::MAX))
}

/// Lists the entries that can be set now.
fn settable(names: &dyn Names, started: bool) -> String {
    let is_open = |kind| kind == EntryKind::In || started && kind == EntryKind::Var;
    let ids = (0..names.entries()).map(TraceEntryId).filter(|id| !names.holds_object(*id));
    let entries = ids.map(|id| names.entry(id));
    let open = entries.filter(|entry| is_open(entry.kind) && !entry.path.contains('.'));
    let list = open.map(|it| (it.path, what_it_takes(it)));
    let none = if started { "this plan has no 'in' or 'var' entries" } else { NO_INPUTS };
    that_can_be_set(list).unwrap_or_else(|| none.to_owned())
}

const NO_INPUTS: &str = "this plan has no 'in' entries";

fn no_entry(name: &str) -> String {
    format!("the plan has no entry '{name}'")
}

/// Lists entries with their types; `None` for an empty list.
fn that_can_be_set<'a>(entries: impl Iterator<Item = (&'a str, String)>) -> Option<String> {
    let list: Vec<_> = entries.map(|(name, takes)| format!("'{name}' ({takes})")).collect();
    (!list.is_empty()).then(|| format!("entries that can be set: {}", list.join(", ")))
}

impl NotSet {
    /// The error for an entry that a plan (not loaded yet) lacks, with its `in` entries and their
    /// types.
    pub fn unknown<'a>(name: &str, inputs: impl Iterator<Item = (&'a str, String)>) -> Self {
        let help = that_can_be_set(inputs).unwrap_or_else(|| NO_INPUTS.to_owned());
        NotSet { cause: SetError::Unknown, why: no_entry(name), help }
    }
}

/// The type of an entry and its range.
pub fn what_it_takes(entry: EntryName<'_>) -> String {
    let range = entry.range_text().map(|range| format!(" {range}")).unwrap_or_default();
    format!("{}{range}", entry.ty)
}

/// Explains how a value of an entry is written.
fn readable(
    names: &dyn Names,
    id: TraceEntryId,
    (name, text): (&str, &str),
    why: Fault,
    units: &[&str],
) -> String {
    let EntryName { ty, unit, .. } = names.entry(id);
    let choices = (0..u16::MAX).map(|value| names.choice(id, value));
    let choices: Vec<_> = choices.take_while(|choice| !choice.is_empty()).collect();
    let number = text.parse::<f64>().ok().filter(|number| number.is_finite());
    match (ty, number) {
        _ if let Some(text) = with_a_point(text, units) => format!("write '{name}={text}'"),
        (_, Some(_)) if !unit.is_empty() => {
            let handy = units.iter().find(|unit| matches!(**unit, "cm" | "deg"));
            let unit = handy.copied().unwrap_or(unit);
            format!("write the unit: '{name}={text}{unit}'")
        }
        _ if !unit.is_empty() => {
            format!("a number and a unit: {}", some_units(units.iter().copied()))
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
    }
}

/// Replaces the decimal comma of a number by a point, if its unit is one of `units`.
fn with_a_point(text: &str, units: &[&str]) -> Option<String> {
    let (whole, part) = text.split_once(',')?;
    let text = format!("{whole}.{part}");
    let unit = text.get(number_length(&text)..)?.trim();
    let fits = match units {
        [] => unit.is_empty(),
        units => units.contains(&unit),
    };
    fits.then_some(text)
}
