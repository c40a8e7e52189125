//! Entries of generated plans.

use core::fmt;

use afp_types::{Text, Value, ValueRef, int_to_float};

use crate::fault::Fault;
use crate::quantity::Quantity;
use crate::rt::write::WriteError;

/// A value of an entry. The default is the value of unset storage.
pub trait Stored: Default {
    /// The value as traced.
    fn as_value(&self) -> ValueRef<'_>;

    /// The value with an owned string; stored strings fit.
    fn to_value(&self) -> Value {
        self.as_value().to_value().unwrap_or_default()
    }

    /// Called once when a commit writes the value, with the commit's number.
    fn committed(&mut self, _commit: u32) {}

    /// Whether a live value is unchanged since it was last passed: by bits, objects by their
    /// commit.
    fn is_still(&self, passed: &Self) -> bool {
        self.as_value().is_same(passed.as_value())
    }
}

/// A type for ports of type `any`.
pub trait Any: Stored + Clone + PartialEq {}

/// A type for ports of type `number`: an `int`, a `float` or a quantity.
pub trait Number: Any + PartialOrd {}

/// A type for ports of type `discrete`: a `bool`, an `int`, a string or an enum.
pub trait Discrete: Any {}

/// A type that can be written from outside.
pub trait Writable: Stored {
    /// Converts a value; an `int` converts to a `float`.
    ///
    /// # Errors
    /// [`WriteError::Type`] or [`WriteError::NotFinite`].
    fn from_value(value: &Value) -> Result<Self, WriteError>;
}

/// An enum of a toolbox or a plan.
pub trait Choice: Copy + Default {
    /// The names of its values, by position.
    const NAMES: &'static [&'static str];

    fn index(self) -> u16;

    fn from_index(index: u16) -> Option<Self>;
}

/// A value, and whether it was written.
#[derive(Clone, Debug, Default)]
pub struct Entry<T> {
    value: T,
    is_set: bool,
}

/// An object entry: empty until written, then identified by the number of the commit that wrote it.
#[derive(Clone)]
pub struct Object<T> {
    value: Option<T>,
    commit: u32,
    /// The commit that identified it before it was committed here.
    source: u32,
}

impl<T: Stored> Entry<T> {
    /// The value; the type's zero while unset.
    #[inline]
    pub fn get(&self) -> &T {
        &self.value
    }

    #[inline]
    pub fn set(&mut self, value: T) {
        self.value = value;
        self.is_set = true;
    }

    pub fn clear(&mut self) {
        *self = Entry::default();
    }

    #[inline]
    pub fn is_set(&self) -> bool {
        self.is_set
    }

    /// The value, unless unset.
    pub fn value(&self) -> Option<&T> {
        self.is_set.then_some(&self.value)
    }

    /// The value as traced.
    pub fn as_value(&self) -> ValueRef<'_> {
        if self.is_set { self.value.as_value() } else { ValueRef::Unset }
    }
}

impl<T> Object<T> {
    /// A new object from the component that made it.
    pub fn new(value: T) -> Self {
        Object { value: Some(value), commit: 0, source: 0 }
    }

    /// Returns the object.
    ///
    /// # Errors
    /// [`Fault::UNSET`] before it was written.
    pub fn get(&self) -> Result<&T, Fault> {
        self.value.as_ref().ok_or(Fault::UNSET)
    }
}

impl<T> Default for Object<T> {
    fn default() -> Self {
        Object { value: None, commit: 0, source: 0 }
    }
}

impl<T> Stored for Object<T> {
    fn as_value(&self) -> ValueRef<'_> {
        ValueRef::Object(self.commit)
    }

    fn committed(&mut self, commit: u32) {
        self.source = self.commit;
        self.commit = commit;
    }

    fn is_still(&self, passed: &Self) -> bool {
        [self.commit, self.source].contains(&passed.commit)
    }
}

impl<T> PartialEq for Object<T> {
    /// Whether the same commit wrote both; only its templates can compare the content.
    fn eq(&self, other: &Self) -> bool {
        self.commit == other.commit
    }
}

impl<T: Clone> Any for Object<T> {}

impl<T> fmt::Debug for Object<T> {
    /// Prints the number; only its templates can read the content.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "object#{}", self.commit)
    }
}

macro_rules! stored {
    ($($ty:ty => $variant:ident),*) => {$(
        impl Stored for $ty {
            #[inline]
            fn as_value(&self) -> ValueRef<'_> {
                ValueRef::$variant(*self)
            }
        }
        impl Any for $ty {}
    )*};
}

stored!(bool => Bool, i64 => Int, f64 => Float);

impl Discrete for bool {}
impl Discrete for i64 {}
impl Discrete for Text {}
impl Discrete for Value {}

impl Number for i64 {}
impl Number for f64 {}

macro_rules! writable {
    ($($ty:ty => $variant:ident),*) => {$(
        impl Writable for $ty {
            fn from_value(value: &Value) -> Result<Self, WriteError> {
                match value {
                    Value::$variant(value) => Ok(Self::clone(value)),
                    _ => Err(WriteError::Type),
                }
            }
        }
    )*};
}

writable!(bool => Bool, i64 => Int, Text => Text);

impl Writable for f64 {
    fn from_value(value: &Value) -> Result<Self, WriteError> {
        match value {
            Value::Int(value) => Ok(int_to_float(*value)),
            Value::Float(value) if value.is_finite() => Ok(*value),
            Value::Float(_) => Err(WriteError::NotFinite),
            _ => Err(WriteError::Type),
        }
    }
}

impl<const M: i8, const KG: i8, const S: i8, const RAD: i8, const K: i8, const V: i8> Writable
    for Quantity<M, KG, S, RAD, K, V>
{
    fn from_value(value: &Value) -> Result<Self, WriteError> {
        f64::from_value(value).map(Self::from_si)
    }
}

impl<const M: i8, const KG: i8, const S: i8, const RAD: i8, const K: i8, const V: i8> Stored
    for Quantity<M, KG, S, RAD, K, V>
{
    #[inline]
    fn as_value(&self) -> ValueRef<'_> {
        ValueRef::Float(self.si())
    }
}

impl<const M: i8, const KG: i8, const S: i8, const RAD: i8, const K: i8, const V: i8> Any
    for Quantity<M, KG, S, RAD, K, V>
{
}

impl<const M: i8, const KG: i8, const S: i8, const RAD: i8, const K: i8, const V: i8> Number
    for Quantity<M, KG, S, RAD, K, V>
{
}

impl Stored for Text {
    fn as_value(&self) -> ValueRef<'_> {
        ValueRef::Text(self.as_str())
    }
}

impl Any for Text {}

impl Stored for Value {
    fn as_value(&self) -> ValueRef<'_> {
        self.as_deref()
    }

    fn committed(&mut self, commit: u32) {
        if let Value::Object(number) = self {
            *number = commit;
        }
    }
}

impl Any for Value {}
impl Number for Value {}
