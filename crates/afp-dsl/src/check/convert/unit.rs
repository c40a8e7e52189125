//! Missing units of bare numbers.
//!
//! The intended unit is unknown. If number and range allow only one, the fix is an edit; otherwise
//! the message lists the likely units.

use super::bracketed;
use crate::graph::{Formula, Op};
use crate::types::Dimension;
use crate::types::text::a_dimension;
use afp_syntax::diagnostics::{Code, Diagnostic, Words, words};
use afp_syntax::literal::Literal;
use afp_syntax::message;
use afp_syntax::source::Span;
use afp_syntax::units::Unit;

/// Common units, each with its likely minimum and maximum number.
const UNITS: &[(&str, f64, f64)] = &[
    ("cm", 1.0, f64::INFINITY),
    ("m", 0.0, 15.0),
    ("deg", 0.0, f64::INFINITY),
    ("rad", 0.01, 6.3),
    ("s", 0.0, 60.0),
    ("ms", 10.0, f64::INFINITY),
    ("cm/s", 1.0, f64::INFINITY),
    ("m/s", 0.0, 3.0),
    ("deg/s", 0.0, f64::INFINITY),
    ("rad/s", 0.01, 6.3),
];

/// Likely units of a number; `range` has the minimum and maximum of valid values, in SI units.
pub(crate) fn likely(number: &str, dimension: Dimension, range: Option<(f64, f64)>) -> Vec<String> {
    let (sign, digits) = match number.strip_prefix('-') {
        Some(digits) => (-1.0, digits.trim_start()),
        None => (1.0, number),
    };
    let value = |text: &str| Literal::parse(text).and_then(|literal| literal.value());
    let magnitude = value(digits);
    let of_dimension =
        |unit: &str| Unit::parse(unit).is_some_and(|unit| unit.dimension == dimension);
    let fits = |unit: &str| {
        let value = value(&format!("{digits} {unit}"));
        let (Some(value), Some((least, greatest))) = (value, range) else { return true };
        (least..=greatest).contains(&(sign * value))
    };
    let usual = |(_, least, greatest): &&(&'static str, f64, f64)| {
        magnitude.is_none_or(|magnitude| (*least..=*greatest).contains(&magnitude))
    };
    let all = || UNITS.iter().filter(|(unit, ..)| of_dimension(unit));
    let fitting = || all().filter(|(unit, ..)| fits(unit));
    let mut found: Vec<_> = fitting().filter(usual).collect();
    if found.is_empty() {
        found = fitting().collect();
    }
    if found.is_empty() {
        found = all().collect();
    }
    match found.is_empty() {
        true => vec![dimension.usual_unit()],
        false => found.into_iter().map(|(unit, ..)| (*unit).to_owned()).collect(),
    }
}

/// Reports a number without a unit, with the likely quantities; a single one as an edit.
pub(crate) fn bare(span: Span, dimension: Dimension, better: &[String]) -> Diagnostic {
    let message = message!("expected {}, found a bare number", Words(a_dimension(dimension)));
    let list = words::list(better.iter().map(String::as_str), "or");
    let error =
        Diagnostic::new(Code::E0203, span, message).help(message!("write {}", Words(&list)));
    match better {
        [better] => error.replace(better.as_str()),
        _ => error,
    }
}

/// Reports a bare number instead of a quantity; `range` is that of its target, or `None` for an
/// operand.
pub(crate) fn unit_missing(
    formula: &Formula,
    dimension: Dimension,
    range: Option<Option<(f64, f64)>>,
    text: &str,
) -> Diagnostic {
    let number = match formula.op() {
        Op::Neg => formula.part().operand(),
        _ => Some(formula.part()),
    };
    let literal = number.is_some_and(|number| matches!(number.op(), Op::Int(_) | Op::Float(_)));
    let better: Vec<_> = match literal {
        true => {
            let mut units = likely(text, dimension, range.flatten());
            // Only outside of operands, which are differences.
            if range.is_some() && units == ["K"] {
                units.insert(0, "degC".to_owned());
            }
            units.iter().map(|unit| format!("{text} {unit}")).collect()
        }
        false => {
            let whole = bracketed(formula, text);
            let units = likely("x", dimension, None);
            units.iter().map(|unit| format!("{whole} * 1 {unit}")).collect()
        }
    };
    let mut error = bare(formula.span, dimension, &better);
    // Either operand may be wrong, so an entry gets no fix.
    if matches!(formula.op(), Op::Entry(_)) {
        error.fix = None;
    }
    error
}
