//! Numbers and quantities as they are written, and the exact value they stand for.
//!
//! The value is that of the same text at run time: the double nearest to it (`afp-number`).

use afp_number::{Decimal, Scale, exact, number_length};

use crate::dimension::Dimension;
use crate::units::Unit;

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
        let (number, unit_text) = text.split_at(number_length(text));
        let number = Decimal::parse(number).ok_or(LiteralError::Malformed)?;
        let unit_text = unit_text.trim_start();
        let unit = match unit_text {
            "" => None,
            _ => Some(
                Unit::parse(unit_text)
                    .ok_or_else(|| LiteralError::UnknownUnit(unit_text.to_owned()))?,
            ),
        };
        let digits = number.digits().skip_while(|digit| *digit == 0).collect();
        Ok(Literal { negative, digits, exponent: number.exponent(), unit })
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
        let scale = self.unit.map_or(Scale::Decimal(0), Unit::scale);
        exact(self.digits.iter().copied(), self.exponent, self.negative, scale)
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
}

#[cfg(test)]
mod tests;
