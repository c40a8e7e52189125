//! Ports of a template: types, defaults, ranges.

use crate::check::formula::Scope;
use crate::check::names::Indices;
use crate::check::names::{DeclaredNames, unknown};
use crate::check::range;
use crate::check::types::Types;
use crate::index::{Recorder, Word};
use crate::toolbox::{Device, InPort, OutPort, Outcome, TemplateKind};
use crate::types::{Constant, Type};
use afp_syntax::ast::{self, Formula, Name};
use afp_syntax::diagnostics::{Code, Diagnostic, Diagnostics, Words};
use afp_syntax::message;
use afp_syntax::source::Span;

/// Reads an input port; `None` when it has no name or no type.
pub(super) fn input(
    node: &ast::InPort,
    kind: TemplateKind,
    site: &Site<'_>,
    names: &mut DeclaredNames,
    diags: &mut Diagnostics,
) -> Option<InPort> {
    let Some(name) = node.name() else {
        site.names_only(node);
        return None;
    };
    names.declare(&name, diags);
    if let Some(live) = node.live().filter(|_| kind == TemplateKind::Computation) {
        diags.push(
            Diagnostic::new(Code::E0510, live, "a computation reads its inputs once")
                .help("remove 'live'")
                .replace(""),
        );
    }
    let ty = node.ty().and_then(|ty| match table_word(&ty) {
        Some(word) => {
            site.record.word(word.span, Word::Type);
            Some(Type::Any)
        }
        None => site.types.resolve(&ty, site.record, diags),
    });
    let Some(ty) = ty else {
        site.names_only(node);
        return None;
    };
    let values = Values { site, ty: &ty, of: Declared::Port };
    let range = values.range(node.range(), node.ends(), diags);
    let default = node.default().and_then(|formula| values.default(&formula, range, diags));
    Some(InPort {
        doc: node.doc(),
        live: node.live().is_some(),
        default,
        range,
        span: name.span,
        name: name.text,
        ty,
    })
}

/// The word `table`, if it is the whole type.
pub(super) fn table_word(ty: &ast::Type) -> Option<Name> {
    let [factor] = &ty.factors()[..] else { return None };
    let reference = factor.reference.as_ref().filter(|it| it.home().is_none())?;
    reference.name().filter(|name| name.text == "table" && factor.exponent == Some(1))
}

/// Reads an output port; `None` when it has no name or no type.
pub(super) fn output(
    node: &ast::OutPort,
    outcomes: &[Outcome],
    site: &Site<'_>,
    names: &mut DeclaredNames,
    diags: &mut Diagnostics,
) -> Option<OutPort> {
    let Site { types, record, .. } = *site;
    let name = node.name();
    if let Some(name) = &name {
        names.declare(name, diags);
    }
    let mut on: Vec<u16> = Vec::new();
    let all = 0..u16::try_from(outcomes.len()).unwrap_or(u16::MAX);
    for state in node.on().unwrap_or_default() {
        match outcomes.iter().position(|outcome| outcome.name == state.text) {
            Some(index) => {
                record.definition(state.span, outcomes[index].span);
                let index = u16::try_from(index).unwrap_or(u16::MAX);
                if on.contains(&index) {
                    let message = message!("'{}' is given twice", state.text);
                    let error = Diagnostic::new(Code::E0511, state.span, message);
                    diags.push(error.help("remove one of them"));
                }
                on.push(index);
            }
            None => {
                record.unknown(state.span);
                let known = outcomes.iter().map(|outcome| outcome.name.as_str());
                let message = message!("the template has no state or event '{}'", state.text);
                let none = "declare it in the template";
                diags.push(unknown(Code::E0210, state.span, message, &state.text, known, none));
            }
        }
    }
    if node.on().is_none() {
        on.extend(all);
    }
    on.sort_unstable();
    on.dedup();
    let ty = types.resolve(&node.ty()?, record, diags);
    let (name, ty) = (name?, ty?);
    Some(OutPort { doc: node.doc(), on, span: name.span, name: name.text, ty })
}

