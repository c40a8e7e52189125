//! Unhandled failures of sub-plans.

use crate::flow::FAILED;
use crate::flow::view::View;
use afp_syntax::diagnostics::{Code, Diagnostic, Diagnostics};
use afp_syntax::message;
use afp_syntax::source::Span;

/// Warns of each sub-plan without an `Error` edge whose plan leads to `fail`; returns such an edge
/// of this plan.
pub(super) fn check(view: &View<'_>, diags: &mut Diagnostics) -> Option<Span> {
    for (_, element) in view.elements() {
        let fails = view.summary(element).and_then(|inner| inner.fails);
        let Some(edge) = fails.filter(|_| element.on_error.is_none()) else { continue };
        let (name, plan) = (&element.name, &view.plan.name);
        let message = message!("when '{}' fails, '{}' ends with it", name, plan);
        diags.push(
            Diagnostic::new(Code::E0313, element.span, message)
                .note(edge, "it fails here")
                .help("add 'Error -> terminate', or lead it to an element or to 'fail \"...\"'"),
        );
    }
    edge(view)
}

/// A reachable edge to `fail`.
pub(super) fn edge(view: &View<'_>) -> Option<Span> {
    let fail = view.end(FAILED);
    let mut edges = view.edges.iter().filter(|edge| edge.to == fail && view.reached[edge.from]);
    edges.next().map(|edge| view.span(edge.cause))
}
