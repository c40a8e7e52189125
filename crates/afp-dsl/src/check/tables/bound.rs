//! The bound table of a component, and its values.

use std::borrow::Cow;
use std::rc::Rc;
use std::sync::Arc;

use crate::check::Context;
use crate::check::bindings::{self, Site};
use crate::check::formula::Scope;
use crate::check::names::{ambiguous, unknown};
use crate::check::signature::Signature;
use crate::graph::Formula;
use crate::table::Table;
use crate::toolbox::{ReadsTable, Template};
use crate::types::Constant;
use afp_syntax::ast::{self, Bind};
use afp_syntax::diagnostics::{Code, Diagnostic, Diagnostics, Message};
use afp_syntax::message;
use afp_syntax::source::Span;

/// The signature and bindings of a component.
type Bound<'b> = (Rc<Signature>, Cow<'b, [Bind]>);

/// For a component that reads a table, the ports with its columns and the bindings except the
/// table's; unchanged for others. `None` without a table, which is reported.
pub(in crate::check) fn read_by<'b>(
    context: Context<'_>,
    signature: &Rc<Signature>,
    (scope, binds, site): (&Scope<'_>, &'b [Bind], &Site),
    diags: &mut Diagnostics,
) -> Option<Bound<'b>> {
    let reads = signature.template().and_then(|template| template.reads_table.as_ref());
    let Some(reads) = reads else { return Some((signature.clone(), Cow::Borrowed(binds))) };
    let is_table = |bind: &&Bind| bind.port().text == reads.port.name;
    let mut bound = binds.iter().filter(is_table);
    let first = bound.next();
    for other in bound {
        again(other, first, reads, scope, diags);
    }
    let table = match first {
        Some(bind) => named(context, scope, reads, bind, diags),
        None => {
            if !site.broken {
                diags.push(without_table(context, signature, reads, site.reference));
            }
            None
        }
    };
    let rest: Vec<Bind> = binds.iter().filter(|bind| !is_table(bind)).cloned().collect();
    let (id, _) = signature.template.as_ref()?;
    let signatures = &context.program.signatures;
    let found = table.and_then(|it| signatures.of_table(id.toolbox, &signature.name, it));
    if found.is_none() {
        bindings::names_only(scope, &rest, &mut Diagnostics::default());
    }
    Some((found?, Cow::Owned(rest)))
}

/// Reports a second table.
fn again(
    other: &Bind,
    first: Option<&Bind>,
    reads: &ReadsTable,
    scope: &Scope<'_>,
    diags: &mut Diagnostics,
) {
    bindings::bound_names(scope, other);
    let other = other.port();
    scope.record.definition(other.span, reads.port.span);
    let message = message!("'{}' is bound twice", other.text);
    let error = Diagnostic::new(Code::E0226, other.span, message).help("remove one of them");
    diags.push(match first {
        Some(first) => error.note(first.port().span, "first bound here"),
        None => error,
    });
}

/// The table of a binding.
fn named<'c>(
    context: Context<'c>,
    scope: &Scope<'_>,
    reads: &ReadsTable,
    bind: &Bind,
    diags: &mut Diagnostics,
) -> Option<&'c Arc<Table>> {
    let record = scope.record;
    record.definition(bind.port().span, reads.port.span);
    let formula = match bind {
        Bind::In { formula, .. } => formula.as_ref()?,
        Bind::Out { port, sign, .. } => {
            bindings::bound_names(scope, bind);
            diags.push(bindings::mixed_up(*sign, port, "an input", "="));
            return None;
        }
    };
    let name = match formula.kind() {
        ast::FormulaKind::Ref(reference) if reference.home().is_none() => reference.name(),
        _ => None,
    };
    let Some(name) = name else {
        scope.names_only(formula);
        diags.push(
            Diagnostic::new(Code::E0253, formula.span(), "this is not a table")
                .help(message!("write {}", some_table(context))),
        );
        return None;
    };
    let tables = &context.file.tables;
    let found: Vec<_> = tables.iter().filter(|table| table.name == name.text).collect();
    match found.as_slice() {
        [table] => {
            record.definition(name.span, table.span);
            Some(table)
        }
        [] => {
            record.unknown(name.span);
            if !context.file.incomplete {
                let message = message!("there is no table '{}'", name.text);
                let known = tables.iter().map(|table| table.name.as_str());
                let none = message!(
                    "declare it in the file: 'table {}(x: length) {{ (1 m) }}'",
                    name.text
                );
                diags.push(unknown(Code::E0253, name.span, message, &name.text, known, none));
            }
            None
        }
        several => {
            record.several(name.span, several.iter().map(|table| table.span));
            let places: Vec<_> = several.iter().map(|table| (None, table.span)).collect();
            diags.push(ambiguous("a table", &name.text, name.span, &places));
            None
        }
    }
}

/// The help for a missing table.
fn some_table(context: Context<'_>) -> Message {
    match context.file.tables.first() {
        Some(table) => message!("the name of a table, such as '{}'", table.name),
        None => "the name of a table, and declare the table in the file".into(),
    }
}

fn without_table(
    context: Context<'_>,
    signature: &Signature,
    reads: &ReadsTable,
    place: Span,
) -> Diagnostic {
    let message = message!("'{}' of '{}' has no value", reads.port.name, signature.name);
    Diagnostic::new(Code::E0225, place, message)
        .note(reads.port.span, "declared here without a default")
        .help(match context.file.tables.first() {
            Some(table) => message!("bind it, such as '({} = {})'", reads.port.name, table.name),
            None => "declare a table in the file, and bind its name".into(),
        })
}

/// Reports a constant index outside of the table.
pub(in crate::check) fn fits(
    scope: &Scope<'_>,
    signature: &Signature,
    inputs: &[Formula],
    diags: &mut Diagnostics,
) {
    let Some((_, table)) = signature.template().and_then(Template::table) else { return };
    for index in inputs {
        if let Some(Constant::Int(number @ ..0)) = scope.value(index) {
            let message = message!("'{}' has no row '{}'", table.name, number);
            let error = Diagnostic::new(Code::E0224, index.span, message);
            diags.push(error.help("the index of the first row is 0"));
        }
    }
}
