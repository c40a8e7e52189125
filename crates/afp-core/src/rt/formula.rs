//! What formulas compute, where plain operators would panic, wrap or round differently.
//!
//! Interpreter and generated code call the same functions, so they cannot disagree.

use crate::fault::Fault;
use crate::value::Text;

/// A unit that a text may carry.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unit<'a> {
    /// How it is written.
    pub name: &'a str,
    /// How its numbers become SI.
    pub scale: Scale,
}

/// How a number in some unit becomes SI.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Scale {
    /// Shift the decimal point: the result is the double nearest to the exact decimal value.
    Decimal(i8),
    /// Multiply.
    Factor(f64),
    /// Multiply by the first, then divide by the second, as `km/h` needs.
    Ratio(f64, f64),
    /// Add after a decimal shift of nothing, as `degC` needs.
    Offset(f64),
}

macro_rules! checked {
    ($($(#[$doc:meta])* $name:ident = $method:ident;)*) => {$(
        $(#[$doc])*
        ///
        /// # Errors
        /// [`Fault::ARITHMETIC`] on overflow and on division by zero.
        #[inline]
        pub fn $name(a: i64, b: i64) -> Result<i64, Fault> {
            a.$method(b).ok_or(Fault::ARITHMETIC)
        }
    )*};
}

checked! {
    /// `a + b`.
    int_add = checked_add;
    /// `a - b`.
    int_sub = checked_sub;
    /// `a * b`.
    int_mul = checked_mul;
    /// `a % b`, with the sign of `a`.
    int_rem = checked_rem;
}

/// `-a`.
///
/// # Errors
/// [`Fault::ARITHMETIC`] for the least integer.
#[inline]
pub fn int_neg(a: i64) -> Result<i64, Fault> {
    a.checked_neg().ok_or(Fault::ARITHMETIC)
}

/// `a % b` with the sign of `a`.
///
/// # Errors
/// [`Fault::ARITHMETIC`] for `b` zero.
#[inline]
pub fn rem(a: f64, b: f64) -> Result<f64, Fault> {
    if b == 0.0 { Err(Fault::ARITHMETIC) } else { Ok(a % b) }
}

/// An `int` as a `float`.
#[inline]
pub fn int_to_float(value: i64) -> f64 {
    value as f64
}

/// 0 or 1.
#[inline]
pub fn bool_to_int(value: bool) -> i64 {
    i64::from(value)
}

/// 0 or 1.
#[inline]
pub fn bool_to_float(value: bool) -> f64 {
    f64::from(u8::from(value))
}

/// A `float` as an `int`, toward zero.
///
/// # Errors
/// [`Fault::ARITHMETIC`] for NaN and for values out of range.
#[inline]
pub fn float_to_int(value: f64) -> Result<i64, Fault> {
    // -2^63 and 2^63 are doubles; the first is an i64, the second is not.
    let fits = (-9_223_372_036_854_775_808.0..9_223_372_036_854_775_808.0).contains(&value);
    if fits { Ok(value as i64) } else { Err(Fault::ARITHMETIC) }
}

/// Two texts joined.
///
/// # Errors
/// [`Fault::TOO_LONG`] when the result does not fit.
pub fn join(a: &str, b: &str) -> Result<Text, Fault> {
    let mut text = Text::try_from(a)?;
    text.push(b)?;
    Ok(text)
}

/// A quantity as text: SI value, blank, SI unit.
///
/// # Errors
/// [`Fault::TOO_LONG`] when it does not fit; [`Fault::ARITHMETIC`] when it is not finite.
pub fn print_quantity(value: f64, unit: &str) -> Result<Text, Fault> {
    match (value.is_finite(), unit) {
        (false, _) => Err(Fault::ARITHMETIC),
        (true, "") => Text::print(value),
        (true, unit) => Text::print(format_args!("{value} {unit}")),
    }
}

/// `true` or `false` from a text, nothing around it but white space.
///
/// # Errors
/// [`Fault::CONVERSION`].
pub fn parse_bool(text: &str) -> Result<bool, Fault> {
    text.trim().parse().map_err(|_| Fault::CONVERSION)
}

/// An `int` from a text.
///
/// # Errors
/// [`Fault::CONVERSION`].
pub fn parse_int(text: &str) -> Result<i64, Fault> {
    let (sign, digits) = split_sign(text.trim());
    let all_digits = !digits.is_empty() && digits.bytes().all(|byte| byte.is_ascii_digit());
    if !all_digits {
        return Err(Fault::CONVERSION);
    }
    let value: i128 = digits.parse().map_err(|_| Fault::CONVERSION)?;
    i64::try_from(if sign { -value } else { value }).map_err(|_| Fault::CONVERSION)
}

/// A `float` from a text.
///
/// # Errors
/// [`Fault::CONVERSION`].
pub fn parse_float(text: &str) -> Result<f64, Fault> {
    let (negative, rest) = split_sign(text.trim());
    if number_len(rest) < rest.len() {
        return Err(Fault::CONVERSION);
    }
    signed(negative, apply(rest, Scale::Decimal(0))?)
}

/// A number with one of `units` from a text, in SI units: the double nearest to the exact decimal
/// value where the unit is a decimal one.
///
/// # Errors
/// [`Fault::CONVERSION`].
pub fn parse_quantity<'u>(
    text: &str,
    units: impl IntoIterator<Item = Unit<'u>>,
) -> Result<f64, Fault> {
    let (negative, rest) = split_sign(text.trim());
    let (digits, name) = rest.split_at_checked(number_len(rest)).ok_or(Fault::CONVERSION)?;
    let mut units = units.into_iter();
    let unit = units.find(|unit| unit.name == name.trim_start()).ok_or(Fault::CONVERSION)?;
    signed(negative, apply(digits, unit.scale)?)
}

/// A value of an enum from its name, by position.
///
/// # Errors
/// [`Fault::CONVERSION`].
pub fn parse_choice<'n>(
    text: &str,
    names: impl IntoIterator<Item = &'n str>,
) -> Result<u16, Fault> {
    let mut names = names.into_iter();
    let index = names.position(|name| name == text.trim()).ok_or(Fault::CONVERSION)?;
    u16::try_from(index).map_err(|_| Fault::CONVERSION)
}

