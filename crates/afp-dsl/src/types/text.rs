//! Types and values as text: with an article for sentences, and in the syntax of literals.
//!
//! A quantity in SI units is written with the unit that makes it shortest and reads back as exactly
//! the same double.

use crate::types::{Dimension, Type};
use afp_syntax::diagnostics::words;
use afp_syntax::literal::Literal;
use afp_syntax::units::Unit;
use afp_types::{Nanoseconds, RADIANS_PER_DEGREE, Rounded};

/// A value in SI units with the unit that makes the text shortest. Of two equally short units, the
/// usual one.
///
/// ```
/// use afp_dsl::types::text::quantity;
/// use afp_dsl::types::Dimension;
///
/// let length = Dimension::named("length").unwrap();
/// assert_eq!(quantity(0.3, length), "30 cm");
/// assert_eq!(quantity(100.0, length), "100 m");
/// ```
pub fn quantity(value: f64, dimension: Dimension) -> String {
    if dimension == Dimension::NONE {
        return number(value);
    }
    let singles = Unit::symbols().map(str::to_owned);
    let units = [dimension.usual_unit(), dimension.si_unit()].into_iter().chain(singles);
    let texts = units.filter_map(|unit| in_unit(value, dimension, &unit));
    let shortest = texts.min_by_key(String::len);
    shortest.unwrap_or_else(|| format!("{} {}", number(value), dimension.si_unit()))
}

/// The value of a unit's step from 0 to 1, in SI units; `None` for an unknown unit. The empty unit
/// is that of a plain number.
pub fn worth(unit: &str) -> Option<f64> {
    Some(si_value(1.0, unit)? - si_value(0.0, unit)?).filter(|one| *one > 0.0)
}

/// A number in a unit as a value in SI units.
pub fn si_value(value: f64, unit: &str) -> Option<f64> {
    Literal::parse(&format!("{} {unit}", number(value)))?.value()
}

/// A value in SI units as a number in a unit, with ten significant digits.
pub fn number_in(value: f64, unit: &str) -> Option<f64> {
    let exact = (value - si_value(0.0, unit)?) / worth(unit)?;
    format!("{exact:.9e}").parse().ok()
}

/// An exact time in usual units: `20 s`, `1.5 ms`.
pub fn duration(nanoseconds: u64) -> String {
    Nanoseconds(nanoseconds).to_string()
}

/// A plain number in the syntax of literals.
pub fn number(value: f64) -> String {
    let plain = value.to_string();
    let short = format!("{value:e}");
    if plain.len() > 12 && short.len() < plain.len() { short } else { plain }
}

fn in_unit(value: f64, dimension: Dimension, unit_text: &str) -> Option<String> {
    let unit = Unit::parse(unit_text)?;
    if unit.dimension != dimension || unit.celsius {
        return None;
    }
    let mut factor = unit.numerator as f64 / unit.denominator as f64;
    let power = 10_f64.powi(unit.exponent.abs());
    factor = if unit.exponent < 0 { factor / power } else { factor * power };
    for _ in 0..unit.degrees.unsigned_abs() {
        factor *= if unit.degrees > 0 { RADIANS_PER_DEGREE } else { 1.0 / RADIANS_PER_DEGREE };
    }
    // Fifteen digits usually undo the rounding of the division; the code checks it.
    let rounded: f64 = format!("{:.14e}", value / factor).parse().ok()?;
    let text = format!("{} {unit_text}", number(rounded));
    let back = Literal::parse(&text).filter(|it| it.dimension() == dimension)?.value()?;
    (back == value).then_some(text)
}

/// A type with its article, such as `a length` or `an int`.
pub(crate) fn a_type(ty: &Type) -> String {
    match ty {
        Type::Bool => "a bool".to_owned(),
        Type::Int => "an int".to_owned(),
        Type::Quantity(dimension) => a_dimension(*dimension),
        Type::Text => "a text".to_owned(),
        Type::Enum(home) => format!("a value of '{}'", home.name),
        Type::Object(home) => format!("a '{}'", home.name),
        Type::Any => "a value".to_owned(),
        Type::Number => "a number".to_owned(),
        Type::Discrete => "a bool, int, string or value of an enum".to_owned(),
    }
}

