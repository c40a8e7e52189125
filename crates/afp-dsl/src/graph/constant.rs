//! Compile-time evaluation of formulas.
//!
//! The arithmetic is the run time's (`afp-types`): left to right, no fused operations; overflow and
//! non-finite results are errors. A failing part is an error even if other parts are unknown.

use afp_syntax::source::Span;
use afp_types::{EntryId, Error, Source, Value};

use crate::graph::{Formula, Part};
use crate::types::converter::Converter;
use crate::types::{Constant, Conversion};

/// The value of a formula; `Ok(None)` if it depends on run-time values.
///
/// `entry` returns known values of entries.
///
/// # Errors
/// The error of every evaluation.
pub(crate) fn evaluate(
    formula: &Formula,
    entry: &dyn Fn(u16) -> Option<Constant>,
) -> Result<Option<Constant>, Error> {
    part(formula.part(), entry)
}

/// The place of a formula's first failing operation, operands first.
pub(crate) fn fails_at(formula: &Formula, entry: &dyn Fn(u16) -> Option<Constant>) -> Span {
    let failed = formula.parts().find(|each| part(*each, entry).is_err());
    failed.map_or(formula.span, |part| part.span)
}

fn part(
    part: Part<'_>,
    entry: &dyn Fn(u16) -> Option<Constant>,
) -> Result<Option<Constant>, Error> {
    match part.value(&Known(entry)) {
        Ok(value) => Ok(Some(value)),
        Err(Error::Unknown | Error::Mistyped) => Ok(None),
        Err(error) => Err(error),
    }
}

/// Known values of entries.
pub(crate) struct Known<'a>(pub &'a dyn Fn(u16) -> Option<Constant>);

impl Source<Conversion> for Known<'_> {
    const FOLDS: bool = true;

    fn entry<V>(&self, entry: EntryId, read: impl FnOnce(&Value) -> Option<V>) -> Result<V, Error> {
        read(&(self.0)(entry.0).ok_or(Error::Unknown)?).ok_or(Error::Mistyped)
    }

    fn convert(&self, conversion: &Conversion, value: Value) -> Result<Value, Error> {
        convert(conversion, value)
    }
}

/// Converts a value.
///
/// # Errors
/// The error of the conversion.
pub(crate) fn convert(conversion: &Conversion, value: Constant) -> Result<Constant, Error> {
    Converter::new(conversion).convert(value)
}
