//! Completion and signatures.

use afp_dsl::index::DefinitionKind;
use afp_ide::completion::{Completion, CompletionKind, Piece, completions};
use gen_lsp_types as lsp;

use crate::answer::{Answer, Failure, ok};
use crate::convert::{Places, text_edit};
use crate::server::Server;
use crate::standard::project;

/// Returns everything that can be written at a position.
pub(crate) fn completion(server: &mut Server, params: lsp::CompletionParams) -> Answer {
    let at = &params.text_document_position_params;
    if let Some(text) = project::text(server, &at.text_document.uri) {
        return project::completion(server, &text, at.position);
    }
    let (analysis, offset) = server.at(&params.text_document_position_params)?;
    let view = analysis.view();
    let places = server.places(&analysis);
    let all = completions(&view, offset);
    let items = all.iter().map(|one| item(one, &places, server.client.snippets));
    ok(lsp::CompletionList {
        is_incomplete: false,
        items: items.collect(),
        ..lsp::CompletionList::default()
    })
}

fn item(one: &Completion, places: &Places<'_>, snippets: bool) -> lsp::CompletionItem {
    let new_text = if snippets { snippet(&one.insert) } else { plain(&one.insert) };
    let holes = snippets && one.insert.iter().any(|piece| matches!(piece, Piece::Hole(_)));
    let range = places.range(one.replaces);
    let with: Vec<_> = one.with.iter().map(|edit| text_edit(places, edit)).collect();
    let doc = lsp::MarkupContent { kind: lsp::MarkupKind::Markdown, value: one.doc.clone() };
    lsp::CompletionItem {
        label: one.label.clone(),
        kind: Some(kind(one.kind)),
        detail: (!one.detail.is_empty()).then(|| one.detail.clone()),
        documentation: (!one.doc.is_empty()).then_some(lsp::Documentation::MarkupContent(doc)),
        sort_text: Some(format!("{}{}", char::from(b'a' + one.rank.min(25)), one.label)),
        insert_text_format: holes.then_some(lsp::InsertTextFormat::Snippet),
        insert_text_mode: Some(lsp::InsertTextMode::AdjustIndentation),
        text_edit: Some(lsp::CompletionItemTextEdit::TextEdit(lsp::TextEdit { range, new_text })),
        additional_text_edits: (!with.is_empty()).then_some(with),
        ..lsp::CompletionItem::default()
    }
}

/// Writes placeholders with numbers, in the protocol's format.
pub(crate) fn snippet(pieces: &[Piece]) -> String {
    if !pieces.iter().any(|piece| matches!(piece, Piece::Hole(_))) {
        return plain(pieces);
    }
    let mut holes = 0;
    let piece = |piece: &Piece| match piece {
        Piece::Text(text) => text.replace('\\', "\\\\").replace('$', "\\$").replace('}', "\\}"),
        Piece::Hole(text) => {
            holes += 1;
            match text.is_empty() {
                true => format!("${holes}"),
                false => format!("${{{holes}:{text}}}"),
            }
        }
    };
    pieces.iter().map(piece).collect()
}

/// Replaces placeholders by their contents.
fn plain(pieces: &[Piece]) -> String {
    pieces
        .iter()
        .map(|piece| match piece {
            Piece::Text(text) | Piece::Hole(text) => text.as_str(),
        })
        .collect()
}

fn kind(kind: CompletionKind) -> lsp::CompletionItemKind {
    use DefinitionKind as Is;
    use lsp::CompletionItemKind as Kind;

    match kind {
        CompletionKind::Keyword => Kind::Keyword,
        CompletionKind::Type => Kind::TypeParameter,
        CompletionKind::Unit => Kind::Unit,
        CompletionKind::Value => Kind::Value,
        CompletionKind::Function => Kind::Function,
        CompletionKind::Definition(definition) => match definition {
            Is::Toolbox | Is::Alias => Kind::Module,
            Is::Template(_) | Is::Plan => Kind::Class,
            Is::Input | Is::Output => Kind::Property,
            Is::State | Is::Event => Kind::Event,
            Is::Object => Kind::Struct,
            Is::Enum => Kind::Enum,
            Is::Value => Kind::EnumMember,
            Is::Entry(_) => Kind::Variable,
            Is::Table => Kind::Constant,
            Is::Component(_) => Kind::Function,
            _ => Kind::Field,
        },
    }
}

/// Returns the ports of the template whose port is being bound.
pub(crate) fn signature(server: &mut Server, params: lsp::SignatureHelpParams) -> Answer {
    let (analysis, offset) = server.at(&params.text_document_position_params)?;
    let found = afp_ide::signature::signature(&analysis.view(), offset);
    let found = found.ok_or(Failure::Nothing)?;
    let units = |at: usize| {
        let before = found.label.get(..at).unwrap_or_default();
        u32::try_from(before.encode_utf16().count()).unwrap_or(u32::MAX)
    };
    let port = |port: &afp_ide::signature::Port| lsp::ParameterInformation {
        label: lsp::ParameterInformationLabel::Tuple((
            units(port.label.start),
            units(port.label.end),
        )),
        documentation: Some(lsp::Documentation::String(port.doc.clone())),
    };
    // Every client reads a number past the last port as "no active port".
    let active = found.active.unwrap_or(found.ports.len());
    let active = lsp::ActiveParameter::Int(u32::try_from(active).unwrap_or(u32::MAX));
    let one = lsp::SignatureInformation {
        parameters: Some(found.ports.iter().map(port).collect()),
        documentation: Some(lsp::Documentation::String(found.doc.clone())),
        label: found.label.clone(),
        active_parameter: None,
    };
    ok(lsp::SignatureHelp {
        signatures: vec![one],
        active_signature: Some(0),
        active_parameter: Some(active),
    })
}
