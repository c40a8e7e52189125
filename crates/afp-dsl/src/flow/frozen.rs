//! Inputs of global supervisors that are read once at the plan's start, from entries that change
//! later.

use crate::flow::view::View;
use afp_syntax::diagnostics::{Code, Diagnostic, Diagnostics};
use afp_syntax::message;

/// Warns of every such input, at the entry.
pub(super) fn check(view: &View<'_>, diags: &mut Diagnostics) {
    let globals = &view.plan.supervisors[..usize::from(view.plan.globals)];
    if globals.is_empty() {
        return;
    }
    let live = view.plan.entries.iter().map(|entry| entry.live);
    let mut written: Vec<bool> = live.collect();
    let of_elements = view.elements().flat_map(|(_, element)| &element.outputs);
    let of_supervisors = view.supervisors().flat_map(|supervisor| &supervisor.outputs);
    of_elements.chain(of_supervisors).for_each(|output| written[output.entry.index()] = true);
    for supervisor in globals {
        let template = view.template(supervisor);
        for (port, formula) in template.inputs.iter().zip(&supervisor.inputs) {
            if port.live {
                continue;
            }
            for (_, span) in formula.entries().filter(|(entry, _)| written[entry.index()]) {
                let message = message!(
                    "'{}' is read once, when the plan starts, but the entry changes",
                    port.name
                );
                diags.push(
                    Diagnostic::new(Code::E0301, span, message)
                        .note(port.span, "the port is not 'live'")
                        .help("watch with a supervisor of the element that needs the new value, or use an entry that nothing writes"),
                );
            }
        }
    }
}
