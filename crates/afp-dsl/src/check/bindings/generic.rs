//! The type of `any` or `number` in an instance.

use crate::check::bindings::Ports;
use crate::check::formula::Scope;
use crate::check::signature::{Signature, SignatureKind};
use crate::graph::Formula;
use crate::toolbox::TemplateKind;
use crate::types::Type;
use crate::types::text::a_type;
use afp_syntax::diagnostics::{Code, Diagnostic, Diagnostics, Words};
use afp_syntax::message;
use afp_syntax::source::Span;

/// The meaning of `any` or `number` in an instance.
pub(super) enum Generic {
    /// The template has no such port.
    None,
    Is(Type),
    /// There is an error, which has been reported.
    Unknown,
    /// No port is bound.
    Undecided,
}

fn is_generic(ty: Option<&Type>) -> bool {
    ty.is_some_and(Type::is_generic)
}

/// Decides the type of the instance by its inputs, or else by its outputs.
pub(super) fn decide(
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
    let wanted = declared.flatten().find(|ty| **ty != Type::Any).unwrap_or(&Type::Any);
    let has_inputs = signature.inputs.iter().any(|input| is_generic(input.ty.as_ref()));
    let decided = match has_inputs {
        true => by_inputs(signature, inferred),
        false => by_outputs(scope, signature, ports),
    };
    let Ok(decided) = decided else { return Generic::Unknown };
    let Some((ty, span)) = decided else {
        // An input without a value has its own error.
        return if has_inputs || !ports.complete { Generic::Unknown } else { Generic::Undecided };
    };
    let carries = signature.outputs.iter().any(|output| is_generic(output.ty.as_ref()));
    let is_computation = signature.kind == SignatureKind::Template(TemplateKind::Computation);
    let help = match (wanted, &ty) {
        (Type::Number, ty) if ty.is_discrete() && !ty.is_numeric() => {
            "use an int, a float or a quantity; 'Is' of 'std' compares everything else"
        }
        (Type::Number, ty) if !ty.is_numeric() => "use an int, a float or a quantity",
        (Type::Discrete, Type::Quantity(_)) => {
            "measured values are rarely equal: use 'Compare' of 'std'"
        }
        // An output has the value that was read at the same instant.
        (Type::Any, Type::Object(_)) if !carries || is_computation => return Generic::Is(ty),
        (Type::Any, Type::Object(_)) => "copy it with 'Assign' of 'std'",
        (_, Type::Object(_)) => "only the templates of its toolbox can read an object",
        _ => return Generic::Is(ty),
    };
    let message = message!("expected {}, found {}", Words(a_type(wanted)), Words(a_type(&ty)));
    diags.push(Diagnostic::new(Code::E0206, span, message).help(help));
    Generic::Unknown
}

/// The type of the inputs, and its place; an error if an input is wrong.
fn by_inputs(
    signature: &Signature,
    inferred: &[Option<Option<Formula>>],
) -> Result<Option<(Type, Span)>, ()> {
    let mut decided: Option<(Type, Span)> = None;
    for (input, formula) in signature.inputs.iter().zip(inferred) {
        let Some(formula) = formula.as_ref().filter(|_| is_generic(input.ty.as_ref())) else {
            continue;
        };
        let formula = formula.as_ref().ok_or(())?;
        decided = match decided {
            Some((Type::Int, span)) if formula.ty == Type::FLOAT => Some((Type::FLOAT, span)),
            Some(decided) => Some(decided),
            None => Some((formula.ty.clone(), formula.span)),
        };
    }
    Ok(decided)
}

/// The type of the outputs: that of the first entry.
fn by_outputs(
    scope: &Scope<'_>,
    signature: &Signature,
    ports: &Ports<'_>,
) -> Result<Option<(Type, Span)>, ()> {
    let mut decided = None;
    for (index, entry, _) in &ports.outputs {
        let generic = is_generic(signature.outputs[*index].ty.as_ref());
        let Some(entry) = entry.filter(|_| generic) else { continue };
        let found = scope.entries.iter().find(|known| known.name.text == entry.text);
        let ty = found.and_then(|found| found.ty.clone()).ok_or(())?;
        decided = decided.or(Some((ty, entry.span)));
    }
    Ok(decided)
}

/// The type of a port in this instance.
pub(super) fn actual<'a>(declared: Option<&'a Type>, generic: &'a Generic) -> Option<&'a Type> {
    match (declared, generic) {
        (Some(Type::Any | Type::Number | Type::Discrete), Generic::Is(ty)) => Some(ty),
        (Some(Type::Any | Type::Number | Type::Discrete) | None, _) => None,
        (declared, _) => declared,
    }
}
