//! Actors without a state that no event can end.

use crate::flow::view::{Cause, Edge, Node, View};
use crate::graph::{Component, Element};
use afp_syntax::diagnostics::{Code, Diagnostic, Diagnostics};
use afp_syntax::message;

/// Warns of each, at its name, unless the plan should run permanently. Supervisors of outer plans
/// do not count.
pub(super) fn check(view: &View<'_>, diags: &mut Diagnostics) {
    if view.plan.forever {
        return;
    }
    for (node, element) in view.elements() {
        let Component::Actor(id) = element.component else { continue };
        if !lasts(view, node, element) {
            continue;
        }
        let message = message!("nothing can end '{}'", element.name);
        diags.push(
            Diagnostic::new(Code::E0315, element.span, message)
                .note(
                    view.model.template(id).span,
                    "the actor has no state: it lasts until an event",
                )
                .help(
                    "watch it with a supervisor whose event leads to another element, or use an actor with a state",
                ),
        );
    }
}

/// Whether an element is an actor without a state that no event ends. A resumed actor continues.
pub(super) fn lasts(view: &View<'_>, node: Node, element: &Element) -> bool {
    // A handler that only returns ends nothing.
    let goes_on = |rest: Node| {
        view.from(rest).iter().any(|edge| !matches!(edge.cause, Cause::Active(_)))
            || !view.can_return(rest)
    };
    let leads_on = |edge: &Edge| {
        let mut rests = view.rests(edge.to).into_iter();
        matches!(edge.cause, Cause::Event(..) | Cause::Miss(_) | Cause::On(..))
            && rests.any(|rest| rest != node && (!edge.suspends || goes_on(rest)))
    };
    matches!(element.component, Component::Actor(_))
        && element.states.is_empty()
        && !view.from(node).iter().chain(view.of_globals(node)).any(leads_on)
        && !view.event_returns(node)
}
