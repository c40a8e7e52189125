//! What a plan shall run on: how fine its time is, and how much of the processor plans may use.

use std::fmt;
use std::ops::Range;

use toml_edit::{Document, Item, TableLike, Value};

use crate::types::literal::Literal;

/// Share of the processor that plans may use where none is given.
const DEFAULT_CAPACITY: f64 = 0.7;

/// A machine that runs plans.
#[derive(Clone, Debug, PartialEq)]
pub struct Target {
    /// Its name.
    pub name: String,
    /// The grain of its time in nanoseconds: nothing happens more often, and what is due may be
    /// noticed so much later. `None` where it is not known.
    pub tick: Option<u64>,
    /// The share of the processor that a plan may ask for, more than 0 and at most 1.
    pub capacity: f64,
}

/// The targets that are known everywhere: name, tick in nanoseconds, capacity.
///
/// On Linux the tick is what a timer of a thread without slack is late by on a machine that is not
/// overloaded; the microcontroller has a timer of its own.
pub const BUILT_IN: &[(&str, u64, f64)] = &[
    ("host", 50_000, DEFAULT_CAPACITY),
    ("pi", 100_000, DEFAULT_CAPACITY),
    ("pi32", 100_000, DEFAULT_CAPACITY),
    ("mcu", 10_000, DEFAULT_CAPACITY),
];

impl Target {
    /// The built-in target of that name.
    pub fn built_in(name: &str) -> Option<Target> {
        let (name, tick, capacity) = BUILT_IN.iter().find(|(known, ..)| *known == name)?;
        Some(Target { name: (*name).to_owned(), tick: Some(*tick), capacity: *capacity })
    }
}

/// What is wrong with the targets of an `afp.toml`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TargetError {
    /// What is wrong, and what to write instead.
    pub message: String,
    /// The place, in bytes.
    pub span: Range<usize>,
}

impl fmt::Display for TargetError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for TargetError {}

/// Reads the tables `[target.NAME]` of an `afp.toml`, in the order of the file; the rest of it is
/// left to others. One named like a built-in target changes that.
///
/// # Errors
/// The text is no TOML; a key that is not `tick` or `capacity`; a value that cannot be.
pub fn targets(text: &str) -> Result<Vec<Target>, TargetError> {
    let document = Document::parse(text).map_err(|error| TargetError {
        message: error.message().to_owned(),
        span: error.span().unwrap_or(0..0),
    })?;
    let Some(item) = document.get("target") else { return Ok(Vec::new()) };
    let tables = item.as_table_like().ok_or_else(|| wrong(item, "'target' is a table"))?;
    tables.iter().map(|(name, item)| target(name, item)).collect()
}

fn target(name: &str, item: &Item) -> Result<Target, TargetError> {
    let table = item.as_table_like().ok_or_else(|| {
        wrong(item, &format!("'target.{name}' is a table with 'tick' and 'capacity'"))
    })?;
    let known = Target::built_in(name);
    let mut target = known.unwrap_or_else(|| Target {
        name: name.to_owned(),
        tick: None,
        capacity: DEFAULT_CAPACITY,
    });
    for (key, item) in table.iter() {
        match key {
            "tick" => target.tick = Some(tick(item)?),
            "capacity" => target.capacity = capacity(item)?,
            _ => {
                let message = format!("a target has no '{key}'; it has 'tick' and 'capacity'");
                return Err(TargetError { message, span: key_span(table, key, item) });
            }
        }
    }
    Ok(target)
}

fn tick(item: &Item) -> Result<u64, TargetError> {
    let text = item.as_str().unwrap_or("");
    let time = Literal::parse(text).ok().filter(|literal| literal.unit.is_some());
    let time = time.and_then(|literal| literal.nanoseconds());
    time.filter(|time| *time > 0)
        .ok_or_else(|| wrong(item, "a tick is a time in quotes, such as \"100 us\""))
}

fn capacity(item: &Item) -> Result<f64, TargetError> {
    let value = match item.as_value() {
        Some(Value::Float(value)) => Some(*value.value()),
        Some(Value::Integer(value)) => Some(*value.value() as f64),
        _ => None,
    };
    value
        .filter(|value| *value > 0.0 && *value <= 1.0)
        .ok_or_else(|| wrong(item, "a capacity is a number above 0 and at most 1, such as 0.7"))
}

fn wrong(item: &Item, message: &str) -> TargetError {
    TargetError { message: message.to_owned(), span: item.span().unwrap_or(0..0) }
}

fn key_span(table: &dyn TableLike, key: &str, item: &Item) -> Range<usize> {
    let span = table.get_key_value(key).and_then(|(key, _)| key.span());
    span.or_else(|| item.span()).unwrap_or(0..0)
}

#[cfg(test)]
mod tests {
    use super::{Target, targets};

    #[test]
    fn targets_are_read_in_order_and_change_the_built_in_ones() {
        let text =
            "[run]\nworld = 'x'\n[target.pi]\ncapacity = 0.5\n[target.toy]\ntick = \"2 ms\"\n";
        let found = targets(text).unwrap();
        let pi = Target { capacity: 0.5, ..Target::built_in("pi").unwrap() };
        let toy = Target { name: "toy".to_owned(), tick: Some(2_000_000), capacity: 0.7 };
        assert_eq!(found, [pi, toy]);
        assert_eq!(targets("").unwrap(), []);
    }

    #[test]
    fn what_is_wrong_is_named_at_its_place() {
        let wrong = |text: &str| {
            let error = targets(text).unwrap_err();
            (text[error.span.clone()].to_owned(), error.message)
        };
        assert_eq!(wrong("[target.a]\ntock = 1").0, "tock");
        assert_eq!(wrong("[target.a]\ntick = 1").0, "1");
        assert_eq!(wrong("[target.a]\ntick = \"0 s\"").0, "\"0 s\"");
        assert_eq!(wrong("[target.a]\ntick = \"3 cm\"").0, "\"3 cm\"");
        assert_eq!(wrong("[target.a]\ncapacity = 1.5").0, "1.5");
        assert_eq!(wrong("[target]\na = 3").0, "3");
        assert!(wrong("target = 3").1.contains("table"));
        assert!(!wrong("[target").1.is_empty());
    }
}
