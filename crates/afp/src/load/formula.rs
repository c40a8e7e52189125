//! Evaluates typed formulas on the configuration.
//!
//! The compiler has made every conversion a node of its own, so each function here knows the
//! type of its operands. Anything else would be a bug of the compiler and gives
//! [`Fault::INTERNAL`], not a panic.

use afp_core::rt::{
    bool_to_float, bool_to_int, float_to_int, int_add, int_mul, int_neg, int_rem, int_sub,
    int_to_float, join, print_quantity, rem,
};
use afp_core::{Fault, Text, Value};
use afp_dsl::graph::{Formula, FormulaKind, Operator};
use afp_dsl::toolbox::Constant;
use afp_dsl::types::literal::parse_value;
use afp_dsl::types::{Conversion, Type};

use super::config::Values;

/// The value of a `bool` formula.
pub fn bool(formula: &Formula, values: &Values) -> Result<bool, Fault> {
    match &formula.kind {
        FormulaKind::Bool(value) => Ok(*value),
        FormulaKind::Entry(entry) => match values.get(entry.0) {
            Value::Bool(value) => Ok(*value),
            _ => Err(Fault::INTERNAL),
        },
        FormulaKind::Convert(Conversion::FromText(ty), inner) => match read(ty, inner, values)? {
            Value::Bool(value) => Ok(value),
            _ => Err(Fault::INTERNAL),
        },
        _ => Err(Fault::INTERNAL),
    }
}

/// The value of an `int` formula.
pub fn int(formula: &Formula, values: &Values) -> Result<i64, Fault> {
    match &formula.kind {
        FormulaKind::Int(value) => Ok(*value),
        FormulaKind::Entry(entry) => match values.get(entry.0) {
            Value::Int(value) => Ok(*value),
            _ => Err(Fault::INTERNAL),
        },
        FormulaKind::Neg(inner) => int_neg(int(inner, values)?),
        FormulaKind::Binary(operator, a, b) => {
            let (a, b) = (int(a, values)?, int(b, values)?);
            match operator {
                Operator::Add => int_add(a, b),
                Operator::Sub => int_sub(a, b),
                Operator::Mul => int_mul(a, b),
                Operator::Rem => int_rem(a, b),
                Operator::Div => Err(Fault::INTERNAL),
            }
        }
        FormulaKind::Convert(Conversion::FloatToInt, inner) => float_to_int(float(inner, values)?),
        FormulaKind::Convert(Conversion::BoolToInt, inner) => bool(inner, values).map(bool_to_int),
        FormulaKind::Convert(Conversion::FromText(ty), inner) => match read(ty, inner, values)? {
            Value::Int(value) => Ok(value),
            _ => Err(Fault::INTERNAL),
        },
        _ => Err(Fault::INTERNAL),
    }
}

/// The value of a `float` or quantity formula in SI units; perhaps not finite.
#[inline]
pub fn float(formula: &Formula, values: &Values) -> Result<f64, Fault> {
    match &formula.kind {
        FormulaKind::Float(value) => Ok(*value),
        FormulaKind::Entry(entry) => match values.get(entry.0) {
            Value::Float(value) => Ok(*value),
            _ => Err(Fault::INTERNAL),
        },
        _ => float_node(formula, values),
    }
}

fn float_node(formula: &Formula, values: &Values) -> Result<f64, Fault> {
    match &formula.kind {
        FormulaKind::Neg(inner) => Ok(-float(inner, values)?),
        FormulaKind::Binary(operator, a, b) => {
            let (a, b) = (float(a, values)?, float(b, values)?);
            match operator {
                Operator::Add => Ok(a + b),
                Operator::Sub => Ok(a - b),
                Operator::Mul => Ok(a * b),
                Operator::Div => Ok(a / b),
                Operator::Rem => rem(a, b),
            }
        }
        FormulaKind::Convert(Conversion::IntToFloat, inner) => int(inner, values).map(int_to_float),
        FormulaKind::Convert(Conversion::BoolToFloat, inner) => {
            bool(inner, values).map(bool_to_float)
        }
        FormulaKind::Convert(Conversion::FromText(ty), inner) => match read(ty, inner, values)? {
            Value::Float(value) => Ok(value),
            _ => Err(Fault::INTERNAL),
        },
        _ => Err(Fault::INTERNAL),
    }
}

