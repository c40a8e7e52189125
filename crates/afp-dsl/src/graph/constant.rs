//! Values of formulas that are known when the plan is compiled.
//!
//! The arithmetic is the run time's (`afp-types`): left to right, no fused operations, overflow and a
//! non-finite result are errors. One thing is stricter: what divides by a constant zero is an error
//! whatever becomes of the quotient.

use afp_types::{
    Error, Quantity, Text, Unit, bool_to_float, bool_to_int, finite, float_to_int, int_add,
    int_mul, int_neg, int_rem, int_sub, int_to_float, parse_bool, parse_choice, parse_float,
    parse_int, parse_quantity, rem,
};

use crate::graph::{Formula, FormulaKind, Function, Operator};
use crate::types::readable::readable;
use crate::types::{Constant, Conversion, Type};

/// The value of a formula; `Ok(None)` when it depends on what is known at run time only.
///
/// `entry` gives the values of entries that are known.
///
/// # Errors
/// What the formula would fail with whenever it is read.
pub(crate) fn evaluate(
    formula: &Formula,
    entry: &dyn Fn(u16) -> Option<Constant>,
) -> Result<Option<Constant>, Error> {
    let value = part(formula, entry)?;
    match value {
        Some(Constant::Float(value)) => Ok(Some(Constant::Float(finite(value)?))),
        _ => Ok(value),
    }
}

