//! Conversions between types, with the units and names that they need.

use afp_types::{
    Error, Quantity, Scale, Text, Unit, Value, bool_to_float, bool_to_int, finite, float_to_int,
    int_to_float, parse_bool, parse_choice, parse_float, parse_int, parse_quantity,
};

use super::readable::readable;
use super::{Conversion, Dimension, Type};

/// A prepared conversion.
pub enum Converter {
    IntToFloat,
    FloatToInt,
    BoolToInt,
    BoolToFloat,
    /// Prints a quantity with its SI unit.
    PrintQuantity(String),
    PrintChoice(Vec<String>),
    /// Prints other values without a unit.
    Print,
    ReadBool,
    ReadInt,
    ReadFloat,
    ReadQuantity(Vec<(String, Scale)>),
    ReadChoice(Vec<String>),
    ReadText,
    /// The checker rejects such a conversion.
    Never,
}

impl Converter {
    pub fn new(conversion: &Conversion) -> Self {
        match conversion {
            Conversion::IntToFloat => Converter::IntToFloat,
            Conversion::FloatToInt => Converter::FloatToInt,
            Conversion::BoolToInt => Converter::BoolToInt,
            Conversion::BoolToFloat => Converter::BoolToFloat,
            Conversion::ToText(from) => match from {
                Type::Quantity(dimension) => Converter::PrintQuantity(dimension.si_unit()),
                Type::Enum(choices) => Converter::PrintChoice(choices.variants.clone()),
                _ => Converter::Print,
            },
            Conversion::FromText(to) => match to {
                Type::Bool => Converter::ReadBool,
                Type::Int => Converter::ReadInt,
                Type::Text => Converter::ReadText,
                &Type::FLOAT => Converter::ReadFloat,
                Type::Quantity(dimension) => Converter::ReadQuantity(spellings(*dimension)),
                Type::Enum(choices) => Converter::ReadChoice(choices.variants.clone()),
                Type::Object(_) | Type::Any | Type::Number | Type::Discrete => Converter::Never,
            },
        }
    }

    /// Converts a value.
    ///
    /// # Errors
    /// Those of the conversion.
    pub fn convert(&self, value: Value) -> Result<Value, Error> {
        match (self, value) {
            (Converter::IntToFloat, Value::Int(value)) => Ok(Value::Float(int_to_float(value))),
            (Converter::FloatToInt, Value::Float(value)) => float_to_int(value).map(Value::Int),
            (Converter::BoolToInt, Value::Bool(value)) => Ok(Value::Int(bool_to_int(value))),
            (Converter::BoolToFloat, Value::Bool(value)) => Ok(Value::Float(bool_to_float(value))),
            (_, Value::Text(text)) => self.read(text),
            (_, value) => self.print(&value).map(Value::Text),
        }
    }

    fn print(&self, value: &Value) -> Result<Text, Error> {
        match (self, value) {
            (Converter::PrintQuantity(unit), Value::Float(value)) => {
                Text::print(Quantity { value: finite(*value)?, unit })
            }
            (Converter::PrintChoice(names), Value::Choice(value)) => {
                let name = names.get(usize::from(*value)).ok_or(Error::Mistyped)?;
                Text::try_from(name.as_str())
            }
            (Converter::Print, Value::Bool(value)) => Text::print(value),
            (Converter::Print, Value::Int(value)) => Text::print(value),
            _ => Err(Error::Mistyped),
        }
    }

    fn read(&self, text: Text) -> Result<Value, Error> {
        let read = text.as_str();
        match self {
            Converter::ReadBool => parse_bool(read).map(Value::Bool),
            Converter::ReadInt => parse_int(read).map(Value::Int),
            Converter::ReadFloat => parse_float(read).map(Value::Float),
            Converter::ReadQuantity(units) => {
                let units = units.iter().map(|(name, scale)| Unit { name, scale: *scale });
                parse_quantity(read, units).map(Value::Float)
            }
            Converter::ReadChoice(names) => {
                parse_choice(read, names.iter().map(String::as_str)).map(Value::Choice)
            }
            Converter::ReadText | Converter::Print => Ok(Value::Text(text)),
            _ => Err(Error::Mistyped),
        }
    }
}

/// The accepted units of a string for a quantity of this dimension.
pub fn spellings(dimension: Dimension) -> Vec<(String, Scale)> {
    readable(dimension).into_iter().map(|unit| (unit.name, unit.scale)).collect()
}
