//! The appearance of a text: hover, colours, folds, selections, hints and lenses.

use afp_ide::folding::{FoldKind, folds};
use afp_ide::lenses::{Lens, LensAction};
use afp_ide::tokens::{Colour, ColourKind, colours};
use gen_lsp_types as lsp;
use serde_json::json;

use crate::answer::{Answer, Failure, ok};
use crate::convert::Places;
use crate::server::Server;
use crate::standard::project;

/// Returns the description of a word.
pub(crate) fn hover(server: &mut Server, params: lsp::HoverParams) -> Answer {
    let at = &params.text_document_position_params;
    if let Some(text) = project::text(server, &at.text_document.uri) {
        return project::hover(server, &text, at.position);
    }
    let (analysis, offset) = server.at(&params.text_document_position_params)?;
    let found = afp_ide::hover::hover(&analysis.view(), offset).ok_or(Failure::Nothing)?;
    let range = server.places(&analysis).range(found.span);
    let value = found.markdown();
    let contents = lsp::MarkupContent { kind: lsp::MarkupKind::Markdown, value };
    ok(lsp::Hover { contents: lsp::Contents::MarkupContent(contents), range: Some(range) })
}

pub(crate) fn folding(server: &mut Server, params: lsp::FoldingRangeParams) -> Answer {
    let analysis = server.analysis(&params.text_document.uri)?;
    let view = analysis.view();
    let places = server.places(&analysis);
    let range = |fold: &afp_ide::folding::Fold| {
        let (start, end) = (places.position(fold.span.start), places.position(fold.span.end));
        // The line with the closing bracket stays visible.
        let last = if fold.kind == FoldKind::Body { end.line.saturating_sub(1) } else { end.line };
        (last > start.line).then_some(lsp::FoldingRange {
            start_line: start.line,
            end_line: last,
            kind: match fold.kind {
                FoldKind::Body => None,
                FoldKind::Comment => Some(lsp::FoldingRangeKind::Comment),
                FoldKind::Uses => Some(lsp::FoldingRangeKind::Imports),
            },
            ..lsp::FoldingRange::default()
        })
    };
    ok(folds(&view).iter().filter_map(range).collect::<Vec<_>>())
}

pub(crate) fn selection(server: &mut Server, params: lsp::SelectionRangeParams) -> Answer {
    let analysis = server.analysis(&params.text_document.uri)?;
    let view = analysis.view();
    let places = server.places(&analysis);
    let around = |position: &lsp::Position| {
        let all = afp_ide::selection::selections(&view, places.offset(*position));
        let nested = all.iter().rev().fold(None, |parent, span| {
            Some(Box::new(lsp::SelectionRange { range: places.range(*span), parent }))
        });
        nested.map(|smallest| *smallest)
    };
    ok(params.positions.iter().filter_map(around).collect::<Vec<_>>())
}

pub(crate) fn tokens(server: &mut Server, params: lsp::SemanticTokensParams) -> Answer {
    let analysis = server.analysis(&params.text_document.uri)?;
    let places = server.places(&analysis);
    let mut before = lsp::Position::default();
    let token = |colour: &Colour| {
        let range = places.range(colour.span);
        let delta_line = range.start.line - before.line;
        let same = if delta_line == 0 { before.character } else { 0 };
        before = range.start;
        let kind = ColourKind::ALL.iter().position(|kind| *kind == colour.kind).unwrap_or(0);
        lsp::SemanticToken {
            delta_line,
            delta_start: range.start.character - same,
            length: range.end.character - range.start.character,
            token_type: u32::try_from(kind).unwrap_or(0),
            token_modifiers_bitset: u32::from(colour.declares) | u32::from(colour.constant) << 1,
        }
    };
    let data = colours(&analysis.view()).iter().map(token).collect();
    ok(lsp::SemanticTokens { result_id: None, data })
}

/// Returns the timing bound of each supervisor.
pub(crate) fn hints(server: &mut Server, params: lsp::InlayHintParams) -> Answer {
    let analysis = server.analysis(&params.text_document.uri)?;
    let places = server.places(&analysis);
    let all = afp_ide::hints::hints(&analysis.view());
    let shown = all.iter().filter_map(|hint| {
        let position = places.position(hint.at.start);
        let wanted = params.range.start <= position && position <= params.range.end;
        wanted.then(|| lsp::InlayHint {
            position,
            label: lsp::Label::String(hint.label.clone()),
            kind: None,
            text_edits: None,
            tooltip: Some(lsp::Tooltip::String(hint.why.clone())),
            padding_left: Some(true),
            padding_right: None,
            data: None,
        })
    });
    ok(shown.collect::<Vec<_>>())
}

/// Returns commands for plans and scenarios, if the client has them.
pub(crate) fn lenses(server: &mut Server, params: lsp::CodeLensParams) -> Answer {
    let uri = &params.text_document.uri;
    let analysis = server.analysis(uri)?;
    let places = server.places(&analysis);
    let all = afp_ide::lenses::lenses(&analysis.view());
    let shown = all.iter().filter_map(|lens| shown(server, lens, &places, uri));
    ok(shown.collect::<Vec<_>>())
}

fn shown(
    server: &Server,
    lens: &Lens,
    places: &Places<'_>,
    uri: &lsp::Uri,
) -> Option<lsp::CodeLens> {
    let (title, command) = match lens.action {
        LensAction::Run => ("run", "afp.run"),
        LensAction::Debug => ("debug", "afp.debug"),
        LensAction::Draw => ("drawing", "afp.drawing"),
        LensAction::Test => ("test", "afp.test"),
    };
    server.client.commands.iter().any(|known| known == command).then(|| lsp::CodeLens {
        range: places.range(lens.span),
        command: Some(lsp::Command {
            title: title.to_owned(),
            tooltip: None,
            command: command.to_owned(),
            arguments: Some(vec![json!({ "uri": uri, "name": lens.name })]),
        }),
        data: None,
    })
}
