//! Conversions between types, and their warnings.

mod unit;

pub(crate) use unit::{bare, likely, unit_missing};

use crate::graph::{Formula, Op};
use crate::types::text::{self, a_dimension, a_type, a_value};
use crate::types::{Conversion, Dimension, Type};
use afp_syntax::diagnostics::{Code, Diagnostic, Diagnostics, Message, Words};
use afp_syntax::literal::Literal;
use afp_syntax::message;
use afp_syntax::source::Span;
use afp_syntax::units::Unit;

/// The conversion of a value of type `from` to type `to`: `Ok(None)` if none is needed, `Err` if
/// there is none.
pub(crate) fn conversion(from: &Type, to: &Type) -> Result<Option<Conversion>, ()> {
    if from == to {
        return Ok(None);
    }
    let plain = Type::FLOAT;
    Ok(Some(match (from, to) {
        (Type::Int, to) if *to == plain => Conversion::IntToFloat,
        (from, Type::Int) if *from == plain => Conversion::FloatToInt,
        (Type::Bool, Type::Int) => Conversion::BoolToInt,
        (Type::Bool, to) if *to == plain => Conversion::BoolToFloat,
        (Type::Bool | Type::Int | Type::Quantity(_) | Type::Enum(_), Type::Text) => {
            Conversion::ToText(from.clone())
        }
        (Type::Text, Type::Int | Type::Quantity(_)) => Conversion::FromText(to.clone()),
        _ => return Err(()),
    }))
}

/// The target type of the right side of a comparison: that of the left side. A float next to an int
/// stays a float, because a conversion would change the result.
/// would lose what it is compared for.
pub(crate) fn compared_as(left: &Type, right: &Type) -> Type {
    match (left, right) {
        (Type::Int, right) if *right == Type::FLOAT => Type::FLOAT,
        _ => left.clone(),
    }
}

/// The formula as a value of type `want`; reports errors and warnings of the conversion.
///
/// `text` is the source of the formula. `range` has the least and the greatest allowed value, in SI
/// units.
pub(crate) fn coerce(
    formula: Formula,
    want: &Type,
    range: Option<(f64, f64)>,
    text: &str,
    diags: &mut Diagnostics,
) -> Option<Formula> {
    let span = formula.span;
    match conversion(&formula.ty, want) {
        Ok(None) => Some(formula),
        Ok(Some(conversion)) => {
            remark(&conversion, span, diags);
            Some(Formula::new(Op::Convert(conversion), [formula], want.clone(), span))
        }
        Err(()) => {
            diags.push(mismatch(&formula, want, range, text));
            None
        }
    }
}

/// Warns of a conversion that changes the value or may fail.
pub(crate) fn remark(conversion: &Conversion, span: Span, diags: &mut Diagnostics) {
    let diagnostic = match conversion {
        Conversion::IntToFloat => return,
        Conversion::FloatToInt => {
            Diagnostic::new(Code::E0207, span, "the float becomes an int, rounded toward zero")
                .help("use an int if you do not want the rounding")
        }
        Conversion::BoolToInt | Conversion::BoolToFloat => {
            Diagnostic::new(Code::E0207, span, "the bool becomes a number, 0 or 1")
                .help("use a number where that is not wanted")
        }
        Conversion::ToText(from) => {
            let message = message!("{} becomes a string", Words(a_type(from)));
            let help = match from {
                Type::Quantity(dimension) if *dimension != Dimension::NONE => {
                    message!(
                        "it is shown in '{}'; divide by a unit for the bare number",
                        dimension.si_unit()
                    )
                }
                _ => "use a string if you do not want the conversion".into(),
            };
            Diagnostic::new(Code::E0207, span, message).help(help)
        }
        Conversion::FromText(to) => {
            let message = message!(
                "the string is converted to {} at run time, which may fail",
                Words(a_type(to))
            );
            Diagnostic::new(Code::E0208, span, message)
                .help("connect 'Error' to handle a failure, or use an entry of that type")
        }
    };
    diags.push(diagnostic);
}

/// A fitting quantity: one of its usual unit, or the nearer end of the range.
fn example(ty: &Type, range: Option<(f64, f64)>) -> String {
    let Type::Quantity(dimension) = ty else { return String::new() };
    let one = format!("1 {}", dimension.usual_unit());
    let value = Literal::parse(&one).and_then(|literal| literal.value());
    match value.zip(range) {
        Some((value, (least, greatest))) if !(least..=greatest).contains(&value) => {
            text::value(if value < least { least } else { greatest }, ty)
        }
        _ => one,
    }
}

/// The value that a text means in another spelling: `Side.left` for `"left"`, `1 m / 2` for `1/2 m`.
fn spelled(found: &Type, want: &Type, text: &str) -> Option<(Code, String)> {
    match (found, want) {
        (Type::Text, Type::Enum(home)) => {
            let value = home.variants.iter().find(|value| text.trim_matches('"') == **value)?;
            Some((Code::E0206, format!("{}.{value}", home.name)))
        }
        (Type::Quantity(_), Type::Quantity(dimension)) => {
            let (left, right) = text.split_once('/')?;
            let (left, (number, unit)) = (left.trim(), right.trim().split_once(' ')?);
            let are_numbers = [left, number].iter().all(|it| it.parse::<f64>().is_ok());
            let fits = Unit::parse(unit).is_some_and(|unit| unit.dimension == *dimension);
            (are_numbers && fits).then(|| (Code::E0204, format!("{left} {unit} / {number}")))
        }
        _ => None,
    }
}

