//! Entries of a plan: types, initial values and ranges, in the order of evaluation: `const`, `in`,
//! then others.

use crate::check::formula::Scope;
use crate::check::head::EntryDraft;
use crate::check::names::Indices;
use crate::check::range;
use crate::check::types::Types;
use crate::graph::EntryKind;
use crate::index::Recorder;
use crate::types::Type;
use afp_syntax::ast;
use afp_syntax::diagnostics::{Code, Diagnostic, Diagnostics};
use afp_syntax::message;

/// The entries of a plan, without nameless ones, and their places.
pub(crate) fn read(
    plan: &ast::Plan,
    types: &Types,
    text: &str,
    record: &Recorder,
    diags: &mut Diagnostics,
) -> (Vec<EntryDraft>, Indices) {
    let (written, nameless): (Vec<_>, Vec<_>) =
        plan.entries().into_iter().partition(|entry| entry.name().is_some());
    let written: Vec<_> =
        written.into_iter().filter_map(|entry| Some((entry.name()?, entry))).collect();
    let mut drafts: Vec<_> = written
        .iter()
        .map(|(name, entry)| EntryDraft {
            name: name.clone(),
            doc: entry.doc(),
            kind: kind(entry),
            live: entry.live().is_some(),
            ty: entry.ty().and_then(|ty| types.resolve(&ty, record, diags)),
            init: None,
            has_init: entry.init().is_some(),
            value: None,
            range: None,
            ranged_by: Vec::new(),
        })
        .collect();
    let indices = Indices::of(written.iter().map(|(name, _)| Some(name.text.as_str())));
    let site = Site { indices: &indices, types, text, record };
    for kinds in EntryKind::BY_VALUE {
        for index in 0..drafts.len() {
            if kinds.contains(&drafts[index].kind) {
                initialise(index, &written[index].1, &mut drafts, &site, diags);
                limit(index, &written[index].1, &mut drafts, &site, diags);
            }
        }
    }
    for entry in nameless {
        site.names_only(&entry, &drafts);
    }
    (drafts, indices)
}

/// The context of initial values.
struct Site<'a> {
    indices: &'a Indices,
    types: &'a Types,
    text: &'a str,
    record: &'a Recorder,
}

impl Site<'_> {
    /// Records the names in a nameless entry.
    fn names_only(&self, entry: &ast::Entry, entries: &[EntryDraft]) {
        if let Some(ty) = entry.ty() {
            self.types.resolve(&ty, self.record, &mut Diagnostics::default());
        }
        for formula in entry.init().into_iter().chain(entry.ends()) {
            self.scope(entries, &|_| true, "").names_only(&formula);
        }
    }

    fn scope<'s>(
        &'s self,
        entries: &'s [EntryDraft],
        readable: &'s dyn Fn(usize) -> bool,
        unreadable: &'static str,
    ) -> Scope<'s> {
        let Site { indices, types, text, record } = *self;
        Scope { types, tables: &[], entries, indices, readable, unreadable, text, record }
    }
}

fn kind(entry: &ast::Entry) -> EntryKind {
    match entry.keyword().as_str() {
        "in" => EntryKind::In,
        "out" => EntryKind::Out,
        "const" => EntryKind::Const,
        _ => EntryKind::Var,
    }
}

