//! Values as numbers for curves.

use afp_dsl::types::text::number_in;
use afp_session::Datum;
use afp_syntax::units::Unit;
use serde::Serialize;

/// A number in the usual unit of its quantity, so that all values of an entry have the same unit.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Plotted {
    pub number: f64,
    /// Empty for a plain number.
    pub unit: String,
}

/// Returns a value with its SI unit as a number; `None` for a value that is not one.
pub(crate) fn plotted(value: &Datum, unit: &str) -> Option<Plotted> {
    let plain = |number| Some(Plotted { number, unit: String::new() });
    match value {
        Datum::Bool(truth) => plain(f64::from(u8::from(*truth))),
        Datum::Int(number) => plain(*number as f64),
        Datum::Float(number) => {
            let unit = Unit::parse(unit).map_or_else(String::new, |it| it.dimension.usual_unit());
            Some(Plotted { number: number_in(*number, &unit)?, unit })
        }
        Datum::Unset | Datum::Text(_) | Datum::Choice(_) | Datum::Object(_) => None,
    }
}

#[cfg(test)]
mod tests {
    use super::plotted;
    use afp_session::Datum;

    #[test]
    fn a_quantity_is_plotted_in_its_usual_unit() {
        let shown = |value: Datum, unit: &str| plotted(&value, unit).map(|it| (it.number, it.unit));
        assert_eq!(shown(Datum::Float(0.3), "m"), Some((30.0, "cm".to_owned())));
        assert_eq!(shown(Datum::Float(0.3), ""), Some((0.3, String::new())));
        assert_eq!(shown(Datum::Int(3), ""), Some((3.0, String::new())));
        assert_eq!(shown(Datum::Bool(true), ""), Some((1.0, String::new())));
        assert_eq!(shown(Datum::Text("x".to_owned()), ""), None);
    }
}
