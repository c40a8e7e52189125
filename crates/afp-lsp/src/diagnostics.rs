//! Diagnostics in the protocol's format.

use std::collections::BTreeMap;

use afp_dsl::files::joined;
use afp_syntax::ast::{Item, Name};
use afp_syntax::diagnostics::{Diagnostic, Severity};
use afp_syntax::source::Span;
use gen_lsp_types as lsp;

use crate::convert::Places;
use crate::workspace::{Analysis, Workspace, is_project};

pub(crate) fn of(workspace: &mut Workspace, path: &str) -> Vec<lsp::Diagnostic> {
    if is_project(path) {
        return of_project(workspace, path);
    }
    if !workspace.is_afp(path) {
        return Vec::new();
    }
    let Some(analysis) = workspace.analysis(path) else { return Vec::new() };
    let all = analysis.compiled.diags.iter();
    let own = all.filter(|diagnostic| diagnostic.span.file == analysis.file);
    let Some(source) = analysis.compiled.sources.get(analysis.file) else { return Vec::new() };
    let places = Places::new(&source.text, workspace.encoding);
    let own = own.map(|diagnostic| one(workspace, &analysis, &places, diagnostic));
    own.chain(of_used(workspace, &analysis, &source.name, &places)).collect()
}

/// Returns the errors of used files, at the lines that lead to them, since they keep the plan from
/// running.
fn of_used(
    workspace: &Workspace,
    analysis: &Analysis,
    path: &str,
    places: &Places<'_>,
) -> Vec<lsp::Diagnostic> {
    let compiled = &analysis.compiled;
    let errors = compiled.diags.iter().filter(|it| it.severity == Severity::Error);
    let mut by_file: BTreeMap<u16, Vec<&Diagnostic>> = BTreeMap::new();
    errors.for_each(|it| by_file.entry(it.span.file).or_default().push(it));
    by_file.remove(&analysis.file);
    by_file.retain(|file, _| compiled.plan_files.contains(&usize::from(*file)));
    if by_file.is_empty() {
        return Vec::new();
    }
    let uses: Vec<_> = compiled
        .tree(analysis.file)
        .into_iter()
        .flat_map(|own| own.file().items())
        .filter_map(|item| if let Item::Use(line) = item { line.path() } else { None })
        .collect();
    let at = |(file, errors): (u16, Vec<&Diagnostic>)| {
        let source = compiled.sources.get(file)?;
        let leads = |used: &&Name| joined(path, used.text.trim_matches('"')) == source.name;
        let used = uses.iter().find(leads).or_else(|| uses.first())?;
        let related = errors.iter().filter_map(|error| {
            let location = workspace.location(compiled, error.span)?;
            Some(lsp::DiagnosticRelatedInformation { location, message: error.message_text() })
        });
        let name = source.name.rsplit('/').next().unwrap_or_default();
        let count = errors.len();
        let many = if count == 1 { "an error".to_owned() } else { format!("{count} errors") };
        Some(lsp::Diagnostic {
            range: places.range(used.span),
            severity: Some(lsp::DiagnosticSeverity::Error),
            source: Some("afp".to_owned()),
            message: lsp::Message::String(said(
                &format!("'{name}' has {many}"),
                "open it and correct it",
            )),
            related_information: Some(related.collect()),
            ..lsp::Diagnostic::default()
        })
    };
    by_file.into_iter().filter_map(at).collect()
}

/// Converts a diagnostic of a document.
pub(crate) fn one(
    workspace: &Workspace,
    analysis: &Analysis,
    places: &Places<'_>,
    diagnostic: &Diagnostic,
) -> lsp::Diagnostic {
    let notes = diagnostic.note_texts().filter_map(|(span, message)| {
        let location = workspace.location(&analysis.compiled, span)?;
        Some(lsp::DiagnosticRelatedInformation { location, message })
    });
    let notes: Vec<_> = notes.collect();
    lsp::Diagnostic {
        range: places.range(diagnostic.span),
        severity: Some(match diagnostic.severity {
            Severity::Error => lsp::DiagnosticSeverity::Error,
            Severity::Warning => lsp::DiagnosticSeverity::Warning,
            Severity::Note => lsp::DiagnosticSeverity::Information,
        }),
        code: Some(diagnostic.code.as_str().into()),
        source: Some("afp".to_owned()),
        message: lsp::Message::String(said(&diagnostic.message_text(), &diagnostic.help_text())),
        related_information: (!notes.is_empty()).then_some(notes),
        ..lsp::Diagnostic::default()
    }
}

fn said(message: &str, help: &str) -> String {
    match help.is_empty() {
        true => message.to_owned(),
        false => format!("{message}\nhelp: {help}"),
    }
}

fn of_project(workspace: &Workspace, path: &str) -> Vec<lsp::Diagnostic> {
    let Ok(text) = workspace.text(path) else { return Vec::new() };
    let places = Places::new(&text, workspace.encoding);
    let number = |at| u32::try_from(at).unwrap_or(u32::MAX);
    let span = |mistake: &afp_project::Mistake| mistake.span.clone().unwrap_or_default();
    let one = |mistake: &afp_project::Mistake| lsp::Diagnostic {
        range: places.range(Span {
            file: 0,
            start: number(span(mistake).start),
            end: number(span(mistake).end),
        }),
        severity: Some(lsp::DiagnosticSeverity::Error),
        source: Some("afp".to_owned()),
        message: lsp::Message::String(said(&mistake.message, &mistake.help)),
        ..lsp::Diagnostic::default()
    };
    afp_project::read(&text).1.iter().map(one).collect()
}
