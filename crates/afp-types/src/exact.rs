//! The double nearest to a decimal number times a unit.
//!
//! `35 cm` is 0.35 and not `35.0 * 0.01`; `0.03 min` is 1.8 s. Multiplication and division work on
//! the digits, and the standard library's correctly rounding parser makes the double. Degrees are
//! the double product with pi/180, since no decimal is exact.

use core::fmt::Write;
use core::num::NonZeroU128;

use heapless::Vec;

/// Radians per degree: numbers in degrees are the double product with this.
pub const RADIANS_PER_DEGREE: f64 = core::f64::consts::PI / 180.0;

/// Significant digits kept: more than the longest exact midpoint of two doubles has (767).
const KEPT: usize = 800;
/// Digits of a 64-bit factor, and leading zeros that a division adds.
const FACTOR: usize = 20;
const ROOM: usize = FACTOR + KEPT + FACTOR;
/// Digits, a sticky digit and an exponent.
const TEXT: usize = ROOM + 16;

/// The conversion from a unit to SI.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scale {
    /// Shift the decimal point.
    Decimal(i32),
    /// Multiply by a fraction and shift the decimal point, exactly. Then multiply by
    /// [`RADIANS_PER_DEGREE`] for each positive exponent of the degree, or divide for each negative
    /// one.
    Fraction {
        /// Numerator.
        times: u64,
        /// Denominator.
        by: u64,
        /// Shift of the decimal point.
        shift: i32,
        /// Exponent of the degree.
        degrees: i32,
    },
    /// Degrees Celsius: add 273.15.
    Celsius,
}

impl Scale {
    /// Makes a [`Scale::Fraction`].
    pub const fn fraction(times: u64, by: u64, shift: i32, degrees: i32) -> Self {
        Scale::Fraction { times, by, shift, degrees }
    }

    /// The simplest scale of a factor.
    pub const fn factor(times: u64, by: u64, shift: i32, degrees: i32) -> Self {
        match (times == by, degrees) {
            (true, 0) => Scale::Decimal(shift),
            _ => Scale::Fraction { times, by, shift, degrees },
        }
    }
}

/// A number as digits, with room in front for the digits that a factor adds.
struct Digits {
    digits: Vec<u8, TEXT>,
    /// Power of ten of the last digit.
    exponent: i32,
    /// Whether a nonzero rest was cut off.
    inexact: bool,
}

/// The double nearest to a number in SI units; `None` if it is not finite. `digits` may begin with
/// zeros.
pub fn exact(
    digits: impl Iterator<Item = u8>,
    exponent: i32,
    negative: bool,
    scale: Scale,
) -> Option<f64> {
    let (times, by, shift, degrees) = match scale {
        Scale::Decimal(shift) => (1, 1, shift, 0),
        Scale::Fraction { times, by, shift, degrees } => (times, by, shift, degrees),
        Scale::Celsius => return celsius(digits, exponent, negative),
    };
    let mut number = Digits::new(digits, exponent.saturating_add(shift));
    number.multiply(times);
    number.divide(by)?;
    let exact = number.value()?;
    let magnitude = (0..degrees.unsigned_abs()).fold(exact, |value, _| match degrees > 0 {
        true => value * RADIANS_PER_DEGREE,
        false => value / RADIANS_PER_DEGREE,
    });
    let value = if negative { -magnitude } else { magnitude };
    value.is_finite().then_some(value)
}

impl Digits {
    fn new(digits: impl Iterator<Item = u8>, exponent: i32) -> Self {
        let mut number = Digits { digits: Vec::new(), exponent, inexact: false };
        // The room in front holds zeros.
        let _ = number.digits.resize(FACTOR, 0);
        for digit in digits.skip_while(|digit| *digit == 0) {
            if number.digits.len() < FACTOR + KEPT {
                let _ = number.digits.push(digit);
            } else {
                number.inexact |= digit != 0;
                number.exponent = number.exponent.saturating_add(1);
            }
        }
        number
    }

    fn multiply(&mut self, times: u64) {
        if times == 1 {
            return;
        }
        let mut carry = 0_u128;
        for digit in self.digits.iter_mut().rev() {
            carry += u128::from(*digit) * u128::from(times);
            *digit = (carry % 10) as u8;
            carry /= 10;
        }
    }

    /// Long division, up to the digit after which the nearest double cannot change. `None` for
    /// zero.
    fn divide(&mut self, by: u64) -> Option<()> {
        let by = NonZeroU128::new(u128::from(by))?;
        if by.get() == 1 {
            return Some(());
        }
        let mut rest = 0_u128;
        for digit in &mut self.digits {
            rest = rest * 10 + u128::from(*digit);
            *digit = (rest / by) as u8;
            rest %= by;
        }
        while rest != 0 && self.digits.len() < ROOM {
            rest *= 10;
            let _ = self.digits.push((rest / by) as u8);
            self.exponent = self.exponent.saturating_sub(1);
            rest %= by;
        }
        self.inexact |= rest != 0;
        Some(())
    }

    /// The nearest double, perhaps infinite.
    fn value(mut self) -> Option<f64> {
        self.digits.iter_mut().for_each(|digit| *digit += b'0');
        if self.inexact {
            // A sticky digit: a value above a midpoint stays above it.
            let _ = self.digits.push(b'1');
            self.exponent = self.exponent.saturating_sub(1);
        }
        write!(self.digits, "e{}", self.exponent).ok()?;
        core::str::from_utf8(&self.digits).ok()?.parse().ok()
    }
}

/// Kelvin, correctly rounded for every number of at most 24 digits.
fn celsius(digits: impl Iterator<Item = u8>, exponent: i32, negative: bool) -> Option<f64> {
    let number = Digits::new(digits, exponent);
    let written = number.digits.get(FACTOR..).unwrap_or(&[]);
    if written.len() <= 24 && (-24..=0).contains(&exponent) {
        let value = written.iter().fold(0_i128, |sum, digit| sum * 10 + i128::from(*digit));
        let signed = if negative { -value } else { value };
        // Both at 10^-26, so that no digit is lost.
        let lift = 10_i128.checked_pow(u32::try_from(exponent + 26).ok()?)?;
        let offset = 27_315 * 10_i128.checked_pow(24)?;
        let sum = signed.checked_mul(lift)?.checked_add(offset)?;
        let mut text: Vec<u8, 64> = Vec::new();
        write!(text, "{sum}e-26").ok()?;
        return core::str::from_utf8(&text).ok()?.parse().ok();
    }
    let plain = number.value()?;
    let value = 273.15 + if negative { -plain } else { plain };
    value.is_finite().then_some(value)
}
