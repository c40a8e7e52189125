//! Outputs: each has its own writable entry.

use crate::check::bindings::Ports;
use crate::check::bindings::generic::{Generic, actual};
use crate::check::convert::{conversion, remark};
use crate::check::formula::Scope;
use crate::check::names::unknown;
use crate::check::signature::Signature;
use crate::graph::{EntryId, EntryKind, Output};
use crate::types::Type;
use crate::types::text::{a_type, written};
use afp_syntax::ast::Name;
use afp_syntax::diagnostics::{Code, Diagnostic, Diagnostics, Sought, Words};
use afp_syntax::message;

/// The bound outputs; `None` if one has an error.
pub(super) fn check(
    scope: &Scope<'_>,
    signature: &Signature,
    ports: &Ports<'_>,
    generic: &Generic,
    diags: &mut Diagnostics,
) -> Option<Vec<Output>> {
    let mut outputs = Vec::new();
    let mut complete = ports.complete;
    let mut written: Vec<&Name> = Vec::new();
    for (index, entry, formula) in &ports.outputs {
        if let Some(formula) = formula {
            scope.names_only(formula);
            let name = &signature.outputs[*index].name;
            diags.push(
                Diagnostic::new(
                    Code::E0219,
                    formula.span(),
                    "an output goes to an entry, not into a formula",
                )
                .help(message!("name an entry, and use it in the formulas that read '{}'", name)),
            );
        }
        let Some(entry) = entry else {
            complete = false;
            continue;
        };
        if let Some(first) = written.iter().find(|known| known.text == entry.text) {
            let message = message!("two outputs go to '{}'", entry.text);
            diags.push(
                Diagnostic::new(Code::E0220, entry.span, message)
                    .note(first.span, "the other output")
                    .help("use another entry for one of them"),
            );
            scope.entry(entry);
            continue;
        }
        written.push(entry);
        let ty = actual(signature.outputs[*index].ty.as_ref(), generic);
        match output(scope, *index, ty, entry, diags) {
            Some(output) => outputs.push(output),
            None => complete = false,
        }
    }
    complete.then_some(outputs)
}

fn output(
    scope: &Scope<'_>,
    port: usize,
    ty: Option<&Type>,
    entry: &Name,
    diags: &mut Diagnostics,
) -> Option<Output> {
    let Some(index) = scope.entry(entry) else {
        let wanted = ty.map_or_else(|| "float".to_owned(), written);
        let writable =
            scope.entries.iter().filter(|e| matches!(e.kind, EntryKind::Var | EntryKind::Out));
        let known = writable.map(|known| known.name.text.as_str());
        let message = message!("there is no entry '{}'", entry.text);
        let none = message!("declare it in the plan: 'var {}: {}'", entry.text, wanted);
        let error = unknown(Code::E0209, entry.span, message, &entry.text, known, none);
        diags.push(error.unknown(Sought::Entry, &entry.text));
        return None;
    };
    let target = &scope.entries[index];
    if matches!(target.kind, EntryKind::In | EntryKind::Const) {
        let word = target.kind.word();
        let what = if target.kind == EntryKind::In { "an input" } else { "a constant" };
        let message = message!("cannot write to '{}': it is {}", entry.text, Words(what));
        diags.push(
            Diagnostic::new(Code::E0219, entry.span, message)
                .note(target.name.span, message!("declared as '{}' here", word))
                .help("declare it as 'var' or 'out', or write to another entry"),
        );
        return None;
    }
    let (ty, entry_ty) = (ty?, target.ty.as_ref()?);
    let Ok(conversion) = conversion(ty, entry_ty) else {
        let numeric = ty.is_numeric() && entry_ty.is_numeric();
        let code = if numeric { Code::E0204 } else { Code::E0206 };
        let message = message!(
            "the output is {}, the entry is {}",
            Words(a_type(ty)),
            Words(a_type(entry_ty))
        );
        diags.push(
            Diagnostic::new(code, entry.span, message)
                .note(target.name.span, "the entry is declared here")
                .help(message!("use an entry that is {}", Words(a_type(ty)))),
        );
        return None;
    };
    if let Some(conversion) = &conversion {
        remark(conversion, entry.span, diags);
    }
    Some(Output {
        port: u16::try_from(port).ok()?,
        entry: EntryId(u16::try_from(index).ok()?),
        conversion,
        span: entry.span,
    })
}
