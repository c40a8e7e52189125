//! What goes into and comes out of a component: every input has a value of its port's type, every
//! output an entry that may be written.

use crate::check::convert::{conversion, remark};
use crate::check::formula::{Scope, of_constant};
use crate::check::names::unknown;
use crate::check::signature::{Input, Signature};
use crate::diagnostics::{Code, Diagnostic, Diagnostics};
use crate::graph::{EntryId, EntryKind, Formula, Output};
use crate::source::Span;
use crate::syntax::ast::{self, Bind, Name};
use crate::toolbox::Constant;
use crate::types::Type;
use crate::words::{self, a_type};

/// The checked bindings of a component.
pub(crate) struct Bound {
    /// One formula for each input port.
    pub inputs: Vec<Formula>,
    /// The connected outputs.
    pub outputs: Vec<Output>,
    /// The type that stands for `any` or `number`.
    pub generic: Option<Type>,
}

/// Where a component stands and how much of it is there.
pub(crate) struct Site {
    /// The name of its template.
    pub reference: Span,
    /// Whether the text has syntax errors here, so that what is missing may only be half typed.
    pub broken: bool,
}

/// Checks the bindings of one component; `None` when something is wrong with them.
pub(crate) fn check(
    scope: &Scope<'_>,
    signature: &Signature,
    binds: &[Bind],
    site: &Site,
    diags: &mut Diagnostics,
) -> Option<Bound> {
    let ports = find_ports(signature, binds, diags);
    let inferred: Vec<_> = ports
        .inputs
        .iter()
        .map(|bound| bound.map(|formula| formula.and_then(|f| scope.infer(f, diags))))
        .collect();
    let generic = generic(scope, signature, &inferred, &ports, diags);
    let inputs = inputs(scope, signature, inferred, &generic, site, diags);
    let outputs = outputs(scope, signature, &ports, &generic, diags);
    let generic = match generic {
        Generic::None => None,
        Generic::Is(ty) => Some(ty),
        Generic::Unknown => return None,
        Generic::Undecided => {
            if !site.broken {
                let message = format!("nothing decides the type of '{}'", signature.name);
                diags.push(
                    Diagnostic::new(Code::E0241, site.reference, message)
                        .help("bind one of its ports to a value or an entry"),
                );
            }
            return None;
        }
    };
    Some(Bound { inputs: inputs?, outputs: outputs?, generic })
}

/// The bindings, sorted by port.
struct Ports<'a> {
    /// For each input: nothing, a hole, or a formula.
    inputs: Vec<Option<Option<&'a ast::Formula>>>,
    /// For each output that is bound: its place, the entry, and what stands there instead of one.
    outputs: Vec<(usize, Option<&'a Name>, Option<&'a ast::Formula>)>,
    /// Whether every binding found its port.
    complete: bool,
}

fn find_ports<'a>(signature: &Signature, binds: &'a [Bind], diags: &mut Diagnostics) -> Ports<'a> {
    let mut ports =
        Ports { inputs: vec![None; signature.inputs.len()], outputs: Vec::new(), complete: true };
    let mut seen: Vec<&Name> = Vec::new();
    for bind in binds {
        let (Bind::In { port, sign, .. } | Bind::Out { port, sign, .. }) = bind;
        if let Some(first) = seen.iter().find(|known| known.text == port.text) {
            diags.push(
                Diagnostic::new(Code::E0226, port.span, format!("'{}' is bound twice", port.text))
                    .note(first.span, "first bound here")
                    .help("remove one of them"),
            );
            ports.complete = false;
            continue;
        }
        seen.push(port);
        let input = signature.inputs.iter().position(|input| input.name == port.text);
        let output = signature.outputs.iter().position(|output| output.name == port.text);
        match (bind, input, output) {
            (Bind::In { formula, .. }, Some(place), _) => {
                ports.inputs[place] = Some(formula.as_ref());
            }
            (Bind::Out { entry, formula, .. }, _, Some(place)) => {
                ports.outputs.push((place, entry.as_ref(), formula.as_ref()));
            }
            (_, None, None) => {
                ports.complete = false;
                diags.push(unknown_port(signature, bind, port));
            }
            (Bind::In { .. }, None, Some(_)) => {
                ports.complete = false;
                diags.push(mixed_up(*sign, port, "an output", "=>"));
            }
            (Bind::Out { .. }, Some(_), None) => {
                ports.complete = false;
                diags.push(mixed_up(*sign, port, "an input", "="));
            }
        }
    }
    ports
}

fn mixed_up(sign: Span, port: &Name, is: &str, right: &str) -> Diagnostic {
    Diagnostic::new(Code::E0227, sign, format!("'{}' is {is}", port.text))
        .help(format!("write '{right}'"))
        .replace(right)
}

