//! The value that caused a fault, and the message with both.
//!
//! A [`Fault`] is one pointer, so that polls stay fast. The detail is built only after a failure
//! and holds numbers; names, ranges and positions are looked up for the message.

use core::fmt;

use afp_types::{Error, Measured, Quantity};

use super::Fault;
use crate::trace::{ComponentId, Names, Outcome, PortName, TextPlace, TraceEntryId};

/// The value that caused a fault.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Detail {
    /// The innermost component, if sub-plans passed the fault on.
    pub component: ComponentId,
    /// The use of the value.
    pub subject: Subject,
    /// The value in SI units, if it is a number.
    pub value: Option<f64>,
}

/// The use of a value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Subject {
    /// An input port, by position in the template; of a sub-plan, by position among its `in`
    /// entries.
    Input(u16),
    /// An output port, by position in the template; of a sub-plan, by position among its `out`
    /// entries.
    Output(u16),
    /// The initial value of an entry.
    Entry(TraceEntryId),
    /// The condition or an assignment of a declared computation's state, by position.
    State(u16),
}

/// A fault and the invalid value, on its way to the scheduler.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BadValue {
    /// The fault.
    pub fault: Fault,
    /// The use of the value; entries by position in their plan.
    pub(crate) port: Option<Port>,
    /// The value, if it is a number.
    pub value: Option<f64>,
}

/// [`Subject`] relative to a plan, which does not know its first id.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Port {
    Input(u16),
    Output(u16),
    Entry(u16),
    State(u16),
}

impl From<Fault> for BadValue {
    fn from(fault: Fault) -> Self {
        BadValue { fault, port: None, value: None }
    }
}

impl From<Error> for BadValue {
    fn from(error: Error) -> Self {
        Fault::from(error).into()
    }
}

impl BadValue {
    /// An invalid number.
    #[cold]
    pub const fn number(fault: Fault, value: f64) -> Self {
        BadValue { fault, port: None, value: Some(value) }
    }

    /// Adds the input port.
    #[must_use]
    pub fn for_input(self, port: u16) -> Self {
        self.meant_for(Port::Input(port))
    }

    /// Adds the output port, whose entry the value was for.
    #[must_use]
    pub fn for_output(self, port: u16) -> Self {
        self.meant_for(Port::Output(port))
    }

    /// Adds the entry, by position in its plan, whose initial value this is.
    #[must_use]
    pub fn for_entry(self, entry: u16) -> Self {
        self.meant_for(Port::Entry(entry))
    }

    /// Adds the state of a declared computation whose condition or assignment failed.
    #[must_use]
    pub fn for_state(self, state: u16) -> Self {
        self.meant_for(Port::State(state))
    }

    /// Keeps an earlier port, which is the inner one.
    fn meant_for(self, port: Port) -> Self {
        BadValue { port: Some(self.port.unwrap_or(port)), ..self }
    }
}

/// See [`Fault::explained`].
pub(super) struct Explained<'a, N: ?Sized> {
    pub fault: Fault,
    pub detail: Option<Detail>,
    pub names: &'a N,
}

impl<N: Names + ?Sized> fmt::Display for Explained<'_, N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Some(detail) = self.detail else { return write!(f, "{}", self.fault) };
        let component = self.names.component(detail.component).path;
        let (name, word) = match detail.subject {
            Subject::Input(port) => (self.names.input_port(detail.component, port), "formula"),
            Subject::Output(port) => (self.names.output_port(detail.component, port), "output"),
            Subject::Entry(entry) => (self.entry(entry), "formula"),
            Subject::State(state) => (self.state(detail.component, state), "state"),
        };
        write!(f, "'{}'", name.name)?;
        if !matches!(detail.subject, Subject::Entry(_)) {
            write!(f, " of '{component}'")?;
        }
        self.value(f, &name, detail.value)?;
        match name.place {
            Some(TextPlace { file, line, column }) => {
                write!(f, "; {word} at {file}:{line}:{column}")
            }
            None => Ok(()),
        }
    }
}

impl<'a, N: Names + ?Sized> Explained<'a, N> {
    fn state(&self, id: ComponentId, state: u16) -> PortName<'a> {
        let name = self.names.outcome(id, Outcome::Declared(state));
        PortName { name, place: self.names.state(id, state), ..PortName::default() }
    }

    fn entry(&self, id: TraceEntryId) -> PortName<'a> {
        let entry = self.names.entry(id);
        PortName {
            name: entry.path,
            ty: "",
            unit: entry.unit,
            range: entry.range,
            place: self.names.initial(id),
            entry: None,
        }
    }

    fn value(
        &self,
        f: &mut fmt::Formatter<'_>,
        name: &PortName<'_>,
        value: Option<f64>,
    ) -> fmt::Result {
        let shown = |value| Shown { value, unit: name.unit, range: name.range };
        match (value, name.range) {
            (Some(value), _) if value.is_nan() => f.write_str(" is not a number"),
            (Some(value), _) if value.is_infinite() => f.write_str(" is infinite"),
            (Some(value), Some((least, _))) if value < least => {
                write!(f, " is {}, at least {}", shown(value), shown(least).beside(value))
            }
            (Some(value), Some((_, greatest))) if value > greatest => {
                write!(f, " is {}, at most {}", shown(value), shown(greatest).beside(value))
            }
            (Some(value), _) if self.fault == Fault::RANGE => {
                write!(f, " is {}, out of its range", shown(value))
            }
            (Some(value), _) => write!(f, " is {}: {}", shown(value), self.fault),
            (None, _) => match name.entry {
                Some(entry) => return write!(f, " does not fit '{entry}': {}", self.fault),
                None => write!(f, ": {}", self.fault),
            },
        }?;
        name.entry.map_or(Ok(()), |entry| write!(f, " for '{entry}'"))
    }
}

/// A value, with every digit if it would otherwise print like a bound that it breaks.
struct Shown<'a> {
    value: f64,
    unit: &'a str,
    range: Option<(f64, f64)>,
}

impl<'a> Shown<'a> {
    /// The bound that a value breaks; zero gets the unit of the value.
    fn beside(self, value: f64) -> impl fmt::Display + 'a {
        let [bound, beside] = [self.value, value].map(|value| Measured::new(value, self.unit));
        fmt::from_fn(move |f| match self.value == 0.0 {
            true => write!(f, "{}", bound.beside(beside)),
            false => write!(f, "{self}"),
        })
    }
}

impl fmt::Display for Shown<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Shown { value, unit, range } = *self;
        let misleads = |bound| Measured::misleads(value, bound, unit);
        if range.is_some_and(|(least, greatest)| misleads(least) || misleads(greatest)) {
            Quantity { value, unit }.fmt(f)
        } else {
            Measured::new(value, unit).fmt(f)
        }
    }
}

#[cfg(test)]
mod tests {
    extern crate std;

    use std::string::ToString;

    use super::Shown;

    #[test]
    fn a_value_never_reads_like_the_bound_that_it_breaks() {
        let shown = |value, unit| Shown { value, unit, range: Some((0.0, 0.3)) }.to_string();
        assert_eq!(shown(0.301, "m"), "30.1 cm");
        assert_eq!(shown(0.300_000_1, "m"), "0.3000001 m");
        assert_eq!(shown(0.3, "m"), "30 cm");
        assert_eq!(shown(2.0, "rad"), "114.592 deg");
        assert_eq!(shown(-1e-9, "V"), "-0.000000001 V");
        let zero = Shown { value: 0.0, unit: "s", range: None };
        assert_eq!(zero.beside(-0.02).to_string(), "0 ms");
    }
}
