//! Operations and the dimensions of their results.

use super::Scope;
use crate::check::convert::{remark, unit_missing};
use crate::graph::{Formula, Op, Operator};
use crate::types::text::{a_dimension, a_value};
use crate::types::{Conversion, Dimension, Type};
use afp_syntax::ast::Sign;
use afp_syntax::diagnostics::{Code, Diagnostic, Diagnostics, Words};
use afp_syntax::message;
use afp_syntax::source::Span;

/// `left operator right`
pub(super) fn binary(
    scope: &Scope<'_>,
    sign: Sign,
    left: Formula,
    right: Formula,
    diags: &mut Diagnostics,
) -> Option<Formula> {
    if sign.operator == Operator::Add && (left.ty == Type::Text || right.ty == Type::Text) {
        let (left, right) = (to_text(left, diags), to_text(right, diags));
        return Some(join(Operator::Add, left?, right?, Type::Text));
    }
    let (left, right) = (to_number(left, diags), to_number(right, diags));
    let (left, right) = (left?, right?);
    if left.ty == Type::Int && right.ty == Type::Int && sign.operator != Operator::Div {
        return Some(join(sign.operator, left, right, Type::Int));
    }
    let (a, b) = (dimension(&left), dimension(&right));
    let result = match sign.operator {
        Operator::Mul => a.times(b),
        Operator::Div => a.over(b),
        Operator::Add | Operator::Sub | Operator::Rem if a == b => Some(a),
        _ => {
            diags.push(different(scope, &left, &right));
            return None;
        }
    };
    let (left, right) = (to_float(left), to_float(right));
    let Some(result) = result else {
        let span = left.span.to(right.span);
        diags.push(
            Diagnostic::new(Code::E0242, span, "the exponent of a dimension is too large")
                .help("exponents of a dimension go from -128 to 127"),
        );
        return None;
    };
    Some(join(sign.operator, left, right, Type::Quantity(result)))
}

/// `-operand`
pub(super) fn negate(operand: Formula, span: Span, diags: &mut Diagnostics) -> Option<Formula> {
    let operand = to_number(operand, diags)?;
    let ty = operand.ty.clone();
    Some(Formula::new(Op::Neg, [operand], ty, span))
}

fn join(operator: Operator, left: Formula, right: Formula, ty: Type) -> Formula {
    let span = left.span.to(right.span);
    Formula::new(Op::Binary(operator), [left, right], ty, span)
}

fn convert(formula: Formula, conversion: Conversion, ty: Type) -> Formula {
    let span = formula.span;
    Formula::new(Op::Convert(conversion), [formula], ty, span)
}

pub(super) fn dimension(formula: &Formula) -> Dimension {
    match formula.ty {
        Type::Quantity(dimension) => dimension,
        _ => Dimension::NONE,
    }
}

pub(super) fn to_float(formula: Formula) -> Formula {
    match formula.ty {
        Type::Int => convert(formula, Conversion::IntToFloat, Type::FLOAT),
        _ => formula,
    }
}

pub(super) fn to_number(formula: Formula, diags: &mut Diagnostics) -> Option<Formula> {
    match formula.ty {
        Type::Int | Type::Quantity(_) => Some(formula),
        Type::Bool => {
            remark(&Conversion::BoolToInt, formula.span, diags);
            Some(convert(formula, Conversion::BoolToInt, Type::Int))
        }
        _ => {
            let message = message!("formulas cannot compute with {}", Words(a_value(&formula.ty)));
            let help = match formula.ty.is_generic() {
                true => "give the port a type with values, such as 'int', 'float' or 'length'",
                false => "use numbers or quantities; strings can be joined with '+'",
            };
            diags.push(Diagnostic::new(Code::E0242, formula.span, message).help(help));
            None
        }
    }
}

fn to_text(formula: Formula, diags: &mut Diagnostics) -> Option<Formula> {
    match &formula.ty {
        Type::Text => Some(formula),
        ty if ty.is_generic() || matches!(ty, Type::Object(_)) => {
            let message = message!("{} cannot be part of a string", Words(a_value(&formula.ty)));
            diags.push(
                Diagnostic::new(Code::E0242, formula.span, message)
                    .help("join strings, numbers, quantities, bools or values of enums"),
            );
            None
        }
        ty => {
            let conversion = Conversion::ToText(ty.clone());
            Some(convert(formula, conversion, Type::Text))
        }
    }
}

/// Two operands that cannot be added, subtracted or divided with remainder.
pub(super) fn different(scope: &Scope<'_>, left: &Formula, right: &Formula) -> Diagnostic {
    let (a, b) = (dimension(left), dimension(right));
    let (bare, other) = if b == Dimension::NONE {
        (right, left)
    } else if a == Dimension::NONE {
        (left, right)
    } else {
        let message =
            message!("expected {}, found {}", Words(a_dimension(a)), Words(a_dimension(b)));
        return Diagnostic::new(Code::E0205, right.span, message)
            .note(left.span, message!("this is {}", Words(a_dimension(a))))
            .help("compute only with quantities of one dimension here");
    };
    unit_missing(bare, dimension(other), None, scope.text_of(bare.span))
        .note(other.span, message!("this is {}", Words(a_dimension(dimension(other)))))
}
