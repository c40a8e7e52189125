//! Values as the trace, outside writers and loaded plans see them, and the text that an entry holds in place.

use core::cmp::Ordering;
use core::fmt;

use crate::{Error, MAX_TEXT};

/// A text of at most [`MAX_TEXT`] bytes, in place.
#[derive(Clone, Default, PartialEq, Eq)]
pub struct Text(heapless::String<MAX_TEXT>);

/// A value that borrows its text: cheap to pass to a trace.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ValueRef<'a> {
    /// Nobody has written it yet.
    Unset,
    /// A truth value.
    Bool(bool),
    /// An integer.
    Int(i64),
    /// A number or a quantity in SI units.
    Float(f64),
    /// A text.
    Text(&'a str),
    /// A value of an enum, by position.
    Choice(u16),
    /// An object, known by the number of the commit that wrote it.
    Object(u32),
}

/// A value that owns its text.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Value {
    /// Nobody has written it yet.
    #[default]
    Unset,
    /// A truth value.
    Bool(bool),
    /// An integer.
    Int(i64),
    /// A number or a quantity in SI units.
    Float(f64),
    /// A text.
    Text(Text),
    /// A value of an enum, by position.
    Choice(u16),
    /// An object, known by the number of the commit that wrote it.
    Object(u32),
}

impl Text {
    /// The empty text.
    pub const fn new() -> Self {
        Text(heapless::String::new())
    }

    /// The text itself.
    pub fn as_str(&self) -> &str {
        self.0.as_str()
    }

    /// Appends a text.
    ///
    /// # Errors
    /// [`Error::TooLong`] when it does not fit; the text is then as before.
    pub fn push(&mut self, more: &str) -> Result<(), Error> {
        self.0.push_str(more).map_err(|_| Error::TooLong)
    }

    /// A text from anything that prints.
    ///
    /// # Errors
    /// [`Error::TooLong`] when it does not fit.
    pub fn print(value: impl fmt::Display) -> Result<Self, Error> {
        use fmt::Write;
        let mut text = Text::new();
        write!(text.0, "{value}").map_err(|_| Error::TooLong)?;
        Ok(text)
    }
}

impl TryFrom<&str> for Text {
    type Error = Error;

    fn try_from(text: &str) -> Result<Self, Error> {
        let mut new = Text::new();
        new.push(text)?;
        Ok(new)
    }
}

impl fmt::Debug for Text {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Debug::fmt(self.as_str(), f)
    }
}

impl Value {
    /// The same value, its text borrowed.
    pub fn borrow(&self) -> ValueRef<'_> {
        match self {
            Value::Unset => ValueRef::Unset,
            Value::Bool(value) => ValueRef::Bool(*value),
            Value::Int(value) => ValueRef::Int(*value),
            Value::Float(value) => ValueRef::Float(*value),
            Value::Text(value) => ValueRef::Text(value.as_str()),
            Value::Choice(value) => ValueRef::Choice(*value),
            Value::Object(value) => ValueRef::Object(*value),
        }
    }
}

impl ValueRef<'_> {
    /// Whether both are the same, floats by their bits.
    pub fn is_same(self, other: ValueRef<'_>) -> bool {
        match (self, other) {
            (ValueRef::Float(one), ValueRef::Float(other)) => one.to_bits() == other.to_bits(),
            (one, other) => one == other,
        }
    }

    /// The same value, owning its text; one longer than [`MAX_TEXT`], which no plan has, is empty.
    pub fn to_owned(self) -> Value {
        match self {
            ValueRef::Unset => Value::Unset,
            ValueRef::Bool(value) => Value::Bool(value),
            ValueRef::Int(value) => Value::Int(value),
            ValueRef::Float(value) => Value::Float(value),
            ValueRef::Text(value) => Value::Text(Text::try_from(value).unwrap_or_default()),
            ValueRef::Choice(value) => Value::Choice(value),
            ValueRef::Object(value) => Value::Object(value),
        }
    }
}

impl fmt::Display for ValueRef<'_> {
    /// As in a plan, quantities in SI units without the unit, which the entry knows.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            ValueRef::Unset => f.write_str("unset"),
            ValueRef::Bool(value) => write!(f, "{value}"),
            ValueRef::Int(value) => write!(f, "{value}"),
            ValueRef::Float(value) => write!(f, "{value}"),
            ValueRef::Text(value) => write!(f, "{value:?}"),
            ValueRef::Choice(value) => write!(f, "#{value}"),
            ValueRef::Object(value) => write!(f, "object#{value}"),
        }
    }
}

impl PartialOrd for Value {
    /// Numbers of one kind compare; the compiler gives all `number` ports of a component one type.
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        match (self, other) {
            (Value::Int(a), Value::Int(b)) => a.partial_cmp(b),
            (Value::Float(a), Value::Float(b)) => a.partial_cmp(b),
            _ => None,
        }
    }
}
