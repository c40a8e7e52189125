//! Functions that generated formulas call besides those of `afp-types`, and the errors of both as faults.

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

/// The divisor of a quotient. A number divided by infinity is zero, which would hide the fault.
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

/// The order of two numbers.
///
/// # Errors
/// [`Error::NotFinite`] for a number that is not finite.
#[inline]
pub fn order<T: Stored + PartialOrd>(left: &T, right: &T) -> Result<Ordering, Error> {
    for number in [left, right] {
        if let ValueRef::Float(number) = number.as_value() {
            finite(number)?;
        }
    }
    left.partial_cmp(right).ok_or(Error::NotFinite)
}

/// Two texts joined.
///
/// # Errors
/// [`Error::TooLong`] when the result does not fit.
pub fn join(a: &str, b: &str) -> Result<Text, Error> {
    let mut text = Text::try_from(a)?;
    text.push(b)?;
    Ok(text)
}

/// A quantity as text: SI value, blank, SI unit.
///
/// # Errors
/// [`Error::TooLong`] when it does not fit; [`Error::NotFinite`].
pub fn print_quantity(value: f64, unit: &str) -> Result<Text, Error> {
    Text::print(Quantity { value: finite(value)?, unit })
}
