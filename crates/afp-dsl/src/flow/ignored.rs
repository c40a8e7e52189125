//! Supervisors whose events are all ignored.

use crate::flow::view::View;
use crate::graph::Target;
use afp_syntax::diagnostics::{Code, Diagnostic, Diagnostics};
use afp_syntax::message;

/// Warns of each, at its name.
pub(super) fn check(view: &View<'_>, diags: &mut Diagnostics) {
    for (id, supervisor) in view.numbered_supervisors() {
        if view.plan.targets(id).any(|target| target != Target::Ignore) {
            continue;
        }
        let message = message!("'{}' watches for nothing: every event is ignored", supervisor.name);
        diags.push(
            Diagnostic::new(Code::E0308, supervisor.span, message)
                .help("lead one of its events to an element or to 'terminate', or remove it"),
        );
    }
}
