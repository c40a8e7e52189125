//! What is wrong with a document, as the protocol has it.

use afp_syntax::diagnostics::{Diagnostic, Severity};
use afp_syntax::source::Span;
use gen_lsp_types as lsp;

use crate::convert::Places;
use crate::workspace::{Analysis, Workspace, is_project};

/// What is wrong with a document.
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
    own.map(|diagnostic| one(workspace, &analysis, &places, diagnostic)).collect()
}

/// A diagnostic of a document.
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

/// What is wrong with a project file.
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