fn signed(negative: bool, value: f64) -> Result<f64, Fault> {
    match value.is_finite() {
        true if negative => Ok(-value),
        true => Ok(value),
        false => Err(Fault::CONVERSION),
    }
}

/// Splits off a leading minus.
fn split_sign(text: &str) -> (bool, &str) {
    match text.strip_prefix('-') {
        Some(rest) => (true, rest.trim_start()),
        None => (false, text),
    }
}

/// Length of the number literal at the start: digits, perhaps a fraction, perhaps an exponent.
fn number_len(text: &str) -> usize {
    let digits =
        |from: usize| text.bytes().skip(from).take_while(|byte| byte.is_ascii_digit()).count();
    let byte = |at: usize| text.as_bytes().get(at).copied();
    let mut len = digits(0);
    if len > 0 && byte(len) == Some(b'.') && digits(len + 1) > 0 {
        len += 1 + digits(len + 1);
    }
    if len > 0 && matches!(byte(len), Some(b'e' | b'E')) {
        let sign = usize::from(matches!(byte(len + 1), Some(b'+' | b'-')));
        let exponent = digits(len + 1 + sign);
        if exponent > 0 {
            len += 1 + sign + exponent;
        }
    }
    len
}

/// The SI value of a number literal.
fn apply(digits: &str, scale: Scale) -> Result<f64, Fault> {
    let number = |text: &str| text.parse::<f64>().map_err(|_| Fault::CONVERSION);
    match scale {
        Scale::Decimal(0) => number(digits),
        Scale::Decimal(shift) => {
            let (mantissa, exponent) = match digits.split_once(['e', 'E']) {
                Some((mantissa, exponent)) => {
                    (mantissa, exponent.parse::<i32>().map_err(|_| Fault::CONVERSION)?)
                }
                None => (digits, 0),
            };
            let exponent = exponent.saturating_add(i32::from(shift));
            number(Text::print(format_args!("{mantissa}e{exponent}"))?.as_str())
        }
        Scale::Factor(factor) => Ok(number(digits)? * factor),
        Scale::Ratio(times, by) => Ok(number(digits)? * times / by),
        Scale::Offset(offset) => Ok(number(digits)? + offset),
    }
}
