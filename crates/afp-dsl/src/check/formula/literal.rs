//! Numbers and quantities in formulas.

use crate::graph::{Formula, Op};
use crate::types::Type;
use afp_syntax::ast::Name;
use afp_syntax::diagnostics::{Code, Diagnostic, Diagnostics};
use afp_syntax::literal::Literal;
use afp_syntax::source::Span;

/// A number with or without a unit; `inside` if it is an operand.
pub(super) fn number(
    number: &Name,
    unit: Option<&Name>,
    whole: bool,
    span: Span,
    inside: bool,
    diags: &mut Diagnostics,
) -> Option<Formula> {
    if whole && unit.is_none() {
        let Ok(value) = number.text.parse() else {
            let message = "the number does not fit an int";
            diags.push(
                Diagnostic::new(Code::E0115, span, message)
                    .help("write a number below 9223372036854775808, or a float with a point"),
            );
            return None;
        };
        return Some(Formula::new(Op::Int(value), [], Type::Int, span));
    }
    let literal = Literal::of_tokens(&number.text, unit.map(|unit| unit.text.as_str()))?;
    if inside && literal.unit.is_some_and(|unit| unit.celsius) {
        diags.push(
            Diagnostic::new(
                Code::E0235,
                span,
                "formulas cannot compute with a temperature in 'degC'",
            )
            .help("use 'K' in formulas; differences are the same in both"),
        );
        return None;
    }
    let Some(value) = literal.value() else {
        diags.push(
            Diagnostic::new(Code::E0115, span, "the number is too large")
                .help("write a number below 1.8e308"),
        );
        return None;
    };
    let ty = Type::Quantity(literal.dimension());
    Some(Formula::new(Op::Float(value), [], ty, span))
}

/// A number after a minus sign, if it is not just a negation: the smallest int, and degrees
/// Celsius.
pub(super) fn negative(
    number: &Name,
    unit: Option<&Name>,
    whole: bool,
    span: Span,
    inside: bool,
) -> Option<Formula> {
    if whole && unit.is_none() {
        let value: i64 = format!("-{}", number.text).parse().ok()?;
        return (value == i64::MIN).then(|| Formula::new(Op::Int(value), [], Type::Int, span));
    }
    let literal = Literal::of_tokens(&number.text, unit.map(|unit| unit.text.as_str()))?;
    if inside || !literal.unit.is_some_and(|unit| unit.celsius) {
        return None;
    }
    let value = literal.negated().value()?;
    Some(Formula::new(Op::Float(value), [], Type::Quantity(literal.dimension()), span))
}
