//! Values of literals.

use std::sync::Arc;

use super::{Literal, LiteralError, parse_value};
use crate::source::Span;
use crate::toolbox::Constant;
use crate::types::units::RADIANS_PER_DEGREE;
use crate::types::{Dimension, Enum, Type};

fn value(text: &str) -> f64 {
    Literal::parse(text).unwrap().value().unwrap()
}

#[test]
fn centimetres_are_the_nearest_double_of_the_decimal() {
    assert_eq!(value("35 cm"), 0.35);
    for centimetres in 0..1000_u32 {
        let metres: f64 =
            format!("{}.{:02}", centimetres / 100, centimetres % 100).parse().unwrap();
        assert_eq!(value(&format!("{centimetres} cm")), metres);
    }
}

#[test]
fn degrees_are_the_double_product() {
    assert_eq!(value("90 deg"), 90.0 * RADIANS_PER_DEGREE);
    assert_eq!(value("-0.1 deg"), -(0.1 * RADIANS_PER_DEGREE));
    assert_eq!(value("45 deg/s"), 45.0 * RADIANS_PER_DEGREE);
}

#[test]
fn fractions_are_rounded_once() {
    assert_eq!(value("36 km/h"), 10.0);
    assert_eq!(value("1 km/h"), 0.277_777_777_777_777_8);
    assert_eq!(value("0.1 min"), 6.0);
    assert_eq!(value("1 m/h"), 1.0 / 3600.0);
}

#[test]
fn celsius_has_an_offset() {
    assert_eq!(value("20 degC"), 293.15);
    assert_eq!(value("-5 degC"), 268.15);
    assert_eq!(value("0.01 degC"), 273.16);
}

#[test]
fn exponents_work_and_overflow_is_told() {
    assert_eq!(value("1e3"), 1000.0);
    assert_eq!(value("2.5E-1 m"), 0.25);
    assert_eq!(value("1e-99999999999"), 0.0);
    assert_eq!(Literal::parse("1e400").unwrap().value(), None);
}

#[test]
fn times_are_whole_nanoseconds() {
    let nanoseconds = |text: &str| Literal::parse(text).unwrap().nanoseconds();
    assert_eq!(nanoseconds("1 ms"), Some(1_000_000));
    assert_eq!(nanoseconds("2.5 us"), Some(2_500));
    assert_eq!(nanoseconds("1.5 min"), Some(90_000_000_000));
    assert_eq!(nanoseconds("0.5 ns"), None);
    assert_eq!(nanoseconds("1 m"), None);
    assert_eq!(nanoseconds("-1 s"), None);
    assert_eq!(nanoseconds("1e30 s"), None);
}

#[test]
fn values_of_each_type_are_read() {
    let length = Type::Quantity(Dimension::named("length").unwrap());
    assert_eq!(parse_value("35cm", &length), Ok(Constant::Float(0.35)));
    assert_eq!(parse_value("35", &length), Err(LiteralError::UnitMissing("cm".to_owned())));
    let seconds = Err(LiteralError::WrongDimension(Dimension::named("duration").unwrap()));
    assert_eq!(parse_value("3 s", &length), seconds);
    assert_eq!(parse_value("3 cmm", &length), Err(LiteralError::UnknownUnit("cmm".to_owned())));
    assert_eq!(parse_value("3 cm x", &length), Err(LiteralError::UnknownUnit("cm x".to_owned())));
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
