//! Bindings of unknown ports, and their likely meanings.

use crate::check::formula::Scope;
use crate::check::names::offer;
use crate::check::signature::{Signature, SignatureKind};
use crate::graph::EntryKind;
use crate::toolbox::TemplateKind;
use afp_syntax::ast::Bind;
use afp_syntax::diagnostics::{Code, Diagnostic, Message, words};
use afp_syntax::message;

/// Ports for a time limit in other languages.
const LIMITS: &[&str] =
    &["timeout", "time", "time_limit", "timelimit", "max_time", "limit", "duration", "deadline"];

fn time_limit(value: &str) -> Message {
    let unit = if value.parse::<f64>().is_ok() { " s" } else { "" };
    let duration = format!("{value}{unit}");
    message!(
        "remove it, and write in the braces: 'supervise late: CheckTimeout(duration = {}) {{ TimedOut -> terminate }}'",
        duration
    )
}

/// The message about a binding with an unknown port, one of several.
pub(super) fn report(
    scope: &Scope<'_>,
    signature: &Signature,
    binds: &[Bind],
    bind: &Bind,
) -> Diagnostic {
    let port = bind.port();
    let message = message!("'{}' has no port '{}'", signature.name, port.text);
    let word = if matches!(bind, Bind::In { .. }) { "in" } else { "out" };
    let error = Diagnostic::new(Code::E0202, port.span, message);
    if let Some(error) = of_inside(signature, &port.text, word, &error) {
        return error;
    }
    let inputs = signature.inputs.iter().map(|input| &*input.name);
    let outputs = signature.outputs.iter().map(|output| &*output.name);
    let known: Vec<_> = match bind {
        Bind::In { .. } => inputs.collect(),
        Bind::Out { .. } => outputs.collect(),
    };
    if words::nearest(&port.text, known.iter().copied()).is_none()
        && let Bind::In { formula: Some(formula), .. } = bind
    {
        let value = scope.text_of(formula.span());
        if let Some(better) = assignment(scope, signature, binds, bind, value) {
            let place = port.span.to(formula.span());
            return error.write_at(place, better);
        }
        if LIMITS.contains(&&*port.text)
            && signature.kind == SignatureKind::Template(TemplateKind::Actor)
            && !known.iter().any(|known| LIMITS.contains(known))
        {
            return error.elsewhere(time_limit(value));
        }
        let is_time = matches!(port.text.as_str(), "every" | "deadline");
        let watches = signature.kind == SignatureKind::Template(TemplateKind::Supervisor);
        if is_time && watches {
            let name = &signature.name;
            let help =
                message!("write '{} {}' after '{}' and its brackets", port.text, value, name);
            return error.help(help);
        }
    }
    offer(error, &port.text, known, "remove the binding")
}

/// Explains that an entry of a sub-plan is not a port, in addition to an error.
pub(super) fn of_inside(
    signature: &Signature,
    name: &str,
    word: &str,
    error: &Diagnostic,
) -> Option<Diagnostic> {
    let (_, kind, place) = signature.inner.iter().find(|(inner, ..)| inner == name)?;
    let kind = kind.word();
    let note = message!("a '{}' of '{}', which other plans cannot see", kind, signature.name);
    let help = message!("declare '{}' with '{}' instead of '{}' there", name, word, kind);
    Some(error.bare().note(*place, note).help(help))
}

/// `Assign(a = 7)` with an entry `a`: the correct assignment.
fn assignment(
    scope: &Scope<'_>,
    signature: &Signature,
    binds: &[Bind],
    bind: &Bind,
    value: &str,
) -> Option<String> {
    let ([input], [output], [_]) = (&*signature.inputs, &*signature.outputs, binds) else {
        return None;
    };
    let entry = &bind.port().text;
    let kind = scope.entries.get(scope.indices.find(entry)?)?.kind;
    if !matches!(kind, EntryKind::Var | EntryKind::Out) {
        return None;
    }
    Some(format!("{} = {value}, {} => {entry}", input.name, output.name))
}
