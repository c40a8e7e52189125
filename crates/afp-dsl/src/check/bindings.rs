//! Bindings of components: every input has a value of its port's type, every output a writable
//! entry.

mod alone;
mod generic;
mod outputs;
mod unknown_port;

use crate::check::formula::{Scope, of_constant};
use crate::check::range;
use crate::check::signature::{Input, Signature};
use crate::graph::{EntryKind, Formula, Output};
use crate::types::{Constant, Type};
use afp_syntax::ast::{self, Bind, Name};
use afp_syntax::diagnostics::{Code, Diagnostic, Diagnostics, Words, list};
use afp_syntax::message;
use afp_syntax::source::Span;
use rustc_hash::FxHashMap;

pub(crate) use alone::meant;
use generic::{Generic, actual};

pub(crate) struct Bound {
    /// A formula for each input port, and the connected outputs; `None` if there are errors.
    pub valid: Option<(Vec<Formula>, Vec<Output>)>,
    /// The type of `any` or `number`.
    pub generic: Option<Type>,
}

/// Place and completeness of a component.
pub(crate) struct Site {
    /// Name of its template.
    pub reference: Span,
    /// Whether there are syntax errors here, so that missing parts may not be complete yet.
    pub broken: bool,
}

pub(crate) fn check(
    scope: &Scope<'_>,
    signature: &Signature,
    binds: &[Bind],
    site: &Site,
    diags: &mut Diagnostics,
) -> Bound {
    let ports = find_ports(scope, signature, binds, diags);
    let inferred: Vec<_> = ports
        .inputs
        .iter()
        .map(|bound| bound.map(|formula| formula.and_then(|f| scope.infer(f, diags))))
        .collect();
    let generic = generic::decide(scope, signature, &inferred, &ports, diags);
    // An unknown port may be meant for a missing input.
    let broken = site.broken || !ports.complete;
    let inputs = inputs(scope, signature, inferred, &generic, &Site { broken, ..*site }, diags);
    let outputs = outputs::check(scope, signature, &ports, &generic, diags);
    let valid = inputs.zip(outputs);
    match generic {
        Generic::None => Bound { valid, generic: None },
        Generic::Is(ty) => Bound { valid, generic: Some(ty) },
        Generic::Unknown => Bound { valid: None, generic: None },
        Generic::Undecided => {
            if !site.broken {
                let message = message!("nothing decides the type of '{}'", signature.name);
                diags.push(
                    Diagnostic::new(Code::E0241, site.reference, message)
                        .help("bind one of its ports to a value or an entry"),
                );
            }
            Bound { valid: None, generic: None }
        }
    }
}

struct Ports<'a> {
    /// For each input: nothing, an invalid binding, or a formula.
    inputs: Vec<Option<Option<&'a ast::Formula>>>,
    /// For each bound output: its index, the entry, or the formula in its place.
    outputs: Vec<(usize, Option<&'a Name>, Option<&'a ast::Formula>)>,
    /// Whether every binding has a port.
    complete: bool,
}

/// Records the names in bindings of a component with an unknown template.
pub(crate) fn names_only(scope: &Scope<'_>, binds: &[Bind], diags: &mut Diagnostics) {
    // A reader of a table has its columns.
    let table = binds.iter().find_map(|bind| match bind {
        Bind::In { formula: Some(formula), .. } => scope.named_table(formula),
        _ => None,
    });
    for bind in binds {
        let port = bind.port();
        let mut columns = table.iter().flat_map(|table| &table.columns);
        match columns.find(|column| column.name == port.text) {
            Some(column) if bind.is_alone() => scope.record.alone(port.span, column.span),
            Some(column) if matches!(bind, Bind::Out { .. }) => {
                scope.record.definition(port.span, column.span);
            }
            _ => scope.record.unknown(port.span),
        }
        match bind {
            // The reader of a table may be unknown.
            Bind::In { formula: Some(formula), .. } if !scope.names_table(formula) => {
                scope.check(formula, None, diags);
            }
            _ => bound_names(scope, bind),
        }
    }
}

