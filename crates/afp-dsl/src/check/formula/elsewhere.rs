//! Unknown names in formulas, and their meanings in other languages.

use super::Scope;
use crate::check::names::{offer, unknown};
use afp_syntax::ast;
use afp_syntax::diagnostics::{Code, Diagnostic, Sought, list, words};
use afp_syntax::message;
use afp_syntax::source::Span;

/// Words before the name of a variable in other languages.
const OWN: &[&str] = &[
    "self",
    "this",
    "blackboard",
    "bb",
    "context",
    "ctx",
    "data",
    "userdata",
    "msg",
    "params",
    "vars",
];

/// The message about a name that is a value in other languages.
fn elsewhere(error: &Diagnostic, name: &str) -> Option<Diagnostic> {
    let error = error.clone();
    Some(match name {
        "pi" | "PI" | "Pi" | "M_PI" => {
            error.help("write '180 deg' for the angle, '3.141592653589793' for the number")
        }
        "None" | "none" | "null" | "NULL" | "nil" | "nullptr" | "undefined" => {
            error.elsewhere("remove it and the '=': a 'var' has no value until one is written")
        }
        "HIGH" | "ON" | "On" | "yes" | "YES" | "Yes" => error.write("true"),
        "LOW" | "OFF" | "Off" | "no" | "NO" | "No" => error.write("false"),
        _ => return None,
    })
}

/// Reports a name before a dot that is not an enum.
pub(super) fn unknown_enum(
    scope: &Scope<'_>,
    home: &ast::Name,
    name: &ast::Name,
    span: Span,
) -> Diagnostic {
    let ports =
        || scope.entries.iter().map(|entry| &*entry.name.text).filter(|it| it.contains('.'));
    let qualified = format!("{}.{}", home.text, name.text);
    if words::nearest(&qualified, ports()).is_some() {
        let message = message!("there is no port '{}'", qualified);
        return unknown(Code::E0209, span, message, &qualified, ports(), "");
    }
    let known = scope.types.enums.iter().map(|(_, each)| each.name.as_str());
    let message = message!("there is no enum '{}'", home.text);
    let error = Diagnostic::new(Code::E0239, home.span, message);
    if let Some(error) = scope.types.hidden(&home.text, &error) {
        return error;
    }
    if OWN.contains(&home.text.as_str()) && scope.indices.find(&name.text).is_some() {
        let message = message!("entries have no prefix '{}'", home.text);
        return Diagnostic::new(Code::E0239, span, message).write(&*name.text);
    }
    if words::nearest(&home.text, known.clone()).is_none()
        && let Some(error) = elsewhere(&error, &name.text)
    {
        return error;
    }
    let readable = scope.entries.iter().enumerate().filter(|(at, _)| (scope.readable)(*at));
    let entries: Vec<_> = readable.map(|(_, entry)| entry.name.text.as_str()).take(3).collect();
    let none = match *entries {
        [] => "declare it in the file".into(),
        _ => message!("declare it in the file, or write an entry: {}", list(entries, "or")),
    };
    offer(error, &home.text, known, none)
}

/// Names the source of random numbers.
pub(super) fn random(error: Diagnostic) -> Diagnostic {
    error.elsewhere("draw the number with the computation 'Random' of 'std'")
}

/// The error of an unknown entry, without its help.
pub(super) fn no_entry(name: &ast::Name) -> Diagnostic {
    let message = message!("there is no entry '{}'", name.text);
    Diagnostic::new(Code::E0209, name.span, message).unknown(Sought::Entry, &name.text)
}

pub(super) fn unknown_entry(scope: &Scope<'_>, name: &ast::Name) -> Diagnostic {
    if let Some(table) = scope.table(name) {
        let message = message!("'{}' is a table, not a value", name.text);
        return Diagnostic::new(Code::E0209, name.span, message)
            .note(table.span, "declared here")
            .elsewhere("read its rows with 'Row' of 'std', and use its outputs");
    }
    let error = no_entry(name);
    let home = scope.types.enums.iter().find(|(_, home)| home.variants.contains(&name.text));
    if let Some((_, home)) = home {
        let better = format!("{}.{}", home.name, name.text);
        return error.write(better);
    }
    let constant = ["true", "false"].into_iter().find(|it| it.eq_ignore_ascii_case(&name.text));
    if let Some(constant) = constant {
        return error.write(constant);
    }
    let readable = scope.entries.iter().enumerate().filter(|(at, _)| (scope.readable)(*at));
    let known = readable.map(|(_, entry)| entry.name.text.as_str());
    if !known.clone().any(|entry| entry.eq_ignore_ascii_case(&name.text))
        && let Some(error) = elsewhere(&error, &name.text)
    {
        return error;
    }
    // Only toolboxes have generic types, and they have no entries.
    let none = match scope.entries {
        _ if scope.types.generic => "write a value",
        [] if !scope.unreadable.is_empty() => scope.unreadable,
        _ => "declare it in the plan",
    };
    offer(error, &name.text, known, none)
}
