//! Functions and the dimensions of their values.

use afp_types::{Function, Signature};

use super::Scope;
use super::operation::{different, dimension, to_float, to_number};
use crate::check::convert::coerce;
use crate::check::formula::elsewhere::random;
use crate::check::meant::decimal_comma;
use crate::check::names::unknown;
use crate::graph::{Formula, Op};
use crate::index::Word;
use crate::types::text::{a_dimension, a_type};
use crate::types::{Dimension, Type};
use afp_syntax::ast::{self, Name};
use afp_syntax::diagnostics::{Code, Diagnostic, Diagnostics, Message, Words};
use afp_syntax::message;
use afp_syntax::source::Span;

/// Finds a function by name; reports an unknown one.
pub(super) fn named(
    scope: &Scope<'_>,
    name: &Name,
    (operands, span): (&[ast::Formula], Span),
    diags: &mut Diagnostics,
) -> Option<Function> {
    let function = Function::named(&name.text);
    match function {
        Some(_) => scope.record.word(name.span, Word::Function),
        None => {
            scope.record.unknown(name.span);
            let known = Function::ALL.iter().map(|function| function.name());
            let message = message!("there is no function '{}'", name.text);
            if let Some(better) = in_terms_of_ours(scope, &name.text, operands) {
                let error = Diagnostic::new(Code::E0243, name.span, message);
                diags.push(error.write_at(span, better));
                return None;
            }
            diags.push(match name.text.starts_with("rand") {
                true => random(Diagnostic::new(Code::E0243, name.span, message)),
                false => unknown(Code::E0243, name.span, message, &name.text, known, ""),
            });
        }
    }
    function
}

/// A foreign function with one operand, expressed in this language.
fn in_terms_of_ours(scope: &Scope<'_>, name: &str, operands: &[ast::Formula]) -> Option<String> {
    let [operand] = operands else { return None };
    let x = scope.text_of(operand.span());
    let factor = match operand.kind() {
        ast::FormulaKind::Chain(..) | ast::FormulaKind::Negation(_) => format!("({x})"),
        _ => x.to_owned(),
    };
    Some(match name {
        "atan" | "arctan" => format!("atan2({x}, 1)"),
        "asin" | "arcsin" => format!("atan2({x}, sqrt(1 - {factor} * {factor}))"),
        "acos" | "arccos" => format!("atan2(sqrt(1 - {factor} * {factor}), {x})"),
        "tan" => format!("(sin({x}) / cos({x}))"),
        _ => return None,
    })
}

/// Whether operands may be in degrees Celsius: comparisons do not need an absolute zero.
pub(super) fn takes_celsius(function: Option<Function>) -> bool {
    function.is_some_and(|function| function.signature() == Signature::Choice)
}

/// `function(operands)` at `span`; the number of operands is valid.
pub(super) fn call(
    scope: &Scope<'_>,
    function: Function,
    operands: Vec<Formula>,
    span: Span,
    diags: &mut Diagnostics,
) -> Option<Formula> {
    let numbers = operands.into_iter().map(|operand| to_number(operand, diags));
    let mut numbers = numbers.collect::<Option<Vec<_>>>()?;
    let ints = numbers.iter().all(|number| number.ty == Type::Int);
    let ty = match function.signature() {
        Signature::Choice | Signature::Same if ints => Type::Int,
        Signature::OfAngle => {
            let angle = Type::Quantity(Dimension::named("angle")?);
            let operand = numbers.pop()?;
            let text = scope.text_of(operand.span);
            numbers.push(coerce(operand, &angle, None, text, diags)?);
            Type::FLOAT
        }
        signature => {
            let dimension = common(scope, &numbers, diags)?;
            numbers = numbers.into_iter().map(to_float).collect();
            match signature {
                Signature::Angle => Type::Quantity(Dimension::named("angle")?),
                Signature::Root => root(dimension, span, diags)?,
                _ => Type::Quantity(dimension),
            }
        }
    };
    Some(joined(function, numbers, ty, span))
}

/// Applies a function to two operands at a time, from left to right.
fn joined(function: Function, operands: Vec<Formula>, ty: Type, span: Span) -> Formula {
    let call =
        |operands: Vec<Formula>| Formula::new(Op::Call(function), operands, ty.clone(), span);
    if !function.operands().1 {
        return call(operands);
    }
    let mut operands = operands.into_iter();
    let first = operands.next().into_iter().chain(operands.next()).collect();
    operands.fold(call(first), |value, operand| call(vec![value, operand]))
}

fn common(scope: &Scope<'_>, operands: &[Formula], diags: &mut Diagnostics) -> Option<Dimension> {
    let first = operands.first()?;
    let other = operands.iter().find(|operand| dimension(operand) != dimension(first));
    if let Some(other) = other {
        diags.push(different(scope, first, other));
        return None;
    }
    Some(dimension(first))
}

fn root(dimension: Dimension, span: Span, diags: &mut Diagnostics) -> Option<Type> {
    if let Some(root) = dimension.root() {
        return Some(Type::Quantity(root));
    }
    let message = message!("{} has no square root", Words(a_dimension(dimension)));
    let square = dimension.power(2).map_or_else(Message::default, |square| {
        message!(", or of {}", Words(a_type(&Type::Quantity(square))))
    });
    diags.push(
        Diagnostic::new(Code::E0242, span, message)
            .help(message!("take the root of a number{}", square)),
    );
    None
}

/// Checks the number of operands of a function whose name is at `span`.
pub(super) fn takes(
    function: Function,
    operands: &[ast::Formula],
    span: Span,
    diags: &mut Diagnostics,
) -> Option<()> {
    let (names, takes_more) = function.operands();
    // A choice needs at least two operands.
    let is_too_much = !takes_more && operands.len() > names.len();
    if operands.len() >= names.len() && !is_too_much {
        return Some(());
    }
    let comma = if is_too_much { decimal_comma(operands.iter()) } else { None };
    let call = format!("{}({})", function.name(), names.join(", "));
    let help = message!("write '{}'{}", call, comma.unwrap_or_default());
    diags.push(wrong_number(function, operands.len(), span).help(help));
    None
}

fn wrong_number(function: Function, given: usize, span: Span) -> Diagnostic {
    let (names, takes_more) = function.operands();
    let more = if takes_more { " or more" } else { "" };
    let plural = if names.len() == 1 { "" } else { "s" };
    let message = message!(
        "'{}' takes {}{} operand{}, not {}",
        function.name(),
        names.len(),
        Words(more),
        Words(plural),
        given
    );
    Diagnostic::new(Code::E0243, span, message)
}
