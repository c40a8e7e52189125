//! The edge of an element without braces, which names no state.

use super::WrittenEdge;
use crate::check::signature::Signature;
use afp_syntax::ast::Name;
use afp_syntax::diagnostics::{Code, Diagnostic, Diagnostics, list};
use afp_syntax::message;

/// Gives an edge without a name the state that it is for: the only one that has to be connected. If there are more,
/// which is reported, it is for all of them.
pub(crate) fn name(edges: &mut Vec<WrittenEdge>, signature: &Signature, diags: &mut Diagnostics) {
    let Some(at) = edges.iter().position(WrittenEdge::is_nameless) else { return };
    let states: Vec<_> = signature.required().collect();
    let edge = &edges[at];
    several_states(edge, &states, signature).into_iter().for_each(|error| diags.push(error));
    let named = |state: &&str| WrittenEdge {
        name: Name { text: (*state).to_owned(), span: edge.name.span },
        target: edge.target.clone(),
        reason: edge.reason.clone(),
        span: edge.span,
    };
    let named: Vec<_> = states.iter().map(named).collect();
    if !named.is_empty() {
        edges.splice(at..=at, named);
    }
}

/// The error of an edge without a name, if its element does not have exactly one state.
fn several_states(
    edge: &WrittenEdge,
    states: &[&str],
    signature: &Signature,
) -> Option<Diagnostic> {
    let error = |message| Diagnostic::new(Code::E0255, edge.span, message);
    match (states, &edge.target) {
        ([], _) => {
            let message = message!("'{}' has no state that this edge could be for", signature.name);
            Some(error(message).help("write braces with a supervisor that ends it").replace("{}"))
        }
        ([_], _) | (_, None) => None,
        (_, Some(to)) => {
            let named = list(states.iter().copied(), "and");
            let message =
                message!("the edge is for one state, but '{}' has {}", signature.name, named);
            let reason = edge.reason.iter().map(|reason| format!(" {}", reason.text));
            let target: String = std::iter::once(to.text.clone()).chain(reason).collect();
            Some(error(message).write(format!("{{ {} -> {target} }}", states.join(", "))))
        }
    }
}
