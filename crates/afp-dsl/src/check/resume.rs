//! `resume` or `suspend` without an active element.

use crate::graph::{Component, Element, ElementId, Target, resuming};
use afp_syntax::diagnostics::{Code, Diagnostic, Diagnostics, Words};
use afp_syntax::message;
use afp_syntax::source::Span;

/// An edge to `resume` or `suspend` from a component that has ended; `done` is the participle.
pub(crate) fn nothing_active(span: Span, done: &str) -> Diagnostic {
    let message = message!("an element that has ended cannot be {}", Words(&done));
    let word = if done == "resumed" { "resume" } else { "suspend" };
    Diagnostic::new(Code::E0247, span, message)
        .help(message!("name an element of the plan, or lead an event to '{}'", word))
}

/// `resume` or `suspend`, to which a computation can lead through computations only.
pub(super) fn word(elements: &[Option<Element>], first: ElementId) -> &'static str {
    let (mut open, mut seen) = (vec![first], Vec::new());
    while let Some(id) = open.pop() {
        if seen.contains(&id) {
            continue;
        }
        seen.push(id);
        let Some(Some(element)) = elements.get(id.index()) else { continue };
        for target in element.states.iter().flatten().chain(&element.on_error) {
            match target {
                Target::Resume => return "resume",
                Target::Element(next) => open.push(*next),
                _ => {}
            }
        }
    }
    "suspend"
}

/// Reports edges of actors and sub-plans, and a `start`, to a computation that can resume or suspend: no
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
            let word = word(elements, id);
            let message =
                message!("'{}' can lead to '{}', but nothing is active here", element.name, word);
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
