//! Comparisons in scenarios: entries and signals, with values and with each other.

use super::Checker;
use crate::check::convert::compared_as;
use crate::graph::EntryKind;
use crate::scenario::{Claim, Comparison, Operand, Subject};
use crate::types::Type;
use afp_syntax::ast::{Formula, FormulaKind, Name, Path, Ref};
use afp_syntax::diagnostics::{Code, Diagnostic, Diagnostics};
use afp_syntax::message;
use afp_syntax::source::Span;

pub(super) struct Named {
    pub names: Vec<Name>,
    pub text: String,
    pub span: Span,
}

/// The meaning of comparable names.
pub(super) struct Compared {
    pub subject: Subject,
    pub ty: Type,
    pub declared: Option<Span>,
}

impl Named {
    pub fn of_path(path: &Path) -> Named {
        Named { names: path.names(), text: path.text(), span: path.span() }
    }

    pub fn of_ref(reference: &Ref) -> Named {
        let names: Vec<_> = reference.home().into_iter().chain(reference.name()).collect();
        let words: Vec<_> = names.iter().map(|name| name.text.as_str()).collect();
        Named { text: words.join("."), names, span: reference.span() }
    }
}

impl Checker<'_> {
    pub(super) fn compare(
        &self,
        path: &Path,
        sign: &Name,
        value: &Formula,
        diags: &mut Diagnostics,
    ) -> Option<Claim> {
        let comparison = Comparison::parse(&sign.text)?;
        let named = Named::of_path(path);
        let left = match self.entry(&named) {
            Ok((entry, _)) => entry,
            Err(_) if self.is_of_robot(&named.names) => self.measured(&named, diags)?,
            Err(error) => {
                diags.push(self.end_meant(&named, sign, value, *error));
                return None;
            }
        };
        let at = |error: Diagnostic| match left.declared {
            Some(declared) => error.note(declared, "declared here"),
            None => error,
        };
        if let Type::Object(_) = left.ty {
            let message = message!("'{}' is an object, which only components can read", named.text);
            let error = Diagnostic::new(Code::E0604, named.span, message);
            diags.push(at(error).help("expect a value that the plan computes from it"));
            return None;
        }
        if comparison.is_order() && !left.ty.is_numeric() {
            let message = message!("values of '{}' have no order", left.ty);
            let error = Diagnostic::new(Code::E0604, sign.span, message);
            diags.push(at(error).help("write '==' or '!='"));
            return None;
        }
        let right = self.operand(&named, &left.ty, value, diags)?;
        Some(Claim::Compare { left: left.subject, comparison, right })
    }

    /// `end == OK`
    fn end_meant(
        &self,
        left: &Named,
        sign: &Name,
        value: &Formula,
        error: Diagnostic,
    ) -> Diagnostic {
        let FormulaKind::Ref(reference) = value.kind() else { return error };
        let right = Named::of_ref(&reference);
        let Some(better) = self.end_compared(&left.text, &sign.text, &right.names) else {
            return error;
        };
        let message = "the end of the plan is not a value";
        let place = left.span.to(right.span);
        let error = Diagnostic::new(Code::E0604, place, message);
        match sign.text.as_str() {
            "==" => error.write(better),
            _ => error.help(message!("write 'never {}'", better)),
        }
    }

    /// A value of a type, or a name with a value at run time.
    fn operand(
        &self,
        left: &Named,
        ty: &Type,
        formula: &Formula,
        diags: &mut Diagnostics,
    ) -> Option<Operand> {
        let named = match formula.kind() {
            FormulaKind::Ref(reference) => Some(Named::of_ref(&reference)),
            _ => None,
        };
        let other = match named.as_ref().map(|named| (named, self.entry(named))) {
            Some((_, Ok((entry, kind)))) if kind != EntryKind::Const => Some(entry),
            Some((named, Err(_))) if self.is_signal(&named.names) => {
                Some(self.measured(named, diags)?)
            }
            _ => None,
        };
        let Some(other) = other else {
            let want = |right: &Type| compared_as(ty, right);
            return self.constant_as(formula, want, diags).map(|(_, value)| Operand::Value(value));
        };
        let numbers = [ty, &other.ty].map(|ty| matches!(ty, Type::Int) || *ty == Type::FLOAT);
        if other.ty == *ty || numbers == [true, true] {
            return Some(Operand::Subject(other.subject));
        }
        let message =
            message!("'{}' is of type '{}', and this of type '{}'", left.text, ty, other.ty);
        let error = Diagnostic::new(Code::E0604, formula.span(), message);
        let error = match other.declared {
            Some(declared) => error.note(declared, "declared here"),
            None => error,
        };
        diags.push(error.help(message!("compare it with something of type '{}'", ty)));
        None
    }

    /// # Errors
    /// The entry is unknown.
    fn entry(&self, named: &Named) -> Result<(Compared, EntryKind), Box<Diagnostic>> {
        let (number, plan, id) = self.paths.entry(&named.names)?;
        let entry = &self.paths.graph.plan(plan).entries[id.index()];
        let (ty, declared) = (entry.ty.clone(), Some(entry.span));
        Ok((Compared { subject: Subject::Entry(number), ty, declared }, entry.kind))
    }
}