/// Reports a part that does not belong in the template.
pub(super) fn misfit(word: &str, why: &str, span: Span, diags: &mut Diagnostics) {
    diags.push(
        Diagnostic::new(Code::E0510, span, message!("{}, so it has no '{}'", Words(&why), word))
            .help(message!("remove '{}'", word)),
    );
}

pub(super) struct Site<'a> {
    /// The types of the toolbox.
    pub types: &'a Types,
    /// The text of its file.
    pub source: &'a str,
    /// The index of the names.
    pub record: &'a Recorder,
    /// The devices of the toolbox.
    pub devices: &'a [Device],
}

impl Site<'_> {
    /// Records the names of an input that has errors.
    fn names_only(&self, node: &ast::InPort) {
        if let Some(ty) = node.ty() {
            self.types.resolve(&ty, self.record, &mut Diagnostics::default());
        }
        self.values_only(node.default().into_iter().chain(node.ends()));
    }

    /// Records the names in values of unknown type.
    pub fn values_only(&self, values: impl Iterator<Item = Formula>) {
        for formula in values {
            self.formula(&formula, None, &mut Diagnostics::default());
        }
    }

    fn formula(
        &self,
        formula: &Formula,
        ty: Option<&Type>,
        diags: &mut Diagnostics,
    ) -> Option<Constant> {
        let scope = Scope {
            types: self.types,
            tables: &[],
            entries: &[],
            indices: &Indices::default(),
            readable: &|_| false,
            unreadable: "",
            text: self.source,
            record: self.record,
        };
        scope.check(formula, ty, diags)?.1
    }
}

/// A declaration with values.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Declared {
    /// A port of a template.
    Port,
    /// The amount of a fault.
    Amount,
}

/// The values in the declaration of a port or an amount.
pub(super) struct Values<'a> {
    pub site: &'a Site<'a>,
    pub ty: &'a Type,
    pub of: Declared,
}

impl Values<'_> {
    fn constant(&self, formula: &Formula, diags: &mut Diagnostics) -> Option<Constant> {
        self.site.formula(formula, Some(self.ty), diags)
    }

    /// The default, within the range.
    pub fn default(
        &self,
        formula: &Formula,
        range: Option<(f64, f64)>,
        diags: &mut Diagnostics,
    ) -> Option<Constant> {
        let span = formula.span();
        let refused = match self.ty {
            Type::Object(_) => Some("objects have no literals"),
            ty if ty.is_generic() => Some("the type depends on the use"),
            _ => None,
        };
        if let Some(why) = refused {
            let message = message!("the port can have no default: {}", Words(why));
            diags.push(Diagnostic::new(Code::E0514, span, message).help("remove the default"));
            self.site.formula(formula, None, &mut Diagnostics::default());
            return None;
        }
        let value = self.constant(formula, diags)?;
        let message = match self.of {
            Declared::Port => "the default is out of the port's range",
            Declared::Amount => "the default is out of the range",
        };
        let outside = |range| range::outside(&value, range, self.ty, span, |_| message.into());
        if let Some(error) = range.and_then(outside) {
            diags.push(error);
        }
        Some(value)
    }

    /// The least and the greatest value. The names of an incomplete range are recorded, too.
    pub fn range(
        &self,
        written: Option<range::Written>,
        ends: Vec<Formula>,
        diags: &mut Diagnostics,
    ) -> Option<(f64, f64)> {
        let Some(written) = written else {
            self.site.values_only(ends.into_iter());
            return None;
        };
        let mut constant = |formula: &Formula, ty: Option<&Type>, diags: &mut Diagnostics| {
            self.site.formula(formula, ty, diags)
        };
        range::read(&written, self.ty, &mut constant, diags)
    }
}