fn unknown_port(signature: &Signature, bind: &Bind, port: &Name) -> Diagnostic {
    let message = format!("'{}' has no port '{}'", signature.name, port.text);
    let inputs = signature.inputs.iter().map(|input| input.name.as_str());
    let outputs = signature.outputs.iter().map(|output| output.name.as_str());
    let known: Vec<_> = match bind {
        Bind::In { .. } => inputs.collect(),
        Bind::Out { .. } => outputs.collect(),
    };
    unknown(Code::E0202, port.span, message, &port.text, known, "remove the binding")
}

/// What stands for `any` or `number` in one instance.
enum Generic {
    /// The template has no such port.
    None,
    /// This type.
    Is(Type),
    /// Something is wrong, and reported.
    Unknown,
    /// No port is bound.
    Undecided,
}

fn is_generic(ty: Option<&Type>) -> bool {
    matches!(ty, Some(Type::Any | Type::Number))
}

fn generic(
    scope: &Scope<'_>,
    signature: &Signature,
    inferred: &[Option<Option<Formula>>],
    ports: &Ports<'_>,
    diags: &mut Diagnostics,
) -> Generic {
    let declared = signature.inputs.iter().map(|input| input.ty.as_ref());
    let declared = declared.chain(signature.outputs.iter().map(|output| output.ty.as_ref()));
    let mut declared = declared.filter(|ty| is_generic(*ty)).peekable();
    if declared.peek().is_none() {
        return Generic::None;
    }
    let needs_number = declared.any(|ty| ty == Some(&Type::Number));
    let mut decided: Option<(Type, Span)> = None;
    for (input, formula) in signature.inputs.iter().zip(inferred) {
        let Some(formula) = formula.as_ref().filter(|_| is_generic(input.ty.as_ref())) else {
            continue;
        };
        let Some(formula) = formula else { return Generic::Unknown };
        decided = match decided {
            Some((Type::Int, span)) if formula.ty == Type::FLOAT => Some((Type::FLOAT, span)),
            Some(decided) => Some(decided),
            None => Some((formula.ty.clone(), formula.span)),
        };
    }
    let has_inputs = signature.inputs.iter().any(|input| is_generic(input.ty.as_ref()));
    if decided.is_none() && !has_inputs {
        for (place, entry, _) in &ports.outputs {
            let Some(entry) = entry.filter(|_| is_generic(signature.outputs[*place].ty.as_ref()))
            else {
                continue;
            };
            let found = scope.entries.iter().find(|known| known.name.text == entry.text);
            let Some(ty) = found.and_then(|found| found.ty.clone()) else {
                return Generic::Unknown;
            };
            decided = decided.or(Some((ty, entry.span)));
        }
    }
    let Some((ty, span)) = decided else {
        // An input without a value is reported as such.
        return if has_inputs || !ports.complete { Generic::Unknown } else { Generic::Undecided };
    };
    if needs_number && !ty.is_numeric() {
        let message = format!("expected a number, found {}", a_type(&ty));
        diags.push(
            Diagnostic::new(Code::E0206, span, message).help("use an int, a float or a quantity"),
        );
        return Generic::Unknown;
    }
    Generic::Is(ty)
}

/// The type of a port in this instance.
fn actual<'a>(declared: Option<&'a Type>, generic: &'a Generic) -> Option<&'a Type> {
    match (declared, generic) {
        (Some(Type::Any | Type::Number), Generic::Is(ty)) => Some(ty),
        (Some(Type::Any | Type::Number) | None, _) => None,
        (declared, _) => declared,
    }
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
                let (formula, value) = scope.finish(typed, Some(ty?), diags)?;
                check_range(input, ty?, &formula, value, diags);
                Some(formula)
            }),
            None if !input.optional => {
                missing.push(input);
                None
            }
            None => {
                input.default.clone().and_then(|value| Some(of_constant(value, ty?, input.span)))
            }
        };
        formulas.push(formula);
    }
    if !missing.is_empty() && !site.broken {
        diags.push(without_value(signature, &missing, site));
    }
    formulas.into_iter().collect()
}

fn without_value(signature: &Signature, missing: &[&Input], site: &Site) -> Diagnostic {
    let names = words::list(missing.iter().map(|input| input.name.as_str()), "and");
    let verb = if missing.len() == 1 { "has" } else { "have" };
    let examples: Vec<_> = missing
        .iter()
        .map(|input| format!("{} = {}", input.name, example(input.ty.as_ref())))
        .collect();
    let message = format!("{names} of '{}' {verb} no value", signature.name);
    Diagnostic::new(Code::E0225, site.reference, message)
        .note(missing[0].span, "declared here without a default")
        .help(format!("bind every input, such as '({})'", examples.join(", ")))
}

