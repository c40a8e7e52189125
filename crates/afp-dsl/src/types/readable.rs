//! The accepted units of strings for quantities at run time.
//!
//! A running plan does not know the grammar of units. For each dimension that it parses, it has a
//! list of all spellings with scales. Interpreter and generated code use the same list.

use afp_types::Scale;

use crate::types::Dimension;
use afp_syntax::units::Unit;

/// Above this number of spellings only the SI unit is accepted.
const MAX_SPELLINGS: usize = 256;

#[derive(Clone, Debug, PartialEq)]
pub struct ReadableUnit {
    pub name: String,
    /// The conversion to SI.
    pub scale: Scale,
}

/// All spellings of a dimension's units; empty for a plain number.
pub fn readable(dimension: Dimension) -> Vec<ReadableUnit> {
    if dimension == Dimension::NONE {
        return Vec::new();
    }
    let singles = Unit::symbols().map(str::to_owned);
    let mut names: Vec<String> = singles.filter(|name| measures(name, dimension)).collect();
    for name in products(dimension) {
        if !names.contains(&name) && measures(&name, dimension) {
            names.push(name);
        }
    }
    let units = names.into_iter().filter_map(|name| {
        let scale = Unit::parse(&name)?.scale();
        Some(ReadableUnit { name, scale })
    });
    units.collect()
}

fn measures(name: &str, dimension: Dimension) -> bool {
    Unit::parse(name).is_some_and(|unit| unit.dimension == dimension)
}

/// Products of single units of the base dimensions: `cm/s^2`.
fn products(dimension: Dimension) -> Vec<String> {
    let bases = [
        ("length", dimension.length),
        ("mass", dimension.mass),
        ("angle", dimension.angle),
        ("temperature", dimension.temperature),
        ("voltage", dimension.voltage),
        ("duration", dimension.time),
    ];
    let mut names = vec![String::new()];
    // Positive exponents first, so that a spelling does not begin with a division.
    for positive in [true, false] {
        for (base, exponent) in bases {
            if exponent == 0 || (exponent > 0) != positive {
                continue;
            }
            let Some(base) = Dimension::named(base) else { continue };
            let symbols: Vec<_> = Unit::symbols().filter(|name| measures(name, base)).collect();
            let joined = |name: &String| {
                symbols.iter().map(|symbol| join(name, symbol, exponent)).collect::<Vec<_>>()
            };
            names = names.iter().flat_map(joined).collect();
        }
    }
    if names.len() > MAX_SPELLINGS { vec![dimension.si_unit()] } else { names }
}

fn join(name: &str, symbol: &str, exponent: i8) -> String {
    match (name, exponent) {
        ("", 1) => symbol.to_owned(),
        ("", _) => format!("{symbol}^{exponent}"),
        (_, 1) => format!("{name}*{symbol}"),
        (_, -1) => format!("{name}/{symbol}"),
        (_, 1..) => format!("{name}*{symbol}^{exponent}"),
        (_, _) => format!("{name}/{symbol}^{}", exponent.unsigned_abs()),
    }
}

#[cfg(test)]
mod tests {
    use super::{Scale, readable};
    use crate::types::Dimension;

    fn scale_of(dimension: &str, name: &str) -> Option<Scale> {
        let units = readable(Dimension::named(dimension).unwrap());
        units.into_iter().find(|unit| unit.name == name).map(|unit| unit.scale)
    }

    #[test]
    fn single_and_composed_units_are_readable() {
        assert_eq!(scale_of("length", "cm"), Some(Scale::Decimal(-2)));
        assert_eq!(scale_of("duration", "min"), Some(Scale::fraction(60, 1, 0, 0)));
        assert_eq!(scale_of("speed", "km/h"), Some(Scale::fraction(1, 3600, 3, 0)));
        assert_eq!(scale_of("acceleration", "m/s^2"), Some(Scale::Decimal(0)));
        assert_eq!(scale_of("temperature", "degC"), Some(Scale::Celsius));
        assert_eq!(scale_of("frequency", "Hz"), Some(Scale::Decimal(0)));
        assert_eq!(scale_of("length", "s"), None);
    }

    #[test]
    fn plain_numbers_have_no_unit() {
        assert!(readable(Dimension::NONE).is_empty());
    }
}