fn part(
    formula: &Formula,
    entry: &dyn Fn(u16) -> Option<Constant>,
) -> Result<Option<Constant>, Error> {
    Ok(match &formula.kind {
        FormulaKind::Bool(value) => Some(Constant::Bool(*value)),
        FormulaKind::Int(value) => Some(Constant::Int(*value)),
        FormulaKind::Float(value) => Some(Constant::Float(*value)),
        FormulaKind::Text(text) => Some(Constant::try_from(text.as_str())?),
        FormulaKind::Choice(value) => Some(Constant::Choice(*value)),
        FormulaKind::Entry(id) => entry(id.0),
        FormulaKind::Neg(inner) => match part(inner, entry)? {
            Some(Constant::Int(value)) => Some(Constant::Int(int_neg(value)?)),
            Some(Constant::Float(value)) => Some(Constant::Float(-value)),
            _ => None,
        },
        FormulaKind::Binary(operator, left, right) => {
            let (left, right) = (part(left, entry)?, part(right, entry)?);
            binary(*operator, left, right)?
        }
        FormulaKind::Call(function, operands) => {
            let values = operands.iter().map(|operand| part(operand, entry));
            call(*function, &values.collect::<Result<Vec<_>, _>>()?)?
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
) -> Result<Option<Constant>, Error> {
    let zero = matches!(right, Some(Constant::Int(0))) || right == Some(Constant::Float(0.0));
    if zero && matches!(operator, Operator::Div | Operator::Rem) {
        return Err(Error::DivisionByZero);
    }
    Ok(match (left, right) {
        (Some(Constant::Int(left)), Some(Constant::Int(right))) => {
            Some(Constant::Int(integers(operator, left, right)?))
        }
        (Some(Constant::Float(left)), Some(Constant::Float(right))) => {
            Some(Constant::Float(floats(operator, left, right)?))
        }
        (Some(Constant::Text(mut text)), Some(Constant::Text(right))) => {
            text.push(&right)?;
            Some(Constant::Text(text))
        }
        _ => None,
    })
}

fn call(function: Function, operands: &[Option<Constant>]) -> Result<Option<Constant>, Error> {
    // Bounds the wrong way round are wrong for every value.
    if let (Function::Clamp, [None, low @ Some(_), high]) = (function, operands) {
        call(function, &[low.clone(), low.clone(), high.clone()])?;
    }
    let (mut ints, mut floats) = ([0; 3], [0.0; 3]);
    let (mut whole, mut broken) = (0, 0);
    for (index, operand) in operands.iter().enumerate().take(3) {
        match operand {
            Some(Constant::Int(value)) => (ints[index], whole) = (*value, whole + 1),
            Some(Constant::Float(value)) => (floats[index], broken) = (*value, broken + 1),
            _ => return Ok(None),
        }
    }
    Ok(match (whole == operands.len(), broken == operands.len()) {
        (true, _) => Some(Constant::Int(function.of_ints(ints)?)),
        (_, true) => Some(Constant::Float(function.of_floats(floats)?)),
        _ => None,
    })
}

fn integers(operator: Operator, left: i64, right: i64) -> Result<i64, Error> {
    match operator {
        Operator::Add => int_add(left, right),
        Operator::Sub => int_sub(left, right),
        Operator::Mul => int_mul(left, right),
        Operator::Rem => int_rem(left, right),
        // Ints are divided as floats; the types of the operands see to it.
        Operator::Div => Err(Error::Overflow),
    }
}

fn floats(operator: Operator, left: f64, right: f64) -> Result<f64, Error> {
    Ok(match operator {
        Operator::Add => left + right,
        Operator::Sub => left - right,
        Operator::Mul => left * right,
        Operator::Div => left / right,
        Operator::Rem => rem(left, right)?,
    })
}

/// The value that a conversion makes of another one.
///
/// # Errors
/// What the conversion would fail with.
pub(crate) fn convert(conversion: &Conversion, value: Constant) -> Result<Constant, Error> {
    Ok(match (conversion, value) {
        (Conversion::IntToFloat, Constant::Int(value)) => Constant::Float(int_to_float(value)),
        (Conversion::FloatToInt, Constant::Float(value)) => Constant::Int(float_to_int(value)?),
        (Conversion::BoolToInt, Constant::Bool(value)) => Constant::Int(bool_to_int(value)),
        (Conversion::BoolToFloat, Constant::Bool(value)) => Constant::Float(bool_to_float(value)),
        (Conversion::ToText(ty), value) => Constant::Text(to_text(value, ty)?),
        (Conversion::FromText(ty), Constant::Text(text)) => from_text(&text, ty)?,
        (_, value) => value,
    })
}

/// The text of a value: shortest decimal that reads back as the same number, SI unit behind a
/// quantity, name of an enum's value.
fn to_text(value: Constant, ty: &Type) -> Result<Text, Error> {
    match (value, ty) {
        (Constant::Float(value), ty) => {
            let unit = match ty {
                Type::Quantity(dimension) => dimension.si_unit(),
                _ => String::new(),
            };
            Text::print(Quantity { value: finite(value)?, unit: &unit })
        }
        (Constant::Text(text), _) => Ok(text),
        (Constant::Choice(index), Type::Enum(choices)) => {
            choices.variants.get(usize::from(index)).map_or("", |name| name).try_into()
        }
        (value, _) => Text::print(value),
    }
}

/// The value of a text, as it is read at run time.
fn from_text(text: &str, ty: &Type) -> Result<Constant, Error> {
    match ty {
        Type::Bool => parse_bool(text).map(Constant::Bool),
        Type::Int => parse_int(text).map(Constant::Int),
        &Type::FLOAT => parse_float(text).map(Constant::Float),
        Type::Quantity(dimension) => {
            let units = readable(*dimension);
            let units = units.iter().map(|unit| Unit { name: &unit.name, scale: unit.scale });
            parse_quantity(text, units).map(Constant::Float)
        }
        Type::Text => Constant::try_from(text),
        Type::Enum(choices) => {
            let names = choices.variants.iter().map(String::as_str);
            parse_choice(text, names).map(Constant::Choice)
        }
        Type::Object(_) | Type::Any | Type::Number | Type::Discrete => Err(Error::NotAValue),
    }
}

#[cfg(test)]
mod tests {
    use super::{Error, binary, call};
    use crate::graph::{Function, Operator};
    use crate::types::Constant;

    #[test]
    fn what_divides_by_a_constant_zero_fails_whatever_is_divided() {
        let int = |value| Some(Constant::Int(value));
        let float = |value| Some(Constant::Float(value));
        for operator in [Operator::Div, Operator::Rem] {
            for zero in [int(0), float(0.0), float(-0.0)] {
                assert_eq!(binary(operator, None, zero), Err(Error::DivisionByZero));
            }
        }
        assert_eq!(binary(Operator::Mul, None, int(0)), Ok(None));
        assert_eq!(binary(Operator::Add, int(i64::MAX), int(1)), Err(Error::Overflow));
        assert_eq!(binary(Operator::Rem, int(-7), int(3)), Ok(int(-1)));
    }

    #[test]
    fn bounds_the_wrong_way_round_fail_whatever_is_between() {
        let int = |value| Some(Constant::Int(value));
        assert_eq!(call(Function::Clamp, &[None, int(2), int(1)]), Err(Error::NoRange));
        assert_eq!(call(Function::Clamp, &[None, int(1), int(2)]), Ok(None));
        assert_eq!(call(Function::Clamp, &[None, None, int(2)]), Ok(None));
        assert_eq!(call(Function::Clamp, &[int(7), int(1), int(2)]), Ok(int(2)));
    }
}
