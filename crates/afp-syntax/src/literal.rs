//! Numbers and quantities as they are written, and the exact value they stand for.
//!
//! A literal becomes the double nearest to its exact decimal value in SI units: `35 cm` is 0.35,
//! not `35.0 * 0.01`. Degrees are the double product with pi/180, since no decimal is exact there.

use crate::dimension::Dimension;
use crate::units::{RADIANS_PER_DEGREE, Unit};

/// A number with or without a unit, not yet a double.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Literal {
    negative: bool,
    /// Decimal digits without leading zeros, most significant first.
    digits: Vec<u8>,
    /// Power of ten of the last digit.
    exponent: i32,
    /// The unit, where one is written.
    pub unit: Option<Unit>,
}

/// Why a text is no value of the wanted type.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum LiteralError {
    /// It is not written like a value of the type.
    Malformed,
    /// It has no unit; the usual one is given.
    UnitMissing(String),
    /// It has another dimension, which is given.
    WrongDimension(Dimension),
    /// Its unit is not in the list.
    UnknownUnit(String),
    /// It is too large for the type.
    TooLarge,
    /// It is none of the enum's values.
    UnknownChoice,
    /// A text of more than 64 bytes.
    TooLong,
    /// The type has no literals.
    NoLiteral,
}

/// Digits of a quotient that decide every double: the longest exact midpoint has fewer than 770.
const QUOTIENT_DIGITS: usize = 800;

impl Literal {
    /// A number and its unit as they stand in the tree, foreign spellings of units included; `None`
    /// where the unit is none.
    pub fn of_tokens(number: &str, unit: Option<&str>) -> Option<Literal> {
        let mut literal = Literal::parse(&number.replace(',', ".")).ok()?;
        literal.unit = match unit {
            Some(unit) => Some(Unit::of_token(unit)?),
            None => None,
        };
        Some(literal)
    }

    /// Reads an optional sign, a number and an optional unit; white space may stand between number
    /// and unit and at both ends.
    ///
    /// # Errors
    /// [`LiteralError::Malformed`] or [`LiteralError::UnknownUnit`].
    pub fn parse(text: &str) -> Result<Literal, LiteralError> {
        let text = text.trim();
        let (negative, text) = match text.strip_prefix('-') {
            Some(rest) => (true, rest.trim_start()),
            None => (false, text),
        };
        let length = number_length(text).ok_or(LiteralError::Malformed)?;
        let unit_text = text[length..].trim_start();
        let unit = match unit_text {
            "" => None,
            _ => Some(
                Unit::parse(unit_text)
                    .ok_or_else(|| LiteralError::UnknownUnit(unit_text.to_owned()))?,
            ),
        };
        Ok(Literal::new(negative, &text[..length], unit))
    }

    /// A number that is written well and its unit.
    fn new(negative: bool, number: &str, unit: Option<Unit>) -> Literal {
        let (mantissa, power) = number.split_once(['e', 'E']).unwrap_or((number, "0"));
        let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
        // An exponent beyond 32 bits means zero or infinity, as does the greatest one inside.
        let power = power.parse::<i64>().map_or_else(
            |_| if power.starts_with('-') { -1_000_000 } else { 1_000_000 },
            |power| power.clamp(-1_000_000, 1_000_000) as i32,
        );
        let fraction_length = i32::try_from(fraction.len()).unwrap_or(i32::MAX);
        let digits = whole.bytes().chain(fraction.bytes()).map(|byte| byte - b'0');
        let digits = digits.skip_while(|digit| *digit == 0).collect();
        Literal { negative, digits, exponent: power.saturating_sub(fraction_length), unit }
    }

    /// The same number with the other sign.
    pub fn negated(&self) -> Literal {
        Literal { negative: !self.negative, ..self.clone() }
    }

    /// The value in SI units, when it has the wanted dimension.
    ///
    /// # Errors
    /// [`LiteralError::UnitMissing`], [`LiteralError::WrongDimension`], [`LiteralError::TooLarge`].
    pub fn quantity(&self, dimension: Dimension) -> Result<f64, LiteralError> {
        match self.unit {
            None if dimension != Dimension::NONE => {
                Err(LiteralError::UnitMissing(dimension.usual_unit()))
            }
            Some(unit) if unit.dimension != dimension => {
                Err(LiteralError::WrongDimension(unit.dimension))
            }
            _ => self.value().ok_or(LiteralError::TooLarge),
        }
    }

    /// The dimension of its unit.
    pub fn dimension(&self) -> Dimension {
        self.unit.map_or(Dimension::NONE, |unit| unit.dimension)
    }

    /// The double nearest to its value in SI units; `None` when that is infinite.
    pub fn value(&self) -> Option<f64> {
        let magnitude = match self.unit {
            Some(unit) if unit.celsius => return self.celsius(),
            Some(unit) => {
                let exact = nearest(&self.scaled(unit), self.exponent + unit.exponent);
                (0..unit.degrees.unsigned_abs()).fold(exact, |value, _| {
                    if unit.degrees > 0 {
                        value * RADIANS_PER_DEGREE
                    } else {
                        value / RADIANS_PER_DEGREE
                    }
                })
            }
            None => nearest(&Quotient::whole(self.digits.clone()), self.exponent),
        };
        let value = if self.negative { -magnitude } else { magnitude };
        value.is_finite().then_some(value)
    }

