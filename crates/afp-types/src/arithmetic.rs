//! Operations for which plain operators would panic, wrap or round differently.

use crate::Error;

macro_rules! checked {
    ($($(#[$doc:meta])* $name:ident = $method:ident;)*) => {$(
        $(#[$doc])*
        #[inline]
        pub fn $name(a: i64, b: i64) -> Result<i64, Error> {
            a.$method(b).ok_or(Error::Overflow)
        }
    )*};
}

checked! {
    /// `a + b`.
    ///
    /// # Errors
    /// [`Error::Overflow`].
    int_add = checked_add;
    /// `a - b`.
    ///
    /// # Errors
    /// [`Error::Overflow`].
    int_sub = checked_sub;
    /// `a * b`.
    ///
    /// # Errors
    /// [`Error::Overflow`].
    int_mul = checked_mul;
}

/// `a % b`, with the sign of `a`.
///
/// # Errors
/// [`Error::DivisionByZero`].
#[inline]
pub fn int_rem(a: i64, b: i64) -> Result<i64, Error> {
    match b {
        0 => Err(Error::DivisionByZero),
        // Also for the least integer, whose quotient overflows.
        -1 => Ok(0),
        _ => Ok(a % b),
    }
}

/// `-a`.
///
/// # Errors
/// [`Error::Overflow`] for the least integer.
#[inline]
pub fn int_neg(a: i64) -> Result<i64, Error> {
    a.checked_neg().ok_or(Error::Overflow)
}

/// `a % b` with the sign of `a`.
///
/// # Errors
/// [`Error::DivisionByZero`]; [`Error::NotFinite`] for a `b` that is not finite, for which the
/// result would be `a`.
#[inline]
pub fn rem(a: f64, b: f64) -> Result<f64, Error> {
    if b == 0.0 { Err(Error::DivisionByZero) } else { Ok(a % finite(b)?) }
}

/// Checks that a number is finite.
///
/// # Errors
/// [`Error::NotFinite`].
#[inline]
pub fn finite(value: f64) -> Result<f64, Error> {
    if value.is_finite() { Ok(value) } else { Err(Error::NotFinite) }
}

/// Converts an `int` to a `float`.
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

/// Converts a `float` to an `int`, toward zero.
///
/// # Errors
/// [`Error::Overflow`] for NaN and for values out of range.
#[inline]
pub fn float_to_int(value: f64) -> Result<i64, Error> {
    // -2^63 and 2^63 are doubles; the first is an i64, the second is not.
    let fits = (-9_223_372_036_854_775_808.0..9_223_372_036_854_775_808.0).contains(&value);
    if fits { Ok(value as i64) } else { Err(Error::Overflow) }
}
