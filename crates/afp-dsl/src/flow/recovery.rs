//! Global supervisors that would start their own recovery again.
//!
//! An event of a global supervisor is not taken while its target is active, so a lasting condition
//! lets one element finish. Elements behind it that only this event leads to are part of the same
//! recovery, and there it is taken: the recovery begins anew, for ever. A computation is over at once,
//! so behind one the first actor is such an element already.

use crate::flow::dataflow::{WIDTH, propagate};
use crate::flow::view::{Cause, View, takes_time};
use afp_syntax::diagnostics::{Code, Diagnostic, Diagnostics};

/// Warns of each such event, at its edge.
pub(super) fn check(view: &View<'_>, diags: &mut Diagnostics) {
    let anywhere = view.anywhere();
    if !view.reached[anywhere] {
        return;
    }
    let events: Vec<usize> = view
        .range(anywhere)
        .filter(|at| matches!(view.edges[*at].cause, Cause::Event(..)))
        .collect();
    for group in events.chunks(WIDTH) {
        let mut stops = vec![0u64; view.edges.len()];
        for (bit, at) in group.iter().enumerate() {
            stops[*at] = 1 << bit;
        }
        let without = propagate(view, u64::MAX, &stops);
        for (bit, at) in group.iter().enumerate() {
            report(view, *at, |node| without[node] >> bit & 1 == 0, diags);
        }
    }
}

/// `only` tells which nodes can be reached by the event alone.
fn report(view: &View<'_>, at: usize, only: impl Fn(usize) -> bool, diags: &mut Diagnostics) {
    let edge = &view.edges[at];
    let Some(target) = view.element(edge.to).filter(|_| only(edge.to)) else { return };
    let behind = |node: usize| node != edge.to && only(node);
    let mut recovery = view.elements().filter(|(node, other)| behind(*node) && takes_time(other));
    let Some((_, other)) = recovery.next() else { return };
    let label = view.label(edge.cause);
    let (first, next) = (&target.name, &other.name);
    let message =
        format!("'{label}' leads to '{first}', and starts it again while '{next}' runs after it");
    diags.push(
        Diagnostic::new(Code::E0309, view.span(edge.cause), message)
            .note(other.span, "only this event leads here, and it may still hold")
            .help(format!("put '{first}' and '{next}' into one sub-plan and lead the event to it")),
    );
}
