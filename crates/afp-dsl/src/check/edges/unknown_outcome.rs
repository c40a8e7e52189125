//! Edges for names that the component does not have.

use super::{DEADLINE_MISSED, ERROR, Origin};
use crate::check::names::unknown;
use afp_syntax::ast::Name;
use afp_syntax::diagnostics::{Code, Diagnostic, Words};
use afp_syntax::habits::{STATES, ours};
use afp_syntax::message;

/// The error for an unknown state or event, and the number of outcomes that it may stand for.
pub(super) fn unknown_outcome(
    origin: &Origin<'_>,
    missing: &[&str],
    name: &Name,
) -> (Diagnostic, usize) {
    if is_rest(&name.text) {
        let message =
            message!("edges have no '{}': each state and event has its own edge", name.text);
        let error = Diagnostic::new(Code::E0210, name.span, message);
        return match missing.len() {
            0 => (error.help("remove it: all of them have one"), 0),
            many => (error.write(missing.join(", ")), many),
        };
    }
    // 'OK' of an actor probably means its state.
    let added = matches!(name.text.as_str(), ERROR | DEADLINE_MISSED);
    (of_no_outcome(origin, name), usize::from(!added))
}

/// Whether the word means all remaining states in other languages.
fn is_rest(name: &str) -> bool {
    matches!(name, "else" | "otherwise" | "default" | "any" | "sonst" | "sinon" | "_")
}

fn of_no_outcome(origin: &Origin<'_>, name: &Name) -> Diagnostic {
    let word = if origin.supervisor { "event" } else { "state" };
    let message = message!("'{}' has no {} '{}'", origin.signature.name, Words(word), name.text);
    if origin.supervisor && name.text == ERROR {
        let help = "remove it: if a supervisor fails, its element takes its 'Error' edge, or the plan ends in 'Error'";
        return Diagnostic::new(Code::E0210, name.span, message).help(help);
    }
    let own = &origin.signature.outcomes;
    let without_edge = match name.text.to_ascii_lowercase().as_str() {
        "running" => Some("remove the edge: an element that runs stays active without one"),
        "preempted" | "cancelled" | "canceled" | "recalled" | "interrupted" => {
            Some("remove the edge: the event that interrupts an element has its own")
        }
        _ => None,
    };
    if let Some(help) = without_edge.filter(|_| !origin.supervisor) {
        return Diagnostic::new(Code::E0210, name.span, message).help(help);
    }
    let meant = match (ours(STATES, &name.text), own.as_slice()) {
        (Some("Error"), _) => Some(ERROR),
        (Some(_), [only]) => Some(&**only),
        (Some(ok), own) if own.iter().any(|own| **own == *ok) => Some(ok),
        _ => None,
    };
    if let Some(meant) = meant.filter(|_| !origin.supervisor) {
        return Diagnostic::new(Code::E0210, name.span, message).write(meant);
    }
    let known = own.iter().map(|outcome| &**outcome).chain([origin.extra()]);
    unknown(Code::E0210, name.span, message, &name.text, known, "remove the edge")
}
