//! Short bindings: `goal` for `goal = goal`, or for `goal => goal` if the port is an output.

use std::borrow::Cow;

use super::unknown_port;
use crate::check::formula::Scope;
use crate::check::signature::{Input, Signature};
use afp_syntax::ast::{Bind, Name};
use afp_syntax::diagnostics::{Code, Diagnostic, Message, Sought, list, words};
use afp_syntax::message;

/// The bindings, with short ones for outputs as outputs.
pub(crate) fn meant<'b>(signature: &Signature, binds: &'b [Bind]) -> Cow<'b, [Bind]> {
    let is_output = |bind: &Bind| {
        let port = &bind.port().text;
        bind.is_alone()
            && !signature.inputs.iter().any(|input| *input.name == **port)
            && signature.outputs.iter().any(|output| *output.name == **port)
    };
    if !binds.iter().any(is_output) {
        return Cow::Borrowed(binds);
    }
    let meant = |bind: &Bind| if is_output(bind) { bind.as_output() } else { bind.clone() };
    binds.iter().map(meant).collect()
}

/// Reports a name that is not a port. It may be meant for an unbound port.
pub(super) fn without_port(
    scope: &Scope<'_>,
    signature: &Signature,
    binds: &[Bind],
    name: &Name,
) -> Diagnostic {
    let message = message!("'{}' has no port '{}'", signature.name, name.text);
    let error = Diagnostic::new(Code::E0202, name.span, message);
    if let Some(error) = unknown_port::of_inside(signature, &name.text, "in", &error) {
        return error;
    }
    let Some(entry) = scope.indices.find(&name.text).map(|index| &scope.entries[index]) else {
        let inputs = signature.inputs.iter().map(|input| &*input.name);
        let outputs = signature.outputs.iter().map(|output| &*output.name);
        let near = words::nearest(&name.text, inputs.clone().chain(outputs));
        return error.help(match near {
            Some(port) => to_write(port, !inputs.clone().any(|input| input == port)),
            None => "write the port's name and '=' before the value".into(),
        });
    };
    let is_open = |input: &&Input| !binds.iter().any(|bind| *bind.port().text == *input.name);
    let open: Vec<&Input> = signature.inputs.iter().filter(is_open).collect();
    let mut fitting = open.iter().filter(|input| input.ty.is_some() && input.ty == entry.ty);
    match (fitting.next(), fitting.next()) {
        (Some(input), None) => {
            let better = format!("{} = {}", input.name, name.text);
            error.write(better)
        }
        _ if open.is_empty() => error.help("remove it"),
        _ => {
            let open = list(open.iter().map(|input| &*input.name), "or");
            error.help(message!("write {} and '=' before it", open))
        }
    }
}

/// Reports a short binding without an entry of that name.
pub(super) fn without_entry(bind: &Bind) -> Diagnostic {
    let Name { text: name, span } = bind.port();
    let message = message!("there is no entry '{}' for the port of that name", name);
    Diagnostic::new(Code::E0209, *span, message)
        .unknown(Sought::Entry, name)
        .help(to_write(name, matches!(bind, Bind::Out { .. })))
}

/// The syntax after a port's name.
fn to_write(port: &str, is_output: bool) -> Message {
    match is_output {
        false => message!("write '{} = ' and the value", port),
        true => message!("write '{} => ' and an entry", port),
    }
}
