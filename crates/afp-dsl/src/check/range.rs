//! Ranges of ports and entries, with inclusive ends: `from 0 cm/s to 1 m/s`.

use crate::types::text;
use crate::types::{Constant, Type};
use afp_syntax::ast::Formula;
use afp_syntax::diagnostics::{Code, Diagnostic, Diagnostics, Message};
use afp_syntax::message;
use afp_syntax::source::Span;

/// Minimum and maximum as written, with their place.
pub(crate) type Written = (Formula, Formula, Span);

/// Evaluates one end, optionally with its type.
pub(crate) type Constants<'c> =
    dyn FnMut(&Formula, Option<&Type>, &mut Diagnostics) -> Option<Constant> + 'c;

/// Minimum and maximum of a range of type `ty`, in SI units.
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

/// One end of a range. Ends are floats, so some large ints are invalid.
fn end(written: &Formula, value: &Constant, diags: &mut Diagnostics) -> Option<f64> {
    let end = number(value)?;
    match *value {
        Constant::Int(whole) if whole != end as i64 => {
            let message =
                message!("'{}' cannot be the bound of a range, which is stored as a float", whole);
            diags.push(
                Diagnostic::new(Code::E0513, written.span(), message)
                    .help(message!("write '{}', the nearest valid number", end as i64)),
            );
            None
        }
        _ => Some(end),
    }
}

/// The numeric value.
pub(crate) fn number(value: &Constant) -> Option<f64> {
    match value {
        Constant::Int(value) => Some(*value as f64),
        Constant::Float(value) => Some(*value),
        _ => None,
    }
}

/// Whether a value is in a range, with ints compared as ints, like at run time.
fn contains((least, greatest): (f64, f64), value: &Constant) -> bool {
    match value {
        Constant::Int(value) => (least as i64..=greatest as i64).contains(value),
        Constant::Float(value) => (least..=greatest).contains(value),
        _ => true,
    }
}

/// A number in a readable unit.
pub(crate) fn shown(value: &Constant, ty: &Type) -> Option<String> {
    match value {
        Constant::Int(value) => Some(value.to_string()),
        Constant::Float(value) => Some(text::value(*value, ty)),
        _ => None,
    }
}

/// The diagnostic of a value outside a range; `None` if it fits. `message` gets the readable value.
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