    /// The value in nanoseconds when it is a whole, non-negative number of them that fits.
    pub fn nanoseconds(&self) -> Option<u64> {
        let unit = self.unit.filter(|unit| unit.dimension.name() == "duration")?;
        let mut value: u128 = 0;
        for digit in &self.digits {
            value = value.checked_mul(10)?.checked_add(u128::from(*digit))?;
        }
        if value == 0 {
            return Some(0);
        }
        value = value.checked_mul(u128::from(unit.numerator))?;
        let shift = self.exponent.checked_add(unit.exponent)?.checked_add(9)?;
        let power = 10_u128.checked_pow(shift.unsigned_abs())?;
        let divisor = u128::from(unit.denominator);
        let (above, below) = if shift >= 0 {
            (value.checked_mul(power)?, divisor)
        } else {
            (value, divisor.checked_mul(power)?)
        };
        if self.negative || !above.is_multiple_of(below) {
            return None;
        }
        u64::try_from(above / below).ok()
    }

    /// The digits times the unit's fraction.
    fn scaled(&self, unit: Unit) -> Quotient {
        Quotient::divide(multiply(&self.digits, unit.numerator), unit.denominator)
    }

    /// Kelvin, exactly rounded for every literal of at most 24 digits.
    fn celsius(&self) -> Option<f64> {
        let offset = 27315_i128;
        if self.digits.len() <= 24 && (-24..=0).contains(&self.exponent) {
            let digits =
                self.digits.iter().fold(0_i128, |sum, digit| sum * 10 + i128::from(*digit));
            let signed = if self.negative { -digits } else { digits };
            // Both at 10^-26, so that no digit of either is lost.
            let lift = 10_i128.checked_pow(u32::try_from(self.exponent + 26).ok()?)?;
            let sum = signed.checked_mul(lift)?.checked_add(offset * 10_i128.pow(24))?;
            return format!("{sum}e-26").parse().ok();
        }
        let plain = nearest(&Quotient::whole(self.digits.clone()), self.exponent);
        let value = 273.15 + if self.negative { -plain } else { plain };
        value.is_finite().then_some(value)
    }
}

/// The length of the number at the start of `text`: `12`, `2.5`, `1e-3`; `None` without one.
pub(crate) fn number_length(text: &str) -> Option<usize> {
    let digits = |from: usize| text[from..].bytes().take_while(u8::is_ascii_digit).count();
    let mut length = digits(0);
    if length == 0 {
        return None;
    }
    if text[length..].starts_with('.') && digits(length + 1) > 0 {
        length += 1 + digits(length + 1);
    }
    if text[length..].starts_with(['e', 'E']) {
        let sign = usize::from(text[length + 1..].starts_with(['+', '-']));
        let power = digits(length + 1 + sign);
        if power > 0 {
            length += 1 + sign + power;
        }
    }
    Some(length)
}

/// Decimal digits, how many of them stand behind the point, and whether more were cut off.
struct Quotient {
    digits: Vec<u8>,
    behind: i32,
    inexact: bool,
}

impl Quotient {
    fn whole(digits: Vec<u8>) -> Quotient {
        Quotient { digits, behind: 0, inexact: false }
    }

    /// Long division, far enough that one more digit cannot change the nearest double.
    fn divide(digits: Vec<u8>, divisor: u64) -> Quotient {
        if divisor == 1 {
            return Quotient::whole(digits);
        }
        let divisor = u128::from(divisor);
        let mut quotient = Quotient::whole(Vec::with_capacity(digits.len()));
        let mut rest = 0_u128;
        for digit in digits {
            rest = rest * 10 + u128::from(digit);
            quotient.digits.push((rest / divisor) as u8);
            rest %= divisor;
        }
        for _ in 0..QUOTIENT_DIGITS {
            if rest == 0 {
                break;
            }
            rest *= 10;
            quotient.digits.push((rest / divisor) as u8);
            quotient.behind += 1;
            rest %= divisor;
        }
        quotient.inexact = rest != 0;
        quotient
    }
}

/// The double nearest to `quotient * 10^exponent`.
fn nearest(quotient: &Quotient, exponent: i32) -> f64 {
    let mut text: String = quotient.digits.iter().map(|digit| char::from(b'0' + digit)).collect();
    let mut exponent = i64::from(exponent) - i64::from(quotient.behind);
    if quotient.inexact {
        // Stands for everything cut off: a value above a midpoint stays above it.
        text.push('1');
        exponent -= 1;
    }
    if text.is_empty() {
        return 0.0;
    }
    // The standard library rounds decimal text of any length correctly.
    format!("{text}e{exponent}").parse().unwrap_or(f64::INFINITY)
}

fn multiply(digits: &[u8], factor: u64) -> Vec<u8> {
    if factor == 1 {
        return digits.to_vec();
    }
    let mut product = Vec::with_capacity(digits.len() + 20);
    let mut carry = 0_u128;
    for digit in digits.iter().rev() {
        carry += u128::from(*digit) * u128::from(factor);
        product.push((carry % 10) as u8);
        carry /= 10;
    }
    while carry > 0 {
        product.push((carry % 10) as u8);
        carry /= 10;
    }
    product.reverse();
    product
}

#[cfg(test)]
mod tests;
