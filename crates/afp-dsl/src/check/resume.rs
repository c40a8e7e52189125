//! `resume` without an active element.

use crate::graph::{Component, Element, ElementId, Target, resuming};
use afp_syntax::diagnostics::{Code, Diagnostic, Diagnostics};
use afp_syntax::message;
use afp_syntax::source::Span;

/// Reports an edge to `resume` from a component that has ended.
pub(crate) fn nothing_active(span: Span) -> Diagnostic {
    Diagnostic::new(Code::E0247, span, "an element that has ended cannot be resumed")
        .help("name an element of the plan, or lead an event to 'resume'")
}

/// Reports edges of actors and sub-plans, and a `start`, to a computation that can resume: no
/// element is active then. Elements with errors are `None`.
pub(super) fn check(
    elements: &[Option<Element>],
    start: Option<(ElementId, Span)>,
    diags: &mut Diagnostics,
) {
    let resuming = resuming(elements.iter().map(Option::as_ref));
    let mut report = |target: Option<Target>, span: Option<Span>| {
        let (Some(Target::Element(id)), Some(span)) = (target, span) else { return };
        let Some(element) = elements.get(id.index()).and_then(Option::as_ref) else { return };
        if resuming[id.index()] {
            let message =
                message!("'{}' can lead to 'resume', but nothing is active here", element.name);
            diags.push(
                Diagnostic::new(Code::E0247, span, message)
                    .note(element.span, "only events may lead to this computation")
                    .help("use a second computation that leads only to elements"),
            );
        }
    };
    for element in elements.iter().flatten() {
        if !matches!(element.component, Component::Computation(_)) {
            for (state, span) in element.states.iter().zip(&element.edges.outcomes) {
                report(*state, *span);
            }
            report(element.on_error, element.edges.extra);
        }
    }
    if let Some((first, span)) = start {
        report(Some(Target::Element(first)), Some(span));
    }
}