fn initialise(
    index: usize,
    entry: &ast::Entry,
    drafts: &mut [EntryDraft],
    site: &Site<'_>,
    diags: &mut Diagnostics,
) {
    let own = &drafts[index];
    let (kind, ty) = (own.kind, own.ty.clone());
    let Some(formula) = entry.init() else {
        return missing(own, entry, diags);
    };
    let readable = |other: usize| match kind {
        EntryKind::Const => drafts[other].kind == EntryKind::Const && other < index,
        EntryKind::In => drafts[other].kind == EntryKind::Const,
        EntryKind::Var | EntryKind::Out => {
            matches!(drafts[other].kind, EntryKind::Const | EntryKind::In)
        }
    };
    let unreadable = match kind {
        EntryKind::Const => "a 'const' may use constants that are declared above it",
        EntryKind::In => "the default of an 'in' may use 'const' entries",
        EntryKind::Var | EntryKind::Out => "an initial value may use 'const' and 'in' entries",
    };
    // An unknown type is reported once; the value is still checked.
    let checked = site.scope(drafts, &readable, unreadable).check(&formula, ty.as_ref(), diags);
    let needs_type = matches!(kind, EntryKind::In | EntryKind::Out) && entry.ty().is_none();
    if needs_type {
        let of_value = checked.as_ref().map(|(formula, _)| &formula.ty);
        untyped(own, entry, of_value, diags);
    }
    let Some((formula, value)) = checked else { return };
    let draft = &mut drafts[index];
    if draft.ty.is_none() && entry.ty().is_none() && !needs_type {
        draft.ty = Some(formula.ty.clone());
    }
    draft.value = value;
    draft.init = Some(formula);
}

/// Reads the range of an entry, and checks its initial value.
fn limit(
    index: usize,
    entry: &ast::Entry,
    drafts: &mut [EntryDraft],
    site: &Site<'_>,
    diags: &mut Diagnostics,
) {
    let Some(written) = entry.range() else {
        let scope = site.scope(drafts, &|_| true, "");
        return entry.ends().iter().for_each(|end| scope.names_only(end));
    };
    let own = &drafts[index];
    let readable = |other: usize| drafts[other].kind == EntryKind::Const && other != index;
    let scope = site.scope(drafts, &readable, "a range may use 'const' entries");
    let Some(ty) = own.ty.as_ref().filter(|_| own.kind != EntryKind::Const) else {
        scope.names_only(&written.0);
        scope.names_only(&written.1);
        if own.kind == EntryKind::Const {
            diags.push(
                Diagnostic::new(Code::E0513, written.2, "a constant has no range")
                    .help("remove 'from ... to ...'"),
            );
        }
        return;
    };
    let mut ranged_by = Vec::new();
    let mut constant = |formula: &ast::Formula, ty: Option<&Type>, diags: &mut Diagnostics| {
        let (formula, value) = scope.check(formula, ty, diags)?;
        ranged_by.extend(formula.entries().map(|(id, _)| id));
        value
    };
    let range = range::read(&written, ty, &mut constant, diags);
    let value = own.value.as_ref().zip(own.init.as_ref()).zip(range);
    let error = value.and_then(|((value, init), range)| {
        let name = &own.name.text;
        let message = |value: String| message!("'{}' is out of the range of '{}'", value, name);
        let error = range::outside(value, range, ty, init.span, message)?;
        Some(error.note(written.2, "the range is declared here"))
    });
    if let Some(error) = error {
        diags.push(error);
    }
    let draft = &mut drafts[index];
    (draft.range, draft.ranged_by) = (range, ranged_by);
}

/// Checks an entry without a value.
fn missing(own: &EntryDraft, entry: &ast::Entry, diags: &mut Diagnostics) {
    if entry.ty().is_none() {
        untyped(own, entry, None, diags);
    } else if own.kind == EntryKind::Const {
        let message = message!("the constant '{}' has no value", own.name.text);
        diags.push(
            Diagnostic::new(Code::E0225, own.name.span, message).help("write '=' and its value"),
        );
    }
}

fn untyped(own: &EntryDraft, entry: &ast::Entry, of_value: Option<&Type>, diags: &mut Diagnostics) {
    // The unparsed part may be the type or the value.
    if diags.syntax_errors_within(entry.span()).next().is_some() {
        return;
    }
    let name = &own.name;
    let error =
        Diagnostic::new(Code::E0241, name.span, message!("the entry '{}' has no type", name.text));
    diags.push(match of_value {
        Some(ty) => error
            .help(message!("write its type: '{}: {}'", name.text, ty))
            .fix(name.span.after(), format!(": {ty}")),
        None => error.help(message!("write its type, such as '{}: float'", name.text)),
    });
}
