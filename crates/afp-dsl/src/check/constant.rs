//! Values of formulas that are known when the plan is compiled.
//!
//! The arithmetic is the run time's: left to right, no fused operations, overflow and a non-finite
//! result are faults.

use crate::graph::{Formula, FormulaKind, Operator};
use crate::toolbox::Constant;
use crate::types::value::{MAX_TEXT, parse_value};
use crate::types::{Conversion, Type};

/// Why a formula has no value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Fault {
    /// An int leaves 64 bits.
    Overflow,
    /// `% 0` on ints.
    DivisionByZero,
    /// The result is infinite or not a number.
    NotFinite,
    /// A text of more than 64 bytes.
    TooLong,
    /// A text is no value of the wanted type.
    NotAValue,
}

/// The value of a formula; `Ok(None)` when it depends on what is known at run time only.
///
/// `entry` gives the values of entries that are known.
///
/// # Errors
/// The fault that the formula would raise whenever it is read.
pub(crate) fn evaluate(
    formula: &Formula,
    entry: &dyn Fn(u16) -> Option<Constant>,
) -> Result<Option<Constant>, Fault> {
    let value = part(formula, entry)?;
    match value {
        Some(Constant::Float(value)) if !value.is_finite() => Err(Fault::NotFinite),
        _ => Ok(value),
    }
}

fn part(
    formula: &Formula,
    entry: &dyn Fn(u16) -> Option<Constant>,
) -> Result<Option<Constant>, Fault> {
    Ok(match &formula.kind {
        FormulaKind::Bool(value) => Some(Constant::Bool(*value)),
        FormulaKind::Int(value) => Some(Constant::Int(*value)),
        FormulaKind::Float(value) => Some(Constant::Float(*value)),
        FormulaKind::Text(text) if text.len() > MAX_TEXT => return Err(Fault::TooLong),
        FormulaKind::Text(text) => Some(Constant::Text(text.clone())),
        FormulaKind::Choice(value) => Some(Constant::Choice(*value)),
        FormulaKind::Entry(id) => entry(id.0),
        FormulaKind::Neg(inner) => match part(inner, entry)? {
            Some(Constant::Int(value)) => {
                Some(Constant::Int(value.checked_neg().ok_or(Fault::Overflow)?))
            }
            Some(Constant::Float(value)) => Some(Constant::Float(-value)),
            _ => None,
        },
        FormulaKind::Binary(operator, left, right) => {
            let (left, right) = (part(left, entry)?, part(right, entry)?);
            binary(*operator, left, right)?
        }
        FormulaKind::Convert(conversion, inner) => match part(inner, entry)? {
            Some(value) => Some(convert(conversion, value)?),
            None => None,
        },
    })
}

fn binary(
    operator: Operator,
    left: Option<Constant>,
    right: Option<Constant>,
) -> Result<Option<Constant>, Fault> {
    if operator == Operator::Rem && right == Some(Constant::Int(0)) {
        return Err(Fault::DivisionByZero);
    }
    Ok(match (left, right) {
        (Some(Constant::Int(left)), Some(Constant::Int(right))) => {
            Some(Constant::Int(integers(operator, left, right)?))
        }
        (Some(Constant::Float(left)), Some(Constant::Float(right))) => {
            Some(Constant::Float(floats(operator, left, right)))
        }
        (Some(Constant::Text(left)), Some(Constant::Text(right))) => {
            let joined = left + &right;
            if joined.len() > MAX_TEXT {
                return Err(Fault::TooLong);
            }
            Some(Constant::Text(joined))
        }
        _ => None,
    })
}

fn integers(operator: Operator, left: i64, right: i64) -> Result<i64, Fault> {
    let value = match operator {
        Operator::Add => left.checked_add(right),
        Operator::Sub => left.checked_sub(right),
        Operator::Mul => left.checked_mul(right),
        Operator::Rem => left.checked_rem(right),
        // Ints are divided as floats; the types of the operands see to it.
        Operator::Div => None,
    };
    value.ok_or(Fault::Overflow)
}

fn floats(operator: Operator, left: f64, right: f64) -> f64 {
    match operator {
        Operator::Add => left + right,
        Operator::Sub => left - right,
        Operator::Mul => left * right,
        Operator::Div => left / right,
        Operator::Rem => left % right,
    }
}

fn convert(conversion: &Conversion, value: Constant) -> Result<Constant, Fault> {
    Ok(match (conversion, value) {
        (Conversion::IntToFloat, Constant::Int(value)) => Constant::Float(value as f64),
        (Conversion::FloatToInt, Constant::Float(value)) => Constant::Int(to_int(value)?),
        (Conversion::BoolToInt, Constant::Bool(value)) => Constant::Int(i64::from(value)),
        (Conversion::BoolToFloat, Constant::Bool(value)) => {
            Constant::Float(if value { 1.0 } else { 0.0 })
        }
        (Conversion::ToText(_), Constant::Float(value)) if !value.is_finite() => {
            return Err(Fault::NotFinite);
        }
        (Conversion::ToText(ty), value) => {
            let text = to_text(&value, ty);
            if text.len() > MAX_TEXT {
                return Err(Fault::TooLong);
            }
            Constant::Text(text)
        }
        (Conversion::FromText(ty), Constant::Text(text)) => {
            parse_value(&text, ty).map_err(|_| Fault::NotAValue)?
        }
        (_, value) => value,
    })
}

/// Toward zero.
fn to_int(value: f64) -> Result<i64, Fault> {
    // 2^63 is a double; every double below it fits.
    let limit = 9_223_372_036_854_775_808.0;
    let whole = value.trunc();
    if (-limit..limit).contains(&whole) { Ok(whole as i64) } else { Err(Fault::Overflow) }
}

/// The text of a value: shortest decimal that reads back as the same number, SI unit behind a
/// quantity, name of an enum's value.
fn to_text(value: &Constant, ty: &Type) -> String {
    match (value, ty) {
        (Constant::Bool(value), _) => value.to_string(),
        (Constant::Int(value), _) => value.to_string(),
        (Constant::Float(value), Type::Quantity(dimension)) => {
            format!("{value} {}", dimension.si_unit()).trim_end().to_owned()
        }
        (Constant::Float(value), _) => value.to_string(),
        (Constant::Text(text), _) => text.clone(),
        (Constant::Choice(place), Type::Enum(home)) => {
            home.variants.get(usize::from(*place)).cloned().unwrap_or_default()
        }
        (Constant::Choice(place), _) => place.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::{Fault, binary, to_int};
    use crate::graph::Operator;
    use crate::toolbox::Constant;

    #[test]
    fn overflow_and_remainder_of_zero_are_faults() {
        let int = |value| Some(Constant::Int(value));
        assert_eq!(binary(Operator::Add, int(i64::MAX), int(1)), Err(Fault::Overflow));
        assert_eq!(binary(Operator::Rem, None, int(0)), Err(Fault::DivisionByZero));
        assert_eq!(binary(Operator::Rem, int(-7), int(3)), Ok(int(-1)));
    }

    #[test]
    fn floats_become_ints_toward_zero() {
        assert_eq!(to_int(-2.9), Ok(-2));
        assert_eq!(to_int(-9_223_372_036_854_775_808.0), Ok(i64::MIN));
        assert_eq!(to_int(9_223_372_036_854_775_808.0), Err(Fault::Overflow));
        assert_eq!(to_int(f64::NAN), Err(Fault::Overflow));
    }
}
