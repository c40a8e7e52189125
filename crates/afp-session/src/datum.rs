//! Values with the names in them, so that they need no plan to be understood.

use std::fmt;

use afp_core::trace::{ComponentId, Names, TraceEntryId};
use afp_core::{Value, ValueRef};
use afp_types::Measured;

/// What has a value: its type and the values of its enum have names there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Holder {
    /// An entry.
    Entry(TraceEntryId),
    /// An input of a component, by position.
    Input(ComponentId, u16),
    /// Nothing whose type is known.
    Unknown,
}

/// A value with the names in it.
#[derive(Clone, Debug, PartialEq)]
pub enum Datum {
    /// Nobody has written it yet.
    Unset,
    /// A truth value.
    Truth(bool),
    /// An integer.
    Integer(i64),
    /// A number, or a quantity in SI units.
    Number(f64),
    /// A text.
    Text(String),
    /// A value of an enum, `Side.left`; `#1` where its name is not known.
    Choice(String),
    /// An object: its type and the number of the commit that wrote it.
    Object(String),
}

impl Holder {
    /// The name of the type of its values; empty where that is not known.
    fn ty<N: Names + ?Sized>(self, names: &N) -> &str {
        match self {
            Holder::Entry(id) => names.entry(id).ty,
            Holder::Input(id, port) => names.input_port(id, port).ty,
            Holder::Unknown => "",
        }
    }

    /// A value of its enum; empty where that is not known.
    fn choice<N: Names + ?Sized>(self, names: &N, value: u16) -> &str {
        match self {
            Holder::Entry(id) => names.choice(id, value),
            Holder::Input(id, port) => names.input_choice(id, port, value),
            Holder::Unknown => "",
        }
    }
}

impl Datum {
    /// A value of an entry or port.
    pub fn new(names: &(impl Names + ?Sized), of: Holder, value: ValueRef<'_>) -> Datum {
        match value {
            ValueRef::Unset => Datum::Unset,
            ValueRef::Bool(truth) => Datum::Truth(truth),
            ValueRef::Int(integer) => Datum::Integer(integer),
            ValueRef::Float(number) => Datum::Number(number),
            ValueRef::Text(text) => Datum::Text(text.to_owned()),
            ValueRef::Choice(choice) => Datum::Choice(match of.choice(names, choice) {
                "" => format!("#{choice}"),
                name => format!("{}.{name}", of.ty(names)),
            }),
            ValueRef::Object(commit) => Datum::Object(format!("{}#{commit}", of.ty(names))),
        }
    }

    /// The value as entries hold it; none where a name in it is not known or a text is too long.
    pub fn value(&self, names: &(impl Names + ?Sized), of: Holder) -> Option<Value> {
        Some(match self {
            Datum::Unset | Datum::Object(_) => return None,
            Datum::Truth(truth) => Value::Bool(*truth),
            Datum::Integer(integer) => Value::Int(*integer),
            Datum::Number(number) => Value::Float(*number),
            Datum::Text(text) => Value::Text(text.as_str().try_into().ok()?),
            Datum::Choice(name) => Value::Choice(match name.strip_prefix('#') {
                Some(number) => number.parse().ok()?,
                None => {
                    let name = name.rsplit_once('.').map_or(name.as_str(), |(_, name)| name);
                    let named = |value| of.choice(names, value);
                    (0..u16::MAX)
                        .take_while(|value| !named(*value).is_empty())
                        .find(|value| named(*value) == name)?
                }
            }),
        })
    }
}

impl Datum {
    /// The value as people write it; the number of a quantity is in that SI unit.
    pub fn in_unit(&self, unit: &str) -> String {
        match self {
            Datum::Number(number) => Measured::new(*number, unit).to_string(),
            other => other.to_string(),
        }
    }
}

impl fmt::Display for Datum {
    /// As in a plan, quantities in SI units without the unit.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Datum::Unset => f.write_str("unset"),
            Datum::Truth(truth) => truth.fmt(f),
            Datum::Integer(integer) => integer.fmt(f),
            Datum::Number(number) => number.fmt(f),
            Datum::Text(text) => write!(f, "{text:?}"),
            Datum::Choice(text) | Datum::Object(text) => f.write_str(text),
        }
    }
}
