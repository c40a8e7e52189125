//! Values as they are written on a command line, in a text entry or in a table.

use afp_number::MAX_TEXT;

use crate::toolbox::Constant;
use crate::types::Type;
use afp_syntax::literal::{Literal, LiteralError};

/// Reads a value of type `ty`, as on a command line (`35cm`, `left`, `true`) or from a text entry.
///
/// Numbers and quantities are written as in a plan, with an optional sign, unit included; nothing
/// may follow them. A text stands for itself.
///
/// # Errors
/// Says which rule of the type the text breaks.
pub fn parse_value(text: &str, ty: &Type) -> Result<Constant, LiteralError> {
    match ty {
        Type::Bool => match text.trim() {
            "true" => Ok(Constant::Bool(true)),
            "false" => Ok(Constant::Bool(false)),
            _ => Err(LiteralError::Malformed),
        },
        Type::Int => {
            let literal = Literal::parse(text)?;
            if literal.unit.is_some() || text.contains(['.', 'e', 'E']) {
                return Err(LiteralError::Malformed);
            }
            // White space may stand behind the sign, as in a formula.
            let digits: String = text.split_whitespace().collect();
            digits.parse().map(Constant::Int).map_err(|_| LiteralError::TooLarge)
        }
        Type::Quantity(dimension) => {
            Literal::parse(text)?.quantity(*dimension).map(Constant::Float)
        }
        Type::Text if text.len() > MAX_TEXT => Err(LiteralError::TooLong),
        Type::Text => Ok(Constant::Text(text.to_owned())),
        Type::Enum(home) => {
            let name = text.trim();
            let name = name.strip_prefix(&format!("{}.", home.name)).unwrap_or(name);
            let place = home.variants.iter().position(|variant| variant == name);
            place
                .and_then(|place| u16::try_from(place).ok())
                .map(Constant::Choice)
                .ok_or(LiteralError::UnknownChoice)
        }
        Type::Object(_) | Type::Any | Type::Number | Type::Discrete => Err(LiteralError::NoLiteral),
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::parse_value;
    use crate::toolbox::Constant;
    use crate::types::{Dimension, Enum, Type};
    use afp_syntax::literal::LiteralError;
    use afp_syntax::source::Span;

    #[test]
    fn values_of_each_type_are_read() {
        let length = Type::Quantity(Dimension::named("length").unwrap());
        assert_eq!(parse_value("35cm", &length), Ok(Constant::Float(0.35)));
        assert_eq!(parse_value("35", &length), Err(LiteralError::UnitMissing("cm".to_owned())));
        let seconds = Err(LiteralError::WrongDimension(Dimension::named("duration").unwrap()));
        assert_eq!(parse_value("3 s", &length), seconds);
        assert_eq!(parse_value("3 cmm", &length), Err(LiteralError::UnknownUnit("cmm".to_owned())));
        assert_eq!(
            parse_value("3 cm x", &length),
            Err(LiteralError::UnknownUnit("cm x".to_owned()))
        );
        assert_eq!(parse_value("-7", &Type::Int), Ok(Constant::Int(-7)));
        assert_eq!(parse_value(" - 7 ", &Type::Int), Ok(Constant::Int(-7)));
        assert_eq!(parse_value("7 7", &Type::Int), Err(LiteralError::UnknownUnit("7".to_owned())));
        assert_eq!(parse_value("+7", &Type::Int), Err(LiteralError::Malformed));
        assert_eq!(parse_value("- 3 cm", &length), Ok(Constant::Float(-0.03)));
        assert_eq!(parse_value("-9223372036854775808", &Type::Int), Ok(Constant::Int(i64::MIN)));
        assert_eq!(parse_value("9223372036854775808", &Type::Int), Err(LiteralError::TooLarge));
        assert_eq!(parse_value("7.0", &Type::Int), Err(LiteralError::Malformed));
        assert_eq!(parse_value("7", &Type::FLOAT), Ok(Constant::Float(7.0)));
        assert_eq!(parse_value("true", &Type::Bool), Ok(Constant::Bool(true)));
        assert_eq!(parse_value("1", &Type::Bool), Err(LiteralError::Malformed));
        assert_eq!(parse_value(&"x".repeat(65), &Type::Text), Err(LiteralError::TooLong));
        let side = Type::Enum(Arc::new(Enum {
            name: "Side".to_owned(),
            doc: String::new(),
            toolbox: None,
            variants: vec!["left".to_owned(), "right".to_owned()],
            variant_spans: Vec::new(),
            span: Span::default(),
        }));
        assert_eq!(parse_value("Side.right", &side), Ok(Constant::Choice(1)));
        assert_eq!(parse_value("left", &side), Ok(Constant::Choice(0)));
        assert_eq!(parse_value("up", &side), Err(LiteralError::UnknownChoice));
    }
}
