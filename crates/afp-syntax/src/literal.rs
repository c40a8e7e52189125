//! Literals of numbers and quantities, and their exact values.
//!
//! The value equals that of the same text at run time: the nearest double (`afp-types`).

use afp_types::{Decimal, Scale, exact, number_length};

use crate::dimension::Dimension;
use crate::units::Unit;

/// A number with or without a unit, before conversion to a double.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Literal {
    negative: bool,
    /// Decimal digits without leading zeros, most significant first.
    digits: Vec<u8>,
    /// The power of ten of the last digit.
    exponent: i32,
    pub unit: Option<Unit>,
}

impl Literal {
    /// A number and its unit as in the tree, foreign spellings of units included; `None` if the
    /// unit is invalid.
    pub fn of_tokens(number: &str, unit: Option<&str>) -> Option<Literal> {
        let mut literal = match number.contains(',') {
            true => Literal::parse(&number.replace(',', "."))?,
            false => Literal::parse(number)?,
        };
        literal.unit = match unit {
            Some(unit) => Some(Unit::of_token(unit)?),
            None => None,
        };
        Some(literal)
    }

    /// Reads an optional sign, a number and an optional unit, with optional white space before the
    /// unit and at both ends. `None` for any other text.
    pub fn parse(text: &str) -> Option<Literal> {
        let text = text.trim();
        let (negative, text) = match text.strip_prefix('-') {
            Some(rest) => (true, rest.trim_start()),
            None => (false, text),
        };
        let (number, unit) = text.split_at(number_length(text));
        let number = Decimal::parse(number)?;
        let unit = match unit.trim_start() {
            "" => None,
            unit => Some(Unit::parse(unit)?),
        };
        let digits = number.digits().skip_while(|digit| *digit == 0).collect();
        Some(Literal { negative, digits, exponent: number.exponent(), unit })
    }

    pub fn negated(&self) -> Literal {
        Literal { negative: !self.negative, ..self.clone() }
    }

    pub fn dimension(&self) -> Dimension {
        self.unit.map_or(Dimension::NONE, |unit| unit.dimension)
    }

    /// The double nearest to its value in SI units; `None` if that is infinite.
    pub fn value(&self) -> Option<f64> {
        let scale = self.unit.map_or(Scale::Decimal(0), Unit::scale);
        exact(self.digits.iter().copied(), self.exponent, self.negative, scale)
    }

    /// The value in nanoseconds; `None` if it is negative, not whole or too large.
    pub fn nanoseconds(&self) -> Option<u64> {
        let unit = self.unit.filter(|unit| unit.dimension == Dimension::DURATION)?;
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
}

#[cfg(test)]
mod tests;
