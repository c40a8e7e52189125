//! Loops of computations that count further than one step may go.

use crate::flow::view::{Cause, Node, View};
use crate::graph::{Component, Element};
use crate::toolbox::Constant;
use afp_syntax::diagnostics::{Code, Diagnostic, Diagnostics};

/// Edges that may be taken in one step, `MAX_TRANSITIONS_PER_STEP` of the run time.
const MAX_TRANSITIONS: i64 = 1000;
/// The state in which `Count` goes on.
const AGAIN: u16 = 0;

/// Warns of a cycle whose counter has a constant limit that is too large. `edges` is the length of
/// the cycle; one with several ways round may be shorter than it seems and is left alone.
pub(super) fn check(view: &View<'_>, members: &[Node], edges: usize, diags: &mut Diagnostics) {
    if edges != members.len() {
        return;
    }
    let elements = members.iter().filter_map(|node| view.element(*node));
    let counters: Vec<_> =
        elements.filter_map(|element| Some((element, limit(view, element)?))).collect();
    let [(element, limit)] = counters.as_slice() else { return };
    let length = i64::try_from(edges).unwrap_or(i64::MAX);
    // The last one leads out of the cycle.
    if limit.saturating_mul(length) < MAX_TRANSITIONS {
        return;
    }
    let message = format!(
        "'{}' goes round {limit} times within one step, which may take at most {MAX_TRANSITIONS} edges",
        element.name
    );
    let span = element.inputs.get(1).map_or(element.span, |limit| limit.span);
    diags.push(Diagnostic::new(Code::E0312, span, message).help(format!(
        "count at most to {}, or put an actor such as 'Wait' into the loop",
        (MAX_TRANSITIONS - 1) / length
    )));
}

/// Whether an edge is taken a limited number of times only: a counter goes round again.
pub(super) fn is_bounded(view: &View<'_>, cause: Cause) -> bool {
    let Cause::State(id, AGAIN) = cause else { return false };
    limit(view, &view.plan.elements[id.index()]).is_some_and(|limit| limit < MAX_TRANSITIONS)
}

/// How far a `Count` of the standard toolbox counts, where that is written.
pub(super) fn limit(view: &View<'_>, element: &Element) -> Option<i64> {
    let Component::Computation(id) = element.component else { return None };
    let toolbox = &view.model.toolboxes[id.toolbox.index()];
    if toolbox.name != "std" || view.model.template(id).name != "Count" {
        return None;
    }
    match view.constant(element.inputs.get(1)?)? {
        Constant::Int(limit) => Some(limit),
        _ => None,
    }
}
