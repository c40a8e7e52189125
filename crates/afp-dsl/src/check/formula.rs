//! Types of formulas: resolves names to entries, inserts conversions, computes dimensions.

mod elsewhere;
mod function;
mod literal;
mod operation;

use std::cell::Cell;
use std::sync::Arc;

use afp_types::{Error, MAX_TEXT, Text};

use crate::check::convert::coerce;
use crate::check::head::EntryDraft;
use crate::check::names::{Indices, ambiguous, unknown};
use crate::check::types::Types;
use crate::graph::{EntryId, EntryKind, Formula, Op, constant};
use crate::index::{Recorder, Word};
use crate::table::Table;
use crate::types::{Constant, Type};
use afp_syntax::ast;
use afp_syntax::diagnostics::{Code, Diagnostic, Diagnostics, Severity, Words};
use afp_syntax::message;
use afp_syntax::source::Span;

/// The limit of literals, entries and operations in a formula.
const MAX_SIZE: usize = 256;

/// The names that the formulas of a place can use.
pub(crate) struct Scope<'a> {
    pub types: &'a Types,
    /// Tables of the file, which formulas cannot read.
    pub tables: &'a [Arc<Table>],
    pub entries: &'a [EntryDraft],
    pub indices: &'a Indices,
    /// Whether an entry can be read here, by position.
    pub readable: &'a dyn Fn(usize) -> bool,
    /// The reason why other entries cannot be read.
    pub unreadable: &'static str,
    pub text: &'a str,
    /// Records the meanings of names.
    pub record: &'a Recorder,
}

impl Scope<'_> {
    /// Checks a formula against type `want`, if any. Returns it with its value, if known; reports
    /// all errors.
    pub fn check(
        &self,
        formula: &ast::Formula,
        want: Option<&Type>,
        diags: &mut Diagnostics,
    ) -> Option<(Formula, Option<Constant>)> {
        let typed = self.infer(formula, diags)?;
        self.finish(typed, want, None, diags)
    }

    /// Resolves the names of a formula of unknown type.
    pub fn names_only(&self, formula: &ast::Formula) {
        self.infer(formula, &mut Diagnostics::default());
    }

    /// The position of an entry.
    pub fn entry(&self, name: &ast::Name) -> Option<usize> {
        let index = self.indices.find(&name.text);
        match index {
            Some(index) => self.record.definition(name.span, self.entries[index].name.span),
            None => match self.table(name) {
                Some(table) => self.record.definition(name.span, table.span),
                None => self.record.unknown(name.span),
            },
        }
        index
    }

    /// Whether a formula is only the name of a table.
    pub fn names_table(&self, formula: &ast::Formula) -> bool {
        let ast::FormulaKind::Ref(reference) = formula.kind() else { return false };
        let name = reference.name().filter(|_| reference.home().is_none());
        name.is_some_and(|name| {
            self.indices.find(&name.text).is_none() && self.table(&name).is_some()
        })
    }

    /// The table, if a formula is only its name.
    pub fn named_table(&self, formula: &ast::Formula) -> Option<&Table> {
        let ast::FormulaKind::Ref(reference) = formula.kind() else { return None };
        self.table(&reference.name()?).filter(|_| self.names_table(formula))
    }

    fn table(&self, name: &ast::Name) -> Option<&Table> {
        self.tables.iter().find(|table| table.name == name.text).map(|table| &**table)
    }

    /// The formula, not yet checked against a type or evaluated.
    pub fn infer(&self, formula: &ast::Formula, diags: &mut Diagnostics) -> Option<Formula> {
        let typer = Typer { scope: self, size: Cell::new(0) };
        let typed = typer.formula(formula, false, diags);
        if typer.size.get() > MAX_SIZE {
            let message = message!("the formula has more than {} parts", Words(MAX_SIZE));
            diags.push(
                Diagnostic::new(Code::E0231, formula.span(), message)
                    .help("compute a part of it in a separate entry"),
            );
            return None;
        }
        typed
    }

    /// Converts an inferred formula and evaluates it as far as possible. Errors about the type name
    /// `range`, the least and greatest valid value.
    pub fn finish(
        &self,
        typed: Formula,
        want: Option<&Type>,
        range: Option<(f64, f64)>,
        diags: &mut Diagnostics,
    ) -> Option<(Formula, Option<Constant>)> {
        let text = self.text_of(typed.span);
        let mut remarks = Diagnostics::default();
        let typed = match want {
            Some(want) => coerce(typed, want, range, text, &mut remarks),
            None => Some(typed),
        };
        let Some(typed) = typed else {
            diags.extend(remarks);
            return None;
        };
        let value = self.evaluate(&typed);
        // A known value cannot fail later.
        remarks.retain(|remark| remark.code != Code::E0208 || matches!(value, Ok(None)));
        // A formula without a value is not converted.
        remarks.retain(|remark| value.is_ok() || remark.severity == Severity::Error);
        diags.extend(remarks);
        match value {
            Ok(value) => Some((typed, value)),
            Err(fault) => {
                let place = constant::fails_at(&typed, &|entry| self.known(entry));
                diags.push(fault_diagnostic(fault, place));
                None
            }
        }
    }

    /// The value of a checked formula, if known.
    pub fn value(&self, formula: &Formula) -> Option<Constant> {
        self.evaluate(formula).ok().flatten()
    }

    /// The value of a checked formula if every input of the plan has its default.
    pub fn value_by_default(&self, formula: &Formula) -> Option<Constant> {
        let is_known = |kind| matches!(kind, EntryKind::Const | EntryKind::In);
        constant::evaluate(formula, &|entry| self.entry_value(entry, is_known)).ok().flatten()
    }

    fn evaluate(&self, formula: &Formula) -> Result<Option<Constant>, Error> {
        constant::evaluate(formula, &|entry| self.known(entry))
    }

    /// The value of an entry, if it is a constant.
    fn known(&self, entry: u16) -> Option<Constant> {
        self.entry_value(entry, |kind| kind == EntryKind::Const)
    }

    fn entry_value(&self, entry: u16, is_known: impl Fn(EntryKind) -> bool) -> Option<Constant> {
        let entry = self.entries.get(usize::from(entry))?;
        entry.value.clone().filter(|_| is_known(entry.kind))
    }

    pub fn text_of(&self, span: Span) -> &str {
        self.text.get(span.start as usize..span.end as usize).unwrap_or("")
    }
}

