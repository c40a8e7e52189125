//! Values of the language, and the fixed-size string of entries.
//!
//! Compiler, scheduler, trace and logs share the kinds of values. They differ in the representation
//! of strings, enum values and objects.

use core::cmp::Ordering;
use core::fmt;
use core::ops::Deref;

use crate::{Error, MAX_TEXT, Measured};

/// A string of at most [`MAX_TEXT`] bytes, stored inline.
#[derive(Clone, Default, PartialEq, Eq, Hash)]
pub struct Text(heapless::String<MAX_TEXT>);

/// A value: a string is held as `T`, an enum value as `C`, an object as `O`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum ValueOf<T, C = u16, O = u32> {
    /// Not yet written.
    #[default]
    Unset,
    /// A truth value.
    Bool(bool),
    /// An integer.
    Int(i64),
    /// A number or a quantity in SI units.
    Float(f64),
    /// A string.
    Text(T),
    /// A value of an enum: its position or its name.
    Choice(C),
    /// An object: the number of the commit that wrote it, or that number with the name of its type.
    Object(O),
}

/// A value that owns its string.
pub type Value = ValueOf<Text>;

/// A value that borrows its string: cheap to pass to a trace.
pub type ValueRef<'a> = ValueOf<&'a str>;

impl Text {
    /// The empty string.
    pub const fn new() -> Self {
        Text(heapless::String::new())
    }

    /// The string slice.
    pub fn as_str(&self) -> &str {
        self.0.as_str()
    }

    /// Appends a string.
    ///
    /// # Errors
    /// [`Error::TooLong`] if it does not fit; the string is then unchanged.
    pub fn push(&mut self, more: &str) -> Result<(), Error> {
        self.0.push_str(more).map_err(|_| Error::TooLong)
    }

    /// Formats a value.
    ///
    /// # Errors
    /// [`Error::TooLong`] if it does not fit.
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

impl Deref for Text {
    type Target = str;

    fn deref(&self) -> &str {
        self.as_str()
    }
}

impl AsRef<str> for Text {
    fn as_ref(&self) -> &str {
        self
    }
}

impl PartialEq<str> for Text {
    fn eq(&self, other: &str) -> bool {
        self.as_str() == other
    }
}

impl PartialEq<&str> for Text {
    fn eq(&self, other: &&str) -> bool {
        self.as_str() == *other
    }
}

impl fmt::Debug for Text {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Debug::fmt(self.as_str(), f)
    }
}

impl fmt::Display for Text {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self)
    }
}

impl<T, C, O> ValueOf<T, C, O> {
    /// Converts the string, choice or object.
    pub fn map<U, D, P>(
        self,
        text: impl FnOnce(T) -> U,
        choice: impl FnOnce(C) -> D,
        object: impl FnOnce(O) -> P,
    ) -> ValueOf<U, D, P> {
        let (text, choice) = (|it| Some(text(it)), |it| Some(choice(it)));
        self.try_map(text, choice, |it| Some(object(it))).unwrap_or_default()
    }

    /// Converts the string, choice or object; `None` if that fails.
    pub fn try_map<U, D, P>(
        self,
        text: impl FnOnce(T) -> Option<U>,
        choice: impl FnOnce(C) -> Option<D>,
        object: impl FnOnce(O) -> Option<P>,
    ) -> Option<ValueOf<U, D, P>> {
        Some(match self {
            ValueOf::Unset => ValueOf::Unset,
            ValueOf::Bool(value) => ValueOf::Bool(value),
            ValueOf::Int(value) => ValueOf::Int(value),
            ValueOf::Float(value) => ValueOf::Float(value),
            ValueOf::Text(value) => ValueOf::Text(text(value)?),
            ValueOf::Choice(value) => ValueOf::Choice(choice(value)?),
            ValueOf::Object(value) => ValueOf::Object(object(value)?),
        })
    }