/// The value of a `string` formula.
pub fn text(formula: &Formula, values: &Values) -> Result<Text, Fault> {
    match &formula.kind {
        FormulaKind::Text(text) => Text::try_from(text.as_str()),
        FormulaKind::Entry(entry) => match values.get(entry.0) {
            Value::Text(text) => Ok(text.clone()),
            _ => Err(Fault::INTERNAL),
        },
        FormulaKind::Binary(Operator::Add, a, b) => {
            let (a, b) = (text(a, values)?, text(b, values)?);
            join(a.as_str(), b.as_str())
        }
        FormulaKind::Convert(Conversion::ToText(from), inner) => {
            print(&value(inner, values)?, from)
        }
        _ => Err(Fault::INTERNAL),
    }
}

/// The value of an enum formula, by position.
pub fn choice(formula: &Formula, values: &Values) -> Result<u16, Fault> {
    match &formula.kind {
        FormulaKind::Choice(value) => Ok(*value),
        FormulaKind::Entry(entry) => match values.get(entry.0) {
            Value::Choice(value) => Ok(*value),
            _ => Err(Fault::INTERNAL),
        },
        FormulaKind::Convert(Conversion::FromText(ty), inner) => match read(ty, inner, values)? {
            Value::Choice(value) => Ok(value),
            _ => Err(Fault::INTERNAL),
        },
        _ => Err(Fault::INTERNAL),
    }
}

/// The value of a formula of any type; of an object, the number of the commit that wrote it.
pub fn value(formula: &Formula, values: &Values) -> Result<Value, Fault> {
    match &formula.ty {
        Type::Bool => bool(formula, values).map(Value::Bool),
        Type::Int => int(formula, values).map(Value::Int),
        Type::Quantity(_) => float(formula, values).map(Value::Float),
        Type::Text => text(formula, values).map(Value::Text),
        Type::Enum(_) => choice(formula, values).map(Value::Choice),
        Type::Object(_) => match &formula.kind {
            FormulaKind::Entry(entry) => Ok(values.get(entry.0).clone()),
            _ => Err(Fault::INTERNAL),
        },
        Type::Any | Type::Number => Err(Fault::INTERNAL),
    }
}

/// The value that an entry may hold: as [`value`], and finite.
pub fn finite(formula: &Formula, values: &Values) -> Result<Value, Fault> {
    check_finite(value(formula, values)?)
}

/// Refuses numbers that are not finite.
pub fn check_finite(value: Value) -> Result<Value, Fault> {
    match value {
        Value::Float(number) if !number.is_finite() => Err(Fault::ARITHMETIC),
        value => Ok(value),
    }
}

/// Converts the value of an output port for its entry.
pub fn convert(conversion: &Conversion, value: Value) -> Result<Value, Fault> {
    match (conversion, value) {
        (Conversion::IntToFloat, Value::Int(value)) => Ok(Value::Float(int_to_float(value))),
        (Conversion::FloatToInt, Value::Float(value)) => float_to_int(value).map(Value::Int),
        (Conversion::BoolToInt, Value::Bool(value)) => Ok(Value::Int(bool_to_int(value))),
        (Conversion::BoolToFloat, Value::Bool(value)) => Ok(Value::Float(bool_to_float(value))),
        (Conversion::ToText(from), value) => print(&value, from).map(Value::Text),
        (Conversion::FromText(ty), Value::Text(text)) => parse(text.as_str(), ty),
        _ => Err(Fault::INTERNAL),
    }
}

fn read(ty: &Type, inner: &Formula, values: &Values) -> Result<Value, Fault> {
    parse(text(inner, values)?.as_str(), ty)
}

fn parse(text: &str, ty: &Type) -> Result<Value, Fault> {
    match parse_value(text, ty) {
        Ok(Constant::Bool(value)) => Ok(Value::Bool(value)),
        Ok(Constant::Int(value)) => Ok(Value::Int(value)),
        Ok(Constant::Float(value)) => Ok(Value::Float(value)),
        Ok(Constant::Text(text)) => Text::try_from(text.as_str()).map(Value::Text),
        Ok(Constant::Choice(value)) => Ok(Value::Choice(value)),
        Err(_) => Err(Fault::CONVERSION),
    }
}

fn print(value: &Value, from: &Type) -> Result<Text, Fault> {
    match (value, from) {
        (Value::Bool(value), _) => Text::print(value),
        (Value::Int(value), _) => Text::print(value),
        (Value::Float(value), Type::Quantity(dimension)) => {
            print_quantity(*value, &dimension.si_unit())
        }
        (Value::Text(text), _) => Ok(text.clone()),
        (Value::Choice(value), Type::Enum(choices)) => {
            let name = choices.variants.get(usize::from(*value)).ok_or(Fault::INTERNAL)?;
            Text::try_from(name.as_str())
        }
        _ => Err(Fault::INTERNAL),
    }
}