/// Records the names in an ignored binding.
pub(super) fn bound_names(scope: &Scope<'_>, bind: &Bind) {
    match bind {
        Bind::In { formula, .. } => formula.iter().for_each(|formula| scope.names_only(formula)),
        Bind::Out { entry, formula, .. } => {
            entry.iter().for_each(|entry| {
                scope.entry(entry);
            });
            formula.iter().for_each(|formula| scope.names_only(formula));
        }
    }
}

fn find_ports<'a>(
    scope: &Scope<'_>,
    signature: &Signature,
    binds: &'a [Bind],
    diags: &mut Diagnostics,
) -> Ports<'a> {
    let mut ports =
        Ports { inputs: vec![None; signature.inputs.len()], outputs: Vec::new(), complete: true };
    let mut bound: FxHashMap<&str, &Name> = FxHashMap::default();
    for bind in binds {
        let (Bind::In { port, sign, .. } | Bind::Out { port, sign, .. }) = bind;
        let alone = bind.is_alone();
        let input = signature.inputs.iter().position(|input| *input.name == *port.text);
        let output = signature.outputs.iter().position(|output| *output.name == *port.text);
        record_port(scope, signature, (port.span, alone), (input, output));
        if let Some(first) = bound.get(&*port.text) {
            diags.push(bound_twice(port, first));
            ports.complete = false;
            bound_names(scope, bind);
            continue;
        }
        bound.insert(&port.text, port);
        match (bind, input, output) {
            (_, None, None) if alone => {
                bound_names(scope, bind);
                ports.complete = false;
                diags.push(alone::without_port(scope, signature, binds, port));
            }
            (_, input, _) if alone && scope.indices.find(&port.text).is_none() => {
                bound_names(scope, bind);
                ports.complete = false;
                diags.push(alone::without_entry(bind));
                if let Some(index) = input {
                    ports.inputs[index] = Some(None);
                }
            }
            (Bind::In { formula, .. }, Some(index), _) => {
                ports.inputs[index] = Some(formula.as_ref());
            }
            (Bind::Out { entry, formula, .. }, _, Some(index)) => {
                ports.outputs.push((index, entry.as_ref(), formula.as_ref()));
            }
            (_, None, None) => {
                bound_names(scope, bind);
                ports.complete = false;
                diags.push(unknown_port::report(scope, signature, binds, bind));
            }
            (Bind::In { formula, .. }, None, Some(_)) => {
                bound_names(scope, bind);
                ports.complete = false;
                diags.push(output_for_an_input(scope, *sign, port, formula.as_ref()));
            }
            (Bind::Out { .. }, Some(_), None) => {
                bound_names(scope, bind);
                ports.complete = false;
                diags.push(mixed_up(*sign, port, "an input", "="));
            }
        }
    }
    ports
}

/// Records the meaning of a port's name, which may also be an entry's.
fn record_port(
    scope: &Scope<'_>,
    signature: &Signature,
    (name, alone): (Span, bool),
    (input, output): (Option<usize>, Option<usize>),
) {
    let declared = match (input, output) {
        (Some(place), _) => Some(signature.inputs[place].span),
        (None, place) => place.map(|place| signature.outputs[place].span),
    };
    match declared {
        Some(definition) if alone => scope.record.alone(name, definition),
        Some(definition) => scope.record.definition(name, definition),
        None => scope.record.unknown(name),
    }
}

fn bound_twice(port: &Name, first: &Name) -> Diagnostic {
    Diagnostic::new(Code::E0226, port.span, message!("'{}' is bound twice", port.text))
        .note(first.span, "first bound here")
        .help("remove one of them")
}

/// Reports a value for an output. If the value is a writable entry, only the sign is wrong.
fn output_for_an_input(
    scope: &Scope<'_>,
    sign: Span,
    port: &Name,
    value: Option<&ast::Formula>,
) -> Diagnostic {
    let error = mixed_up(sign, port, "an output", "=>");
    let entry = value.and_then(|value| scope.indices.find(scope.text_of(value.span())));
    let kind = entry.and_then(|entry| scope.entries.get(entry)).map(|entry| entry.kind);
    if value.is_none() || matches!(kind, Some(EntryKind::Var | EntryKind::Out)) {
        return error;
    }
    let help = message!("write '{} => ' and an entry of the plan that takes it", port.text);
    error.bare().help(help)
}