/// How a value of the type may look.
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
        Some(Type::Int | Type::Any | Type::Number) | None => "1".to_owned(),
    }
}

/// Reports a known value outside of its port's range.
pub(crate) fn check_range(
    input: &Input,
    ty: &Type,
    formula: &Formula,
    value: Option<Constant>,
    diags: &mut Diagnostics,
) {
    let (Some((least, greatest)), Some(value)) = (input.range, value) else { return };
    let number = match value {
        Constant::Int(value) => value as f64,
        Constant::Float(value) => value,
        _ => return,
    };
    if (least..=greatest).contains(&number) {
        return;
    }
    let (least, greatest) = (words::value(least, ty), words::value(greatest, ty));
    let message = format!("'{}' is out of the range of '{}'", words::value(number, ty), input.name);
    diags.push(
        Diagnostic::new(Code::E0224, formula.span, message)
            .note(input.span, "the range is declared here")
            .help(format!("use a value from '{least}' to '{greatest}'")),
    );
}

fn outputs(
    scope: &Scope<'_>,
    signature: &Signature,
    ports: &Ports<'_>,
    generic: &Generic,
    diags: &mut Diagnostics,
) -> Option<Vec<Output>> {
    let mut outputs = Vec::new();
    let mut complete = ports.complete;
    let mut written: Vec<&Name> = Vec::new();
    for (place, entry, formula) in &ports.outputs {
        if let Some(formula) = formula {
            let name = &signature.outputs[*place].name;
            diags.push(
                Diagnostic::new(
                    Code::E0219,
                    formula.span(),
                    "an output goes to an entry, not into a formula",
                )
                .help(format!("name an entry, and use it in the formulas that read '{name}'")),
            );
        }
        let Some(entry) = entry else {
            complete = false;
            continue;
        };
        if let Some(first) = written.iter().find(|known| known.text == entry.text) {
            let message = format!("two outputs go to '{}'", entry.text);
            diags.push(
                Diagnostic::new(Code::E0220, entry.span, message)
                    .note(first.span, "the other one")
                    .help("use another entry for one of them"),
            );
            continue;
        }
        written.push(entry);
        let ty = actual(signature.outputs[*place].ty.as_ref(), generic);
        match output(scope, *place, ty, entry, diags) {
            Some(output) => outputs.push(output),
            None => complete = false,
        }
    }
    complete.then_some(outputs)
}

fn output(
    scope: &Scope<'_>,
    port: usize,
    ty: Option<&Type>,
    entry: &Name,
    diags: &mut Diagnostics,
) -> Option<Output> {
    let Some(place) = scope.entries.iter().position(|known| known.name.text == entry.text) else {
        let writable =
            scope.entries.iter().filter(|e| matches!(e.kind, EntryKind::Var | EntryKind::Out));
        let known = writable.map(|known| known.name.text.as_str());
        let message = format!("there is no entry '{}'", entry.text);
        let none = format!("declare it in the plan, such as 'var {}: float'", entry.text);
        diags.push(unknown(Code::E0209, entry.span, message, &entry.text, known, &none));
        return None;
    };
    let target = &scope.entries[place];
    let word = match target.kind {
        EntryKind::In => Some("in"),
        EntryKind::Const => Some("const"),
        EntryKind::Var | EntryKind::Out => None,
    };
    if let Some(word) = word {
        let message = format!("'{}' is an entry that the plan does not write", entry.text);
        diags.push(
            Diagnostic::new(Code::E0219, entry.span, message)
                .note(target.name.span, format!("declared as '{word}' here"))
                .help("use an entry declared with 'var' or 'out'"),
        );
        return None;
    }
    let (ty, entry_ty) = (ty?, target.ty.as_ref()?);
    let Ok(conversion) = conversion(ty, entry_ty) else {
        let numeric = ty.is_numeric() && entry_ty.is_numeric();
        let code = if numeric { Code::E0204 } else { Code::E0206 };
        let message = format!("the output is {}, the entry is {}", a_type(ty), a_type(entry_ty));
        diags.push(
            Diagnostic::new(code, entry.span, message)
                .note(target.name.span, "the entry is declared here")
                .help(format!("use an entry that is {}", a_type(ty))),
        );
        return None;
    };
    if let Some(conversion) = &conversion {
        remark(conversion, entry.span, diags);
    }
    Some(Output {
        port: u16::try_from(port).ok()?,
        entry: EntryId(u16::try_from(place).ok()?),
        conversion,
    })
}
