//! What formulas compute and how texts become values: `afp-types`, its errors as faults.
//!
//! Interpreter and generated code call these functions, the compiler the ones behind them.

use afp_types::{Error, Quantity, Text};

use crate::fault::Fault;

pub use afp_types::{
    Scale, Unit, abs, atan2, bool_to_float, bool_to_int, cos, hypot, int_max, int_min,
    int_to_float, max, min, sin, sqrt,
};

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

macro_rules! faulty {
    ($($(#[$doc:meta])* $name:ident($($input:ident: $from:ty),*) -> $to:ty;)*) => {$(
        $(#[$doc])*
        #[inline]
        pub fn $name($($input: $from),*) -> Result<$to, Fault> {
            Ok(afp_types::$name($($input),*)?)
        }
    )*};
}

faulty! {
    /// `a + b`.
    ///
    /// # Errors
    /// [`Fault::ARITHMETIC`] on overflow.
    int_add(a: i64, b: i64) -> i64;
    /// `a - b`.
    ///
    /// # Errors
    /// [`Fault::ARITHMETIC`] on overflow.
    int_sub(a: i64, b: i64) -> i64;
    /// `a * b`.
    ///
    /// # Errors
    /// [`Fault::ARITHMETIC`] on overflow.
    int_mul(a: i64, b: i64) -> i64;
    /// `a % b`, with the sign of `a`.
    ///
    /// # Errors
    /// [`Fault::ARITHMETIC`] for `b` zero, and on overflow.
    int_rem(a: i64, b: i64) -> i64;
    /// `-a`.
    ///
    /// # Errors
    /// [`Fault::ARITHMETIC`] for the least integer.
    int_neg(a: i64) -> i64;
    /// `a` without its sign.
    ///
    /// # Errors
    /// [`Fault::ARITHMETIC`] for the least integer.
    int_abs(a: i64) -> i64;
    /// `value`, but at least `low` and at most `high`.
    ///
    /// # Errors
    /// [`Fault::ARITHMETIC`] when `low` is above `high`.
    int_clamp(value: i64, low: i64, high: i64) -> i64;
    /// `value`, but at least `low` and at most `high`.
    ///
    /// # Errors
    /// [`Fault::ARITHMETIC`] when `low` is above `high`.
    clamp(value: f64, low: f64, high: f64) -> f64;
    /// `a % b` with the sign of `a`.
    ///
    /// # Errors
    /// [`Fault::ARITHMETIC`] for `b` zero.
    rem(a: f64, b: f64) -> f64;
    /// A `float` as an `int`, toward zero.
    ///
    /// # Errors
    /// [`Fault::ARITHMETIC`] for NaN and for values out of range.
    float_to_int(value: f64) -> i64;
    /// `true` or `false` from a text, nothing around it but white space.
    ///
    /// # Errors
    /// [`Fault::CONVERSION`].
    parse_bool(text: &str) -> bool;
    /// An `int` from a text.
    ///
    /// # Errors
    /// [`Fault::CONVERSION`].
    parse_int(text: &str) -> i64;
    /// A `float` from a text.
    ///
    /// # Errors
    /// [`Fault::CONVERSION`].
    parse_float(text: &str) -> f64;
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
    let value = afp_types::finite(value)?;
    Ok(Text::print(Quantity { value, unit })?)
}

/// A number with one of `units` from a text, in SI units, as the same literal in a plan.
///
/// # Errors
/// [`Fault::CONVERSION`].
pub fn parse_quantity<'u>(
    text: &str,
    units: impl IntoIterator<Item = Unit<'u>>,
) -> Result<f64, Fault> {
    Ok(afp_types::parse_quantity(text, units)?)
}

/// A value of an enum from its name, by position.
///
/// # Errors
/// [`Fault::CONVERSION`].
pub fn parse_choice<'n>(
    text: &str,
    names: impl IntoIterator<Item = &'n str>,
) -> Result<u16, Fault> {
    Ok(afp_types::parse_choice(text, names)?)
}