pub(super) fn mixed_up(sign: Span, port: &Name, is: &str, right: &str) -> Diagnostic {
    Diagnostic::new(Code::E0227, sign, message!("'{}' is {}", port.text, Words(is))).write(right)
}

fn inputs(
    scope: &Scope<'_>,
    signature: &Signature,
    inferred: Vec<Option<Option<Formula>>>,
    generic: &Generic,
    site: &Site,
    diags: &mut Diagnostics,
) -> Option<Vec<Formula>> {
    let mut missing = Vec::new();
    let mut formulas = Vec::new();
    for (input, formula) in signature.inputs.iter().zip(inferred) {
        let ty = actual(input.ty.as_ref(), generic);
        let formula = match formula {
            Some(formula) => formula.and_then(|typed| {
                let (formula, value) = scope.finish(typed, Some(ty?), input.range, diags)?;
                if let Some(error) = out_of_range(scope, input, ty?, &formula, value) {
                    diags.push(error);
                }
                Some(formula)
            }),
            None if !input.optional => {
                missing.push(input);
                None
            }
            None => input.default.clone().and_then(|value| of_constant(value, ty?, input.span)),
        };
        formulas.push(formula);
    }
    if !missing.is_empty() && !site.broken {
        diags.push(without_value(signature, &missing, site));
    }
    formulas.into_iter().collect()
}

fn without_value(signature: &Signature, missing: &[&Input], site: &Site) -> Diagnostic {
    let names = list(missing.iter().map(|input| &*input.name), "and");
    let verb = if missing.len() == 1 { "has" } else { "have" };
    let examples: Vec<_> = missing
        .iter()
        .map(|input| format!("{} = {}", input.name, example(input.ty.as_ref())))
        .collect();
    let message = message!("{} of '{}' {} no value", names, signature.name, Words(verb));
    Diagnostic::new(Code::E0225, site.reference, message)
        .note(missing[0].span, "declared here without a default")
        .help(message!("bind every input, such as '({})'", examples.join(", ")))
}

fn example(ty: Option<&Type>) -> String {
    match ty {
        Some(Type::Bool) => "true".to_owned(),
        Some(Type::Quantity(dimension)) => {
            format!("1 {}", dimension.usual_unit()).trim_end().to_owned()
        }
        Some(Type::Text) => "\"...\"".to_owned(),
        Some(Type::Enum(home)) => {
            format!("{}.{}", home.name, home.variants.first().map_or("...", String::as_str))
        }
        Some(Type::Object(_)) => "entry".to_owned(),
        Some(Type::Int | Type::Any | Type::Number | Type::Discrete) | None => "1".to_owned(),
    }
}

/// Reports a known value outside its port's range, also from the defaults of the plan's inputs.
fn out_of_range(
    scope: &Scope<'_>,
    input: &Input,
    ty: &Type,
    formula: &Formula,
    value: Option<Constant>,
) -> Option<Diagnostic> {
    let (range, name) = (input.range?, &input.name);
    let error = match &value {
        Some(value) => range::outside(value, range, ty, formula.span, |value| {
            message!("'{}' is out of the range of '{}'", value, name)
        }),
        None => {
            range::outside(&scope.value_by_default(formula)?, range, ty, formula.span, |value| {
                message!("by default '{}' is '{}', which is out of its range", name, value)
            })
        }
    };
    let error = error?.note(input.span, "the range is declared here");
    let read = formula.entries().filter_map(|(id, _)| scope.entries.get(id.index()));
    let defaults = read.filter(|entry| entry.kind == EntryKind::In);
    Some(defaults.fold(error, |error, entry| error.note(entry.name.span, "this is its default")))
}
