//! Inputs of global supervisors that are read once, at the start of the plan, from entries that
//! change afterwards.

use std::collections::BTreeSet;

use crate::diagnostics::{Code, Diagnostic, Diagnostics};
use crate::graph::{Element, EntryId, Formula, FormulaKind, Output, Supervisor};
use crate::source::Span;
use crate::toolbox::Template;

/// Warns of every such input, at the entry that it reads.
///
/// `globals` are the global supervisors with their templates, `elements` and `supervisors` all
/// components that may write.
pub(crate) fn check<'a>(
    globals: impl Iterator<Item = (&'a Supervisor, &'a Template)>,
    elements: impl Iterator<Item = &'a Element>,
    supervisors: impl Iterator<Item = &'a Supervisor>,
    diags: &mut Diagnostics,
) {
    let outputs = elements.flat_map(|element| &element.outputs);
    let outputs = outputs.chain(supervisors.flat_map(|supervisor| &supervisor.outputs));
    let written: BTreeSet<EntryId> = outputs.map(|output: &Output| output.entry).collect();
    for (supervisor, template) in globals {
        for (port, formula) in template.inputs.iter().zip(&supervisor.inputs) {
            if !port.live {
                warn(&port.name, port.span, formula, &written, diags);
            }
        }
    }
}

fn warn(
    port: &str,
    declared: Span,
    formula: &Formula,
    written: &BTreeSet<EntryId>,
    diags: &mut Diagnostics,
) {
    match &formula.kind {
        FormulaKind::Entry(id) if written.contains(id) => {
            let message =
                format!("'{port}' is read once, when the plan starts, but the entry changes");
            diags.push(
                Diagnostic::new(Code::E0301, formula.span, message)
                    .note(declared, "the port is not 'live'")
                    .help("watch with a supervisor of the element that needs the new value, or use an entry that nothing writes"),
            );
        }
        FormulaKind::Neg(inner) | FormulaKind::Convert(_, inner) => {
            warn(port, declared, inner, written, diags);
        }
        FormulaKind::Binary(_, left, right) => {
            warn(port, declared, left, written, diags);
            warn(port, declared, right, written, diags);
        }
        _ => {}
    }
}