    /// Formats the value; a number is in the SI unit `unit`, empty for none.
    pub fn in_unit<'a>(&'a self, unit: &'a str) -> impl fmt::Display + 'a
    where
        Self: fmt::Display,
    {
        fmt::from_fn(move |f| match self {
            ValueOf::Float(number) => write!(f, "{}", Measured::new(*number, unit)),
            other => write!(f, "{other}"),
        })
    }

    /// Writes the value as in a plan; a quantity in SI units without the unit.
    fn write(
        &self,
        f: &mut fmt::Formatter<'_>,
        choice: impl FnOnce(&C, &mut fmt::Formatter<'_>) -> fmt::Result,
        object: impl FnOnce(&O, &mut fmt::Formatter<'_>) -> fmt::Result,
    ) -> fmt::Result
    where
        T: AsRef<str>,
    {
        match self {
            ValueOf::Unset => f.write_str("unset"),
            ValueOf::Bool(value) => write!(f, "{value}"),
            ValueOf::Int(value) => write!(f, "{value}"),
            ValueOf::Float(value) => write!(f, "{}", value + 0.0),
            ValueOf::Text(value) => write!(f, "{:?}", value.as_ref()),
            ValueOf::Choice(value) => choice(value, f),
            ValueOf::Object(value) => object(value, f),
        }
    }
}

impl Value {
    /// Borrows the string.
    pub fn as_deref(&self) -> ValueRef<'_> {
        match self {
            Value::Unset => ValueRef::Unset,
            Value::Bool(value) => ValueRef::Bool(*value),
            Value::Int(value) => ValueRef::Int(*value),
            Value::Float(value) => ValueRef::Float(*value),
            Value::Text(value) => ValueRef::Text(value),
            Value::Choice(value) => ValueRef::Choice(*value),
            Value::Object(value) => ValueRef::Object(*value),
        }
    }
}

impl ValueRef<'_> {
    /// Whether both are identical, floats by their bits.
    pub fn is_same(self, other: ValueRef<'_>) -> bool {
        match (self, other) {
            (ValueRef::Float(one), ValueRef::Float(other)) => one.to_bits() == other.to_bits(),
            (one, other) => one == other,
        }
    }

    /// Copies the string.
    ///
    /// # Errors
    /// [`Error::TooLong`] for a string that no entry can hold.
    pub fn to_value(self) -> Result<Value, Error> {
        self.try_map(|text| text.try_into().ok(), Some, Some).ok_or(Error::TooLong)
    }
}

impl<T: AsRef<str>> fmt::Display for ValueOf<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.write(f, |choice, f| write!(f, "#{choice}"), |object, f| write!(f, "object#{object}"))
    }
}

impl<S: AsRef<str>> fmt::Display for ValueOf<S, S, S> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let name = |name: &S, f: &mut fmt::Formatter<'_>| f.write_str(name.as_ref());
        self.write(f, name, name)
    }
}

impl<T, C, O> From<bool> for ValueOf<T, C, O> {
    fn from(value: bool) -> Self {
        ValueOf::Bool(value)
    }
}

impl<T, C, O> From<i64> for ValueOf<T, C, O> {
    fn from(value: i64) -> Self {
        ValueOf::Int(value)
    }
}

impl<T, C, O> From<f64> for ValueOf<T, C, O> {
    fn from(value: f64) -> Self {
        ValueOf::Float(value)
    }
}

impl From<Text> for Value {
    fn from(text: Text) -> Self {
        Value::Text(text)
    }
}

impl TryFrom<&str> for Value {
    type Error = Error;

    fn try_from(text: &str) -> Result<Self, Error> {
        Text::try_from(text).map(Value::Text)
    }
}

impl<'a> From<&'a str> for ValueRef<'a> {
    fn from(text: &'a str) -> Self {
        ValueRef::Text(text)
    }
}

impl PartialOrd for Value {
    /// Compares numbers of one kind; the compiler gives all `number` ports of a component one type.
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        match (self, other) {
            (Value::Int(a), Value::Int(b)) => a.partial_cmp(b),
            (Value::Float(a), Value::Float(b)) => a.partial_cmp(b),
            _ => None,
        }
    }
}
