//! Unread entries. The results of a plan are read by its caller.

use std::cell::OnceCell;

use crate::flow::view::View;
use crate::graph::{Element, EntryId, EntryKind, Formula, Supervisor};
use afp_syntax::diagnostics::{Code, Diagnostic, Diagnostics};
use afp_syntax::message;

/// Warns of each, at its name.
pub(super) fn check(view: &View<'_>, diags: &mut Diagnostics) {
    let reached = read(view, view.elements().map(|(_, element)| element), view.supervisors());
    let all = OnceCell::new();
    for (index, (entry, reached)) in view.plan.entries.iter().zip(reached).enumerate() {
        if reached || entry.kind == EntryKind::Out {
            continue;
        }
        let all = all.get_or_init(|| read(view, &view.plan.elements, &view.plan.supervisors));
        let message = match all[index] {
            true => message!("nothing that can be reached reads '{}'", entry.name),
            false => message!("nothing reads '{}'", entry.name),
        };
        let help = match entry.kind {
            EntryKind::Var => "use it in a formula, make it an 'out' of the plan, or remove it",
            _ => "use it in a formula, or remove it",
        };
        diags.push(Diagnostic::new(Code::E0304, entry.span, message).help(help));
    }
}

/// The entries that elements, supervisors or declarations read.
fn read<'a>(
    view: &View<'_>,
    elements: impl IntoIterator<Item = &'a Element>,
    supervisors: impl IntoIterator<Item = &'a Supervisor>,
) -> Vec<bool> {
    let mut read = vec![false; view.plan.entries.len()];
    let mut mark = |id: EntryId| read[id.index()] = true;
    for element in elements {
        element.inputs.iter().flat_map(Formula::entries).for_each(|(id, _)| mark(id));
    }
    for supervisor in supervisors {
        supervisor.inputs.iter().flat_map(Formula::entries).for_each(|(id, _)| mark(id));
        supervisor.timed_by.iter().for_each(|id| mark(*id));
    }
    for entry in &view.plan.entries {
        entry.init.iter().flat_map(Formula::entries).for_each(|(id, _)| mark(id));
        entry.ranged_by.iter().for_each(|id| mark(*id));
    }
    read
}
