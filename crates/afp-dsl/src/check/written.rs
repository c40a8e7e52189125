//! Known written values: cells of a table, and inputs of `Assign`. Their entries must accept them.

use afp_types::{Error, Op};

use crate::check::formula::{Scope, fault_diagnostic};
use crate::check::head::EntryDraft;
use crate::check::range;
use crate::check::signature::Signature;
use crate::graph::constant::convert;
use crate::graph::{Formula, Output};
use crate::table::Table;
use crate::toolbox::Template;
use crate::types::{Constant, Type};
use afp_syntax::diagnostics::{Diagnostic, Diagnostics, Message};
use afp_syntax::message;
use afp_syntax::source::Span;

/// Reports the first rejected value of each output.
pub(super) fn fits(
    scope: &Scope<'_>,
    signature: &Signature,
    (inputs, outputs): (&[Formula], &[Output]),
    diags: &mut Diagnostics,
) {
    for output in outputs {
        let Some(entry) = scope.entries.get(output.entry.index()) else { continue };
        let error = match signature.template().and_then(Template::table) {
            Some((_, table)) => cell(entry, output, table),
            None => copied(signature, inputs, output)
                .and_then(|value| assigned(scope, entry, output, value)),
        };
        if let Some(error) = error {
            diags.push(error.note(entry.name.span, "the entry is declared here"));
        }
    }
}

/// The input that a computation with one state copies to an output.
fn copied<'f>(
    signature: &Signature,
    inputs: &'f [Formula],
    output: &Output,
) -> Option<&'f Formula> {
    let [case] = signature.template()?.cases.as_deref()? else { return None };
    let (_, formula) = case.writes.iter().find(|(port, _)| *port == output.port)?;
    match formula.op() {
        Op::Entry(port) => inputs.get(port.index()),
        _ => None,
    }
}

/// The first cell of a column that does not fit.
fn cell(entry: &EntryDraft, output: &Output, table: &Table) -> Option<Diagnostic> {
    let column = usize::from(output.port);
    let ty = table.columns.get(column)?.ty.as_ref()?;
    let mut cells = table.rows.iter().filter_map(|row| row.get(column));
    cells.find_map(|cell| {
        let name = &entry.name.text;
        let message =
            |value: String| message!("the table has '{}', out of the range of '{}'", value, name);
        let error = outside(entry, output, (&cell.value, ty), output.span, message)?;
        Some(error.note(cell.span, "the value is here"))
    })
}

/// Reports an input of a computation such as `Assign` that can never be written.
fn assigned(
    scope: &Scope<'_>,
    entry: &EntryDraft,
    output: &Output,
    formula: &Formula,
) -> Option<Diagnostic> {
    let value = scope.value(formula)?;
    if let Err(fault) = converted(output, &value) {
        return Some(fault_diagnostic(fault, formula.span));
    }
    let message =
        |value: String| message!("'{}' is out of the range of '{}'", value, entry.name.text);
    outside(entry, output, (&value, &formula.ty), formula.span, message)
}

/// Reports a converted value outside of an entry's range; `message` gets the unconverted value.
fn outside(
    entry: &EntryDraft,
    output: &Output,
    (value, ty): (&Constant, &Type),
    place: Span,
    message: impl FnOnce(String) -> Message,
) -> Option<Diagnostic> {
    let (range, entry_ty) = (entry.range?, entry.ty.as_ref()?);
    let written = converted(output, value).ok()?;
    let shown = range::shown(value, ty);
    range::outside(&written, range, entry_ty, place, |own| message(shown.unwrap_or(own)))
}

fn converted(output: &Output, value: &Constant) -> Result<Constant, Error> {
    match &output.conversion {
        Some(conversion) => convert(conversion, value.clone()),
        None => Ok(value.clone()),
    }
}
