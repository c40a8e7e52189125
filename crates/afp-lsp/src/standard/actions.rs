//! Code actions.

use afp_ide::actions::{Action, ActionKind, actions as of_place};
use afp_syntax::source::Span;
use gen_lsp_types as lsp;

use crate::answer::{Answer, ok};
use crate::diagnostics;
use crate::file_edits::by_file;
use crate::server::Server;
use crate::workspace::Analysis;

/// Returns all code actions for a selection, of the requested kinds.
pub(crate) fn actions(server: &mut Server, params: lsp::CodeActionParams) -> Answer {
    let analysis = server.analysis(&params.text_document.uri)?;
    let places = server.places(&analysis);
    let (start, end) = (places.offset(params.range.start), places.offset(params.range.end));
    let place = Span { file: analysis.file, start, end: end.max(start) };
    let wanted = |action: &Action| {
        let own = kind(action.kind);
        let own = own.as_str();
        params.context.only.as_ref().is_none_or(|only| {
            only.iter().any(|kind| {
                let kind = kind.as_str();
                kind.is_empty()
                    || own == kind
                    || own.strip_prefix(kind).is_some_and(|rest| rest.starts_with('.'))
            })
        })
    };
    let all = of_place(&analysis.view(), place).into_iter().filter(wanted);
    ok(all.map(|action| shown(server, &analysis, action)).collect::<Vec<_>>())
}

fn shown(server: &Server, analysis: &Analysis, action: Action) -> lsp::CodeAction {
    let places = server.places(analysis);
    let mended = action.mends.and_then(|place| analysis.compiled.diags.iter().nth(place));
    let mended = mended.map(|it| diagnostics::one(&server.workspace, analysis, &places, it));
    let files = by_file(|file| analysis.compiled.sources.get(file), action.edits);
    lsp::CodeAction {
        title: action.title,
        kind: Some(kind(action.kind)),
        is_preferred: (action.kind == ActionKind::Fix && mended.is_some()).then_some(true),
        diagnostics: mended.map(|diagnostic| vec![diagnostic]),
        edit: Some(server.edit(&files)),
        ..lsp::CodeAction::default()
    }
}

fn kind(kind: ActionKind) -> lsp::CodeActionKind {
    match kind {
        ActionKind::Fix => lsp::CodeActionKind::QuickFix,
        ActionKind::Extract => lsp::CodeActionKind::RefactorExtract,
        ActionKind::Inline => lsp::CodeActionKind::RefactorInline,
    }
}