pub(crate) fn of_constant(value: Constant, ty: &Type, span: Span) -> Option<Formula> {
    let op = match value {
        Constant::Bool(value) => Op::Bool(value),
        Constant::Int(value) => Op::Int(value),
        Constant::Float(value) => Op::Float(value),
        Constant::Text(text) => Op::Text(text),
        Constant::Choice(place) => Op::Choice(place),
        Constant::Unset | Constant::Object(_) => return None,
    };
    Some(Formula::new(op, [], ty.clone(), span))
}

struct Typer<'a> {
    scope: &'a Scope<'a>,
    size: Cell<usize>,
}

impl Typer<'_> {
    /// `inside` tells whether the formula is an operand.
    fn formula(
        &self,
        formula: &ast::Formula,
        inside: bool,
        diags: &mut Diagnostics,
    ) -> Option<Formula> {
        self.size.set(self.size.get() + 1);
        if self.size.get() > MAX_SIZE {
            self.names(formula);
            return None;
        }
        let span = formula.span();
        match formula.kind() {
            ast::FormulaKind::Chain(first, rest) => self.chain(first, rest, diags),
            ast::FormulaKind::Negation(operand) => self.negation(&operand?, span, inside, diags),
            ast::FormulaKind::Brackets(inner) => {
                Some(self.formula(&inner?, inside, diags)?.at(span))
            }
            ast::FormulaKind::Call { name, operands, broken } => {
                let function = function::named(self.scope, &name, (&operands, span), diags);
                let inside = !function::takes_celsius(function);
                // All operands are checked, so that all errors appear at once.
                let values = operands.iter().map(|operand| self.formula(operand, inside, diags));
                let values: Vec<_> = values.collect();
                let values = values.into_iter().collect::<Option<Vec<_>>>()?;
                let function = function.filter(|_| !broken)?;
                function::takes(function, &operands, name.span, diags)?;
                function::call(self.scope, function, values, span, diags)
            }
            ast::FormulaKind::Number { number, unit, whole, broken } => {
                if broken {
                    return None;
                }
                literal::number(&number, unit.as_ref(), whole, span, inside, diags)
            }
            ast::FormulaKind::Text(quoted) => {
                let text = afp_syntax::unquote(&quoted, diags);
                let Ok(text) = Text::try_from(text.as_str()) else {
                    diags.push(fault_diagnostic(Error::TooLong, span));
                    return None;
                };
                Some(Formula::new(Op::Text(text), [], Type::Text, span))
            }
            ast::FormulaKind::Bool(value) => {
                self.scope.record.word(span, Word::Truth);
                Some(Formula::new(Op::Bool(value), [], Type::Bool, span))
            }
            ast::FormulaKind::Ref(reference) => self.reference(&reference, span, diags),
            ast::FormulaKind::Hole => None,
        }
    }

    /// Resolves the names of a formula that is too large for a type.
    fn names(&self, formula: &ast::Formula) {
        match formula.kind() {
            ast::FormulaKind::Chain(first, rest) => {
                let operands = first.into_iter().chain(rest.into_iter().filter_map(|(_, o)| o));
                operands.for_each(|operand| self.names(&operand));
            }
            ast::FormulaKind::Negation(Some(inner)) | ast::FormulaKind::Brackets(Some(inner)) => {
                self.names(&inner);
            }
            ast::FormulaKind::Call { name, operands, .. } => {
                function::named(self.scope, &name, (&[], name.span), &mut Diagnostics::default());
                operands.iter().for_each(|operand| self.names(operand));
            }
            ast::FormulaKind::Bool(_) => self.scope.record.word(formula.span(), Word::Truth),
            ast::FormulaKind::Ref(reference) => {
                self.reference(&reference, formula.span(), &mut Diagnostics::default());
            }
            _ => {}
        }
    }

    fn reference(
        &self,
        reference: &ast::Ref,
        span: Span,
        diags: &mut Diagnostics,
    ) -> Option<Formula> {
        let name = reference.name()?;
        let Some(home) = reference.home() else { return self.entry(&name, diags) };
        match self.scope.indices.find(&format!("{}.{}", home.text, name.text)) {
            Some(index) => {
                self.scope.record.word(home.span, Word::Other);
                self.scope.record.definition(name.span, self.scope.entries[index].name.span);
                self.read(index, span)
            }
            None => self.choice(&home, &name, span, diags),
        }
    }

    fn chain(
        &self,
        first: Option<ast::Formula>,
        rest: Vec<(ast::Sign, Option<ast::Formula>)>,
        diags: &mut Diagnostics,
    ) -> Option<Formula> {
        let mut value = first.and_then(|first| self.formula(&first, true, diags));
        for (sign, operand) in rest {
            self.size.set(self.size.get() + 1);
            // All operands are checked, so that all errors appear at once.
            let operand = operand.and_then(|operand| self.formula(&operand, true, diags));
            value = match (value, operand) {
                (Some(left), Some(right)) => {
                    operation::binary(self.scope, sign, left, right, diags)
                }
                _ => None,
            };
        }
        value
    }

    fn negation(
        &self,
        operand: &ast::Formula,
        span: Span,
        inside: bool,
        diags: &mut Diagnostics,
    ) -> Option<Formula> {
        if let ast::FormulaKind::Number { number, unit, whole, broken: false } = operand.kind()
            && let Some(formula) = literal::negative(&number, unit.as_ref(), whole, span, inside)
        {
            return Some(formula);
        }
        let operand = self.formula(operand, true, diags)?;
        operation::negate(operand, span, diags)
    }

    fn entry(&self, name: &ast::Name, diags: &mut Diagnostics) -> Option<Formula> {
        let scope = self.scope;
        let Some(index) = scope.entry(name) else {
            diags.push(match diags.explains() {
                true => elsewhere::unknown_entry(self.scope, name),
                false => elsewhere::no_entry(name).elsewhere("declare it in the plan"),
            });
            return None;
        };
        let entry = &scope.entries[index];
        if !(scope.readable)(index) {
            let message = message!("'{}' has no value yet", name.text);
            diags.push(
                Diagnostic::new(Code::E0229, name.span, message)
                    .note(entry.name.span, "declared here")
                    .help(scope.unreadable),
            );
            return None;
        }
        self.read(index, name.span)
    }

    fn read(&self, index: usize, span: Span) -> Option<Formula> {
        let id = EntryId(u16::try_from(index).ok()?);
        let ty = self.scope.entries[index].ty.clone()?;
        Some(Formula::new(Op::Entry(id), [], ty, span))
    }

    /// A value of an enum.
    fn choice(
        &self,
        home: &ast::Name,
        name: &ast::Name,
        span: Span,
        diags: &mut Diagnostics,
    ) -> Option<Formula> {
        let record = self.scope.record;
        let enums = || self.scope.types.enums.iter().filter(|(_, each)| each.name == home.text);
        // Replaced if it is found below.
        record.unknown(name.span);
        if enums().count() > 1 {
            record.several(home.span, enums().map(|(_, each)| each.span));
            let places: Vec<_> = enums().map(|(home, each)| (home.as_deref(), each.span)).collect();
            let error = ambiguous("an enum", &home.text, home.span, &places);
            // Values of enums are written without the toolbox.
            let of_toolbox = places.iter().any(|(home, _)| home.is_some());
            let only = "use only one of the toolboxes in this file";
            diags.push(if of_toolbox { error.help(only) } else { error });
            return None;
        }
        let Some((_, found)) = enums().next() else {
            record.unknown(home.span);
            if self.scope.types.incomplete {
                return None;
            }
            diags.push(elsewhere::unknown_enum(self.scope, home, name, span));
            return None;
        };
        record.definition(home.span, found.span);
        let Some(index) = found.variants.iter().position(|variant| *variant == name.text) else {
            let known = found.variants.iter().map(String::as_str);
            let message = message!("'{}' has no value '{}'", found.name, name.text);
            let none = "declare the value in the enum";
            diags.push(unknown(Code::E0239, name.span, message, &name.text, known, none));
            return None;
        };
        if let Some(definition) = found.variant_spans.get(index) {
            record.definition(name.span, *definition);
        }
        let op = Op::Choice(u16::try_from(index).ok()?);
        Some(Formula::new(op, [], Type::Enum(found.clone()), span))
    }
}

