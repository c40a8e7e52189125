//! Functions that generated formulas call in addition to those of `afp-types`, and the errors of
//! both as faults.

use core::cmp::Ordering;

use afp_types::{Error, Quantity, Text, ValueRef, finite};

use crate::fault::Fault;
use crate::rt::store::Stored;

impl From<Error> for Fault {
    fn from(error: Error) -> Self {
        match error {
            Error::Overflow | Error::DivisionByZero | Error::NotFinite | Error::NoRange => {
                Fault::ARITHMETIC
            }
            Error::TooLong => Fault::TOO_LONG,
            Error::NotAValue => Fault::CONVERSION,
            Error::Unknown | Error::Mistyped => Fault::INTERNAL,
        }
    }
}

/// Checks a divisor. A number divided by infinity is zero, which would hide the fault.
///
/// # Errors
/// [`Error::NotFinite`].
#[inline]
pub fn divisor<T: Stored>(value: T) -> Result<T, Error> {
    if let ValueRef::Float(number) = value.as_value() {
        finite(number)?;
    }
    Ok(value)
}

#[inline]
pub fn order<T: Stored + PartialOrd>(left: &T, right: &T) -> Result<Ordering, Error> {
    for number in [left, right] {
        if let ValueRef::Float(number) = number.as_value() {
            finite(number)?;
        }
    }
    left.partial_cmp(right).ok_or(Error::NotFinite)
}

pub fn join(a: &str, b: &str) -> Result<Text, Error> {
    let mut text = Text::try_from(a)?;
    text.push(b)?;
    Ok(text)
}

/// Formats a quantity: SI value, space, SI unit.
///
/// # Errors
/// [`Error::TooLong`] if it does not fit; [`Error::NotFinite`].
pub fn print_quantity(value: f64, unit: &str) -> Result<Text, Error> {
    Text::print(Quantity { value: finite(value)?, unit })
}
