//! Values that hold names instead of ids and so need no plan.

use afp_core::trace::{ComponentId, Names, TraceEntryId};
use afp_core::{Value, ValueRef};
use afp_types::ValueOf;

/// The holder of a value, which names the type and the values of the enum.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Holder {
    /// An entry.
    Entry(TraceEntryId),
    /// An input of a component, by position.
    Input(ComponentId, u16),
    /// A holder of unknown type.
    Unknown,
}

/// A value with names: `Side.left` for an enum, `#1` if the name is not known; for an object its
/// type and the number of the commit that wrote it.
pub type Datum = ValueOf<String, String, String>;

impl Holder {
    /// The name of the type; empty if unknown.
    fn ty<N: Names + ?Sized>(self, names: &N) -> &str {
        match self {
            Holder::Entry(id) => names.entry(id).ty,
            Holder::Input(id, port) => names.input_port(id, port).ty,
            Holder::Unknown => "",
        }
    }

    /// The name of a value of the enum; empty if unknown.
    fn choice<N: Names + ?Sized>(self, names: &N, value: u16) -> &str {
        match self {
            Holder::Entry(id) => names.choice(id, value),
            Holder::Input(id, port) => names.input_choice(id, port, value),
            Holder::Unknown => "",
        }
    }

    /// Replaces ids in a value by names.
    pub fn named(self, names: &(impl Names + ?Sized), value: ValueRef<'_>) -> Datum {
        let choice = |choice| match self.choice(names, choice) {
            "" => format!("#{choice}"),
            name => format!("{}.{name}", self.ty(names)),
        };
        value.map(str::to_owned, choice, |commit| format!("{}#{commit}", self.ty(names)))
    }

    /// The value as entries hold it; `None` if a name is not known or a text is too long.
    pub fn value(self, names: &(impl Names + ?Sized), value: &Datum) -> Option<Value> {
        let place = |name: String| match name.strip_prefix('#') {
            Some(number) => number.parse().ok(),
            None => {
                let name = name.rsplit_once('.').map_or(name.as_str(), |(_, name)| name);
                let named = |value| self.choice(names, value);
                (0..u16::MAX)
                    .take_while(|value| !named(*value).is_empty())
                    .find(|value| named(*value) == name)
            }
        };
        let value = value.clone().try_map(|text| text.as_str().try_into().ok(), place, |_| None)?;
        Some(value).filter(|value| *value != Value::Unset)
    }
}
