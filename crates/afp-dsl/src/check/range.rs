//! Ranges of ports and entries: `from 0 cm/s to 1 m/s`, both ends belong to it.

use crate::types::text;
use crate::types::{Constant, Type};
use afp_syntax::ast::Formula;
use afp_syntax::diagnostics::{Code, Diagnostic, Diagnostics, Message};
use afp_syntax::message;
use afp_syntax::source::Span;

/// Least and greatest value as written, and the place of both.
pub(crate) type Written = (Formula, Formula, Span);

/// Gives the value of one end, of that type where it is told.
pub(crate) type Constants<'c> =
    dyn FnMut(&Formula, Option<&Type>, &mut Diagnostics) -> Option<Constant> + 'c;

/// Least and greatest value of what has type `ty`, in SI units.
pub(crate) fn read(
    (least, greatest, span): &Written,
    ty: &Type,
    constant: &mut Constants<'_>,
    diags: &mut Diagnostics,
) -> Option<(f64, f64)> {
    if !matches!(ty, Type::Int | Type::Quantity(_)) {
        diags.push(
            Diagnostic::new(Code::E0513, *span, "only ints, floats and quantities have a range")
                .help("remove 'from ... to ...'"),
        );
        for end in [least, greatest] {
            constant(end, None, &mut Diagnostics::default());
        }
        return None;
    }
    let ends = [
        (least, constant(least, Some(ty), diags)),
        (greatest, constant(greatest, Some(ty), diags)),
    ];
    let [from, to] = ends.map(|(written, value)| end(written, &value?, diags));
    let (from, to) = (from?, to?);
    if from > to {
        diags.push(
            Diagnostic::new(Code::E0513, *span, "the range is empty")
                .help("write the least value first"),
        );
        return None;
    }
    Some((from, to))
}

/// One end of a range. Ends are floats, so that not every large int can be one.
fn end(written: &Formula, value: &Constant, diags: &mut Diagnostics) -> Option<f64> {
    let end = number(value)?;
    match *value {
        Constant::Int(whole) if whole != end as i64 => {
            let message =
                message!("'{}' cannot be the end of a range, which is kept as a float", whole);
            diags.push(
                Diagnostic::new(Code::E0513, written.span(), message)
                    .help(message!("write '{}', the nearest number that can be", end as i64)),
            );
            None
        }
        _ => Some(end),
    }
}

/// The number that a value is.
pub(crate) fn number(value: &Constant) -> Option<f64> {
    match value {
        Constant::Int(value) => Some(*value as f64),
        Constant::Float(value) => Some(*value),
        _ => None,
    }
}

/// Whether a value lies in a range, ints compared with ints, as when a plan runs.
fn contains((least, greatest): (f64, f64), value: &Constant) -> bool {
    match value {
        Constant::Int(value) => (least as i64..=greatest as i64).contains(value),
        Constant::Float(value) => (least..=greatest).contains(value),
        _ => true,
    }
}

/// A number as people write it.
pub(crate) fn shown(value: &Constant, ty: &Type) -> Option<String> {
    match value {
        Constant::Int(value) => Some(value.to_string()),
        Constant::Float(value) => Some(text::value(*value, ty)),
        _ => None,
    }
}

/// What a value is told that is out of the range of what it is for; `None` where it fits. `message`
/// gets the value as people write it.
pub(crate) fn outside(
    value: &Constant,
    range: (f64, f64),
    ty: &Type,
    place: Span,
    message: impl FnOnce(String) -> Message,
) -> Option<Diagnostic> {
    if contains(range, value) {
        return None;
    }
    let value = shown(value, ty)?;
    let [least, greatest] = [range.0, range.1].map(|end| text::value(end, ty));
    Some(Diagnostic::new(Code::E0224, place, message(value)).help(message!(
        "use a value from '{}' to '{}'",
        least,
        greatest
    )))
}
