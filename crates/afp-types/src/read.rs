//! Parsing of values, and printing of quantities.

use core::fmt;

use crate::Error;
use crate::decimal::{Decimal, number_length};
use crate::exact::Scale;

/// A unit that a string may contain.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Unit<'a> {
    /// The symbol.
    pub name: &'a str,
    /// The conversion to SI.
    pub scale: Scale,
}

/// A quantity as text: SI value, space, SI unit.
#[derive(Clone, Copy, Debug)]
pub struct Quantity<'a> {
    /// The value in SI units.
    pub value: f64,
    /// The SI unit; empty for a plain number.
    pub unit: &'a str,
}

impl fmt::Display for Quantity<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // Both zeros print the same.
        let value = self.value + 0.0;
        match self.unit {
            "" => write!(f, "{value}"),
            unit => write!(f, "{value} {unit}"),
        }
    }
}

/// Parses `true` or `false`, with optional surrounding white space.
///
/// # Errors
/// [`Error::NotAValue`].
pub fn parse_bool(text: &str) -> Result<bool, Error> {
    text.trim().parse().map_err(|_| Error::NotAValue)
}

/// Parses an `int`.
///
/// # Errors
/// [`Error::NotAValue`].
pub fn parse_int(text: &str) -> Result<i64, Error> {
    let (sign, digits) = split_sign(text.trim());
    let all_digits = !digits.is_empty() && digits.bytes().all(|byte| byte.is_ascii_digit());
    if !all_digits {
        return Err(Error::NotAValue);
    }
    let value: i128 = digits.parse().map_err(|_| Error::NotAValue)?;
    i64::try_from(if sign { -value } else { value }).map_err(|_| Error::NotAValue)
}

/// Parses a `float`.
///
/// # Errors
/// [`Error::NotAValue`].
pub fn parse_float(text: &str) -> Result<f64, Error> {
    let (negative, rest) = split_sign(text.trim());
    value(rest, negative, Scale::Decimal(0))
}

/// Parses a number with one of `units`, like the literal in a plan; returns SI units.
///
/// # Errors
/// [`Error::NotAValue`].
pub fn parse_quantity<'u>(
    text: &str,
    units: impl IntoIterator<Item = Unit<'u>>,
) -> Result<f64, Error> {
    let (negative, rest) = split_sign(text.trim());
    let (number, name) = rest.split_at_checked(number_length(rest)).ok_or(Error::NotAValue)?;
    let mut units = units.into_iter();
    let unit = units.find(|unit| unit.name == name.trim_start()).ok_or(Error::NotAValue)?;
    value(number, negative, unit.scale)
}

/// Parses the name of an enum value; returns its position.
///
/// # Errors
/// [`Error::NotAValue`].
pub fn parse_choice<'n>(
    text: &str,
    names: impl IntoIterator<Item = &'n str>,
) -> Result<u16, Error> {
    let mut names = names.into_iter();
    let index = names.position(|name| name == text.trim()).ok_or(Error::NotAValue)?;
    u16::try_from(index).map_err(|_| Error::NotAValue)
}

fn value(number: &str, negative: bool, scale: Scale) -> Result<f64, Error> {
    let number = Decimal::parse(number).ok_or(Error::NotAValue)?;
    number.value(negative, scale).ok_or(Error::NotAValue)
}

/// Splits off a leading minus.
fn split_sign(text: &str) -> (bool, &str) {
    match text.strip_prefix('-') {
        Some(rest) => (true, rest.trim_start()),
        None => (false, text),
    }
}
