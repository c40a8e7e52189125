//! Elements that are unreachable from `start`.

use crate::flow::view::View;
use afp_syntax::diagnostics::{Code, Diagnostic, Diagnostics};
use afp_syntax::message;

/// Warns of each, at its name.
pub(super) fn check(view: &View<'_>, diags: &mut Diagnostics) {
    for (node, element) in view.plan.elements.iter().enumerate() {
        if view.reached[node] {
            continue;
        }
        let message = message!("'{}' can never be reached", element.name);
        diags.push(
            Diagnostic::new(Code::E0302, element.span, message)
                .note(view.plan.start_span, "no path from here leads to it")
                .help("lead a state or an event to it, or remove it"),
        );
    }
}