/// Helps where a quantity stands for a number.
fn number_wanted(
    error: Diagnostic,
    formula: &Formula,
    (dimension, want): (Dimension, &Type),
    range: Option<(f64, f64)>,
    text: &str,
) -> Diagnostic {
    let unit = dimension.usual_unit();
    let whole = bracketed(formula, text);
    let number = message!("'{} / 1 {}' for the number of '{}'", whole, unit, unit);
    let bare = without_unit(text);
    let value = bare.and_then(|bare| bare.parse::<f64>().ok()).zip(range);
    let outside = value.filter(|(value, range)| !(range.0..=range.1).contains(value));
    match (bare, outside) {
        (Some(_), Some((_, (least, greatest)))) => {
            let [least, greatest] = [least, greatest].map(|end| text::value(end, want));
            error.help(message!("write a bare number from {} to {}", Words(least), Words(greatest)))
        }
        (Some(bare), None) => error.help(message!("write '{}', or {}", bare, number)).replace(bare),
        (None, _) => {
            error.help(message!("write {}", number)).replace(format!("{whole} / 1 {unit}"))
        }
    }
}

fn mismatch(formula: &Formula, want: &Type, range: Option<(f64, f64)>, text: &str) -> Diagnostic {
    let span = formula.span;
    let expected =
        message!("expected {}, found {}", Words(a_value(want)), Words(a_value(&formula.ty)));
    if let Some((code, better)) = spelled(&formula.ty, want, text) {
        return Diagnostic::new(code, span, expected).write(better);
    }
    match (&formula.ty, want) {
        (found, want) if found.is_generic() || want.is_generic() => {
            Diagnostic::new(Code::E0206, span, expected).help(one_type(found, want))
        }
        (Type::Int | Type::Quantity(Dimension::NONE), Type::Quantity(dimension)) => {
            unit_missing(formula, *dimension, Some(range), text)
        }
        (Type::Quantity(dimension), Type::Int | Type::Quantity(Dimension::NONE)) => {
            let error = Diagnostic::new(Code::E0204, span, expected);
            number_wanted(error, formula, (*dimension, want), range, text)
        }
        (Type::Quantity(found), Type::Quantity(dimension)) => {
            let error = Diagnostic::new(Code::E0204, span, expected);
            // In other systems an angle has no dimension.
            let sign = match found.over(*dimension) {
                Some(Dimension { angle: 1, .. }) if same_but_angle(*found, *dimension) => Some('/'),
                Some(Dimension { angle: -1, .. }) if same_but_angle(*found, *dimension) => {
                    Some('*')
                }
                _ => None,
            };
            match sign {
                Some(sign) => {
                    let better = format!("{} {sign} 1 rad", bracketed(formula, text));
                    error.help(message!("angles have a unit: write '{}'", better)).replace(better)
                }
                None => error.help(message!(
                    "use {}, such as '{}', instead of {}",
                    Words(a_dimension(*dimension)),
                    example(want, range),
                    Words(a_dimension(*found))
                )),
            }
        }
        (_, Type::Object(home)) => Diagnostic::new(Code::E0206, span, expected)
            .help(message!("name an entry that holds a '{}'", home.name)),
        (_, want) => Diagnostic::new(Code::E0206, span, expected)
            .help(message!("use {}", Words(a_type(want)))),
    }
}

/// The help for a value or a target of a generic type.
fn one_type(found: &Type, want: &Type) -> Message {
    match (found.is_generic(), want.is_generic()) {
        (true, true) => message!("give both ports the type '{}'", want),
        (true, _) => message!("give the port the type '{}'", want),
        _ => message!("give the port the type '{}'", found),
    }
}

/// The text, in parentheses if a following operation would bind tighter.
fn bracketed(formula: &Formula, text: &str) -> String {
    use crate::graph::Operator::{Add, Sub};
    let inner = match formula.op() {
        Op::Convert(_) => formula.part().operand(),
        _ => Some(formula.part()),
    };
    let loose = inner.is_some_and(|inner| matches!(inner.op(), Op::Binary(Add | Sub)));
    if loose && !text.starts_with('(') { format!("({text})") } else { text.to_owned() }
}

/// Whether two dimensions differ only in their angles.
fn same_but_angle(left: Dimension, right: Dimension) -> bool {
    Dimension { angle: 0, ..left } == Dimension { angle: 0, ..right }
}

/// The number of a literal quantity.
fn without_unit(text: &str) -> Option<&str> {
    let (number, unit) = text.split_at_checked(afp_types::number_length(text))?;
    Unit::parse(unit.trim_start()).filter(|_| !number.is_empty()).map(|_| number)
}
