//! Entries that nothing reads. The results of a plan are read by whoever started it.

use crate::flow::view::{View, each_entry};
use crate::graph::{EntryId, EntryKind};
use afp_syntax::diagnostics::{Code, Diagnostic, Diagnostics};
use afp_syntax::source::Span;

/// Warns of each, at its name.
pub(super) fn check(view: &View<'_>, diags: &mut Diagnostics) {
    let mut read = vec![false; view.plan.entries.len()];
    let mut mark = |id: EntryId, _: Span| read[id.index()] = true;
    let of_elements = view.elements().flat_map(|(_, element)| &element.inputs);
    let of_supervisors = view.supervisors().flat_map(|supervisor| &supervisor.inputs);
    let initial = view.plan.entries.iter().filter_map(|entry| entry.init.as_ref());
    of_elements.chain(of_supervisors).chain(initial).for_each(|f| each_entry(f, &mut mark));
    for supervisor in view.supervisors() {
        supervisor.timed_by.iter().for_each(|id| read[id.index()] = true);
    }
    let ranged = view.plan.entries.iter().flat_map(|entry| &entry.ranged_by);
    ranged.for_each(|id| read[id.index()] = true);
    for (entry, read) in view.plan.entries.iter().zip(read) {
        if read || entry.kind == EntryKind::Out {
            continue;
        }
        let message = format!("nothing reads '{}'", entry.name);
        let help = match entry.kind {
            EntryKind::Var => "use it in a formula, make it an 'out' of the plan, or remove it",
            _ => "use it in a formula, or remove it",
        };
        diags.push(Diagnostic::new(Code::E0304, entry.span, message).help(help));
    }
}