/// A value in a formula, such as `a length`; for a generic type `a value of type 'any'`.
pub(crate) fn a_value(ty: &Type) -> String {
    match ty.is_generic() {
        true => format!("a value of type '{ty}'"),
        false => a_type(ty),
    }
}

/// A type in the spelling of a plan; for a generic type a type that fits.
pub(crate) fn written(ty: &Type) -> String {
    match ty {
        Type::Bool => "bool".to_owned(),
        Type::Int => "int".to_owned(),
        Type::Text => "string".to_owned(),
        Type::Quantity(dimension) if *dimension != Dimension::NONE => dimension.name().to_string(),
        Type::Enum(_) | Type::Object(_) => ty.declared_name().to_owned(),
        _ => "float".to_owned(),
    }
}

/// A dimension with its article; without a dimension, a bare number.
pub(crate) fn a_dimension(dimension: Dimension) -> String {
    if dimension == Dimension::NONE {
        return "a bare number".to_owned();
    }
    words::a(&dimension.name())
}

/// A value in SI units for messages, such as `31 cm/s` or `2 km`: exact if that is short, otherwise
/// rounded and in the usual unit.
pub(crate) fn value(value: f64, ty: &Type) -> String {
    let dimension = match ty {
        Type::Quantity(dimension) => dimension,
        // The limits of an int are ints.
        Type::Int => return (value as i64).to_string(),
        _ => return Rounded(value, DECIMALS).to_string(),
    };
    let exact = quantity(value, *dimension);
    // Zero is equally short in each unit.
    if exact.len() <= SHORT && value != 0.0 {
        return exact;
    }
    let symbol = dimension.usual_unit();
    let one = Literal::parse(&format!("1 {symbol}"));
    let factor = one.and_then(|literal| literal.value()).unwrap_or(1.0);
    format!("{} {symbol}", Rounded(value / factor, DECIMALS)).trim_end().to_owned()
}

/// The number of letters above which an exact value is the result of a calculation.
const SHORT: usize = 14;
/// The decimals of such a value.
const DECIMALS: usize = 9;

#[cfg(test)]
mod tests {
    use super::{quantity, value};
    use crate::types::{Dimension, Type};

    #[test]
    fn quantities_get_a_unit_that_suits_their_size() {
        for (name, value, expected) in [
            ("length", 0.3, "30 cm"),
            ("length", 0.35, "35 cm"),
            ("length", -100.0, "-100 m"),
            ("length", 0.002, "2 mm"),
            ("angle", -60.0 * core::f64::consts::PI / 180.0, "-60 deg"),
            ("speed", 0.2, "20 cm/s"),
            ("duration", 0.001, "1 ms"),
            ("duration", 2.5, "2.5 s"),
            ("force", 3.0, "3 N"),
            ("float", 1.5, "1.5"),
        ] {
            let dimension = Dimension::named(name).unwrap_or(Dimension::NONE);
            assert_eq!(quantity(value, dimension), expected);
        }
    }

    #[test]
    fn a_value_without_a_short_decimal_keeps_all_its_digits() {
        let length = Dimension::named("length").unwrap();
        let shown = quantity(1.0 / 3.0, length);
        assert!(shown.contains("33333333333333"), "{shown}");
    }

    #[test]
    fn values_are_shown_in_usual_units() {
        let shown = |number, dimension| {
            value(number, &Type::Quantity(Dimension::named(dimension).unwrap()))
        };
        assert_eq!(shown(0.31, "speed"), "31 cm/s");
        assert_eq!(shown(2.0, "speed"), "2 m/s");
        assert_eq!(shown(0.3, "length"), "30 cm");
        assert_eq!(shown(1.0, "length"), "1 m");
        assert_eq!(shown(2000.0, "length"), "2 km");
        assert_eq!(shown(-2.5, "length"), "-2.5 m");
        assert_eq!(shown(2.0 / 3.0, "length"), "66.666666667 cm");
        assert_eq!(shown(0.0, "length"), "0 cm");
        assert_eq!(shown(0.02, "duration"), "20 ms");
        assert_eq!(shown(60.0, "duration"), "60 s");
        assert_eq!(shown(std::f64::consts::FRAC_PI_2, "angle"), "90 deg");
        assert_eq!(shown(std::f64::consts::TAU, "angle"), "360 deg");
        assert_eq!(value(2.5, &Type::FLOAT), "2.5");
    }
}
