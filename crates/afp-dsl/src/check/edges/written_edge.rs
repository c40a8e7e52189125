//! Edges as written; an element without braces has an edge without a state.

use crate::check::signature::Signature;
use afp_syntax::ast::{Edge, Name};
use afp_syntax::diagnostics::{Code, Diagnostic, Diagnostics, list};
use afp_syntax::message;
use afp_syntax::source::Span;

pub(crate) struct WrittenEdge {
    pub name: Name,
    /// The word `suspend` before the target, if written.
    pub suspends: Option<Span>,
    pub target: Option<Name>,
    /// The text after `fail`, including quotes.
    pub reason: Option<Name>,
    /// The name; for the last of several, the rest of the edge.
    pub span: Span,
}

impl WrittenEdge {
    /// Edges, one for each state or event. An edge without a name has an empty name until [`name`]
    /// is called.
    pub fn read(edges: Vec<Edge>) -> Vec<WrittenEdge> {
        let mut written = Vec::with_capacity(edges.len());
        for edge in edges {
            let end = edge.end();
            let Edge { mut names, arrow, suspends, target, reason } = edge;
            // A foreign arrow has no span.
            let arrow = arrow.or_else(|| target.as_ref().map(|to| to.span.before()));
            let nameless = arrow.map(|span| Name { text: String::new(), span });
            let Some(last) = names.pop().or(nameless) else { continue };
            written.extend(names.into_iter().map(|name| WrittenEdge {
                span: name.span,
                name,
                suspends,
                target: target.clone(),
                reason: reason.clone(),
            }));
            let span = last.span.to(end.unwrap_or(last.span));
            written.push(WrittenEdge { span, name: last, suspends, target, reason });
        }
        written
    }

    pub(super) fn is_nameless(&self) -> bool {
        self.name.text.is_empty()
    }
}

/// Names an edge without a name: the only state that must be connected. If there are several, which
/// is reported, it is for all.
pub(crate) fn name(edges: &mut Vec<WrittenEdge>, signature: &Signature, diags: &mut Diagnostics) {
    let Some(at) = edges.iter().position(WrittenEdge::is_nameless) else { return };
    let states: Vec<_> = signature.required().collect();
    let edge = &edges[at];
    several_states(edge, &states, signature).into_iter().for_each(|error| diags.push(error));
    let named = |state: &&str| WrittenEdge {
        name: Name { text: (*state).to_owned(), span: edge.name.span },
        suspends: edge.suspends,
        target: edge.target.clone(),
        reason: edge.reason.clone(),
        span: edge.span,
    };
    let named: Vec<_> = states.iter().map(named).collect();
    if !named.is_empty() {
        edges.splice(at..=at, named);
    }
}

/// Reports an edge without a name if its element does not have exactly one state.
fn several_states(
    edge: &WrittenEdge,
    states: &[&str],
    signature: &Signature,
) -> Option<Diagnostic> {
    let error = |message| Diagnostic::new(Code::E0255, edge.span, message);
    match (states, &edge.target) {
        ([], _) => {
            let message = message!("'{}' has no state for this edge", signature.name);
            Some(error(message).help("write braces with a supervisor that ends it").replace("{}"))
        }
        ([_], _) | (_, None) => None,
        (_, Some(to)) => {
            let named = list(states.iter().copied(), "and");
            let message =
                message!("the edge is for one state, but '{}' has {}", signature.name, named);
            let reason = edge.reason.iter().map(|reason| format!(" {}", reason.text));
            let word = edge.suspends.map(|_| "suspend ".to_owned());
            let target: String = word.into_iter().chain([to.text.clone()]).chain(reason).collect();
            Some(error(message).write(format!("{{ {} -> {target} }}", states.join(", "))))
        }
    }
}
