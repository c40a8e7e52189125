//! Actors without a state that no event can end.

use crate::flow::view::{Cause, Edge, View};
use crate::graph::Component;
use afp_syntax::diagnostics::{Code, Diagnostic, Diagnostics};

/// Warns of each, at its name, unless the plan is to run for ever. What the plans around it watch for does not count.
pub(super) fn check(view: &View<'_>, diags: &mut Diagnostics) {
    if view.plan.forever {
        return;
    }
    for (node, element) in view.elements() {
        let Component::Actor(id) = element.component else { continue };
        let template = view.model.template(id);
        let leads_on = |edge: &Edge| {
            matches!(edge.cause, Cause::Event(..) | Cause::Miss(_) | Cause::On(..))
                && edge.to != node
        };
        let all = || view.from(node).iter().chain(view.of_globals(node));
        if !element.states.is_empty() || all().any(leads_on) {
            continue;
        }
        let message = format!("nothing can end '{}'", element.name);
        diags.push(
            Diagnostic::new(Code::E0315, element.span, message)
                .note(template.span, "the actor has no state: it lasts until an event")
                .help(
                    "watch it with a supervisor whose event leads on, or use an actor with a state",
                ),
        );
    }
}
