//! Numbers with an invalid prefix of the unit, and numbers with a moved point.

use crate::kind::Kind;
use crate::parser::Parser;
use crate::units::Unit;

impl Parser<'_, '_> {
    /// `5 mHz`, `5 Mm`: the full name of the unit, and the number with a valid unit.
    pub(in crate::parser) fn strange_prefix(&self) -> Option<(String, String)> {
        let (prefixed, unit, places) = Unit::strange_prefix(self.word(0))?;
        let before = self.before()?;
        let is_number = matches!(before.kind, Kind::Int | Kind::Float);
        is_number.then(|| (prefixed, format!("{} {unit}", moved(before.text, places))))
    }
}

/// A hundredth of a number in its notation: `0.5` for `50`.
pub(super) fn hundredth(number: &str) -> String {
    let mantissa = number.find(['e', 'E']).unwrap_or(number.len());
    let (number, exponent) = number.split_at(mantissa);
    let moved = moved(number, -2);
    let point = if moved.contains('.') { "" } else { ".0" };
    format!("{moved}{point}{exponent}")
}

/// Moves the point of a number to the right.
fn moved(number: &str, places: i32) -> String {
    let mantissa = number.find(['e', 'E']).unwrap_or(number.len());
    let (number, exponent) = number.split_at(mantissa);
    let (whole, fraction) = number.split_once('.').unwrap_or((number, ""));
    let many = places.unsigned_abs() as usize;
    let (whole, fraction) = match places < 0 {
        true => {
            let digits = format!("{whole:0>width$}", width = many + 1);
            let (whole, moved) = digits.split_at(digits.len() - many);
            (whole.to_owned(), format!("{moved}{fraction}"))
        }
        false => {
            let digits = format!("{fraction:0<many$}");
            let (moved, fraction) = digits.split_at(many);
            (format!("{whole}{moved}"), fraction.to_owned())
        }
    };
    let whole = Some(whole.trim_start_matches('0')).filter(|it| !it.is_empty()).unwrap_or("0");
    match fraction.trim_end_matches('0') {
        "" => format!("{whole}{exponent}"),
        fraction => format!("{whole}.{fraction}{exponent}"),
    }
}

#[cfg(test)]
mod tests {
    use super::{hundredth, moved};

    #[test]
    fn decimal_points_move() {
        assert_eq!(hundredth("50"), "0.5");
        assert_eq!(hundredth("100"), "1.0");
        assert_eq!(hundredth("2.5e3"), "0.025e3");
        assert_eq!(moved("5", -3), "0.005");
        assert_eq!(moved("0.25", 6), "250000");
        assert_eq!(moved("1234.5", 3), "1234500");
        assert_eq!(moved("1.23456", 3), "1234.56");
    }
}