/// The error for a formula or value that cannot be computed.
pub(crate) fn fault_diagnostic(error: Error, span: Span) -> Diagnostic {
    match error {
        Error::Overflow => Diagnostic::new(Code::E0228, span, "the value does not fit an int")
            .help("use floats, or smaller numbers"),
        Error::DivisionByZero => Diagnostic::new(Code::E0228, span, "a division by zero")
            .help("divide by something else"),
        Error::NotFinite => Diagnostic::new(
            Code::E0228,
            span,
            "the value is infinite or not a number",
        )
        .help(
            "do not divide by zero or take the root of a negative number, and keep numbers below 1.8e308",
        ),
        Error::NoRange => {
            Diagnostic::new(Code::E0228, span, "the lower bound is above the upper bound")
                .help("write 'clamp(value, low, high)' with 'low' at most 'high'")
        }
        Error::NotAValue | Error::Unknown | Error::Mistyped => {
            Diagnostic::new(Code::E0228, span, "the string is not a value of the type")
                .help("write a value of the type, unit included, without the quotes")
        }
        Error::TooLong => too_long(span),
    }
}

/// The error for a string of more than [`MAX_TEXT`] bytes.
pub(crate) fn too_long(span: Span) -> Diagnostic {
    Diagnostic::new(
        Code::E0230,
        span,
        message!("the string is longer than {} bytes", Words(MAX_TEXT)),
    )
    .help(message!("shorten it to at most {} bytes of UTF-8", Words(MAX_TEXT)))
}
