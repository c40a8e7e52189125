//! The project file `afp.toml`: completion, hover and outline.

use std::ops::Range;

use afp_project::{Key, SpotKind, headings, keys, spot};
use afp_syntax::source::Span;
use gen_lsp_types as lsp;
use serde_json::{Value, json};

use crate::answer::{Answer, ok};
use crate::convert::Places;
use crate::server::Server;
use crate::uri;
use crate::workspace::is_project;

/// Returns the text of a document if it is a project file.
pub(super) fn text(server: &Server, uri: &lsp::Uri) -> Option<String> {
    let path = uri::path(uri);
    is_project(&path).then(|| server.workspace.text(&path).ok()).flatten()
}

/// Returns headings, and the keys of the table at a position.
pub(super) fn completion(server: &Server, text: &str, position: lsp::Position) -> Answer {
    let places = Places::new(text, server.workspace.encoding);
    let found = spot(text, places.offset(position) as usize);
    let is_heading = found.kind == SpotKind::Heading;
    let offered = match found.kind {
        SpotKind::Value => Vec::new(),
        SpotKind::Heading | SpotKind::Key => keys(&found.table),
    };
    // A line can begin another table; the first lines always can.
    let line = text[..found.word.start].rsplit('\n').next().unwrap_or_default();
    let may_begin =
        found.kind == SpotKind::Key && line.trim().is_empty() && !found.table.is_empty();
    let heads = if may_begin { keys(&[]) } else { Vec::new() };
    let has_value = text[found.word.end..].trim_start_matches([' ', '\t']).starts_with('=');
    let item = |(rank, key): (&str, &Key)| {
        let new_text = match is_heading && found.table.is_empty() {
            true => key.example.trim_matches(['[', ']']),
            false if is_heading || has_value => key.name,
            false => key.example,
        };
        let edit =
            lsp::TextEdit { range: range(&places, &found.word), new_text: new_text.to_owned() };
        lsp::CompletionItem {
            label: key.name.to_owned(),
            kind: Some(lsp::CompletionItemKind::Property),
            detail: Some(key.example.to_owned()),
            documentation: Some(lsp::Documentation::String(key.help.to_owned())),
            sort_text: Some(format!("{rank}{}", key.name)),
            text_edit: Some(lsp::CompletionItemTextEdit::TextEdit(edit)),
            ..lsp::CompletionItem::default()
        }
    };
    let ranked = offered.iter().map(|key| ("a", key)).chain(heads.iter().map(|key| ("b", key)));
    let items = ranked.map(item).collect();
    ok(lsp::CompletionList { is_incomplete: false, items, ..lsp::CompletionList::default() })
}

/// Describes a key.
pub(super) fn hover(server: &Server, text: &str, position: lsp::Position) -> Answer {
    let places = Places::new(text, server.workspace.encoding);
    let found = spot(text, places.offset(position) as usize);
    let word = text.get(found.word.clone()).unwrap_or_default();
    let key = keys(&found.table).into_iter().find(|key| key.name == word);
    let Some(key) = key.filter(|_| found.kind != SpotKind::Value) else { return Ok(Value::Null) };
    let value = format!("```toml\n{}\n```\n\n{}", key.example, key.help);
    let contents = lsp::MarkupContent { kind: lsp::MarkupKind::Markdown, value };
    let range = Some(range(&places, &found.word));
    ok(lsp::Hover { contents: lsp::Contents::MarkupContent(contents), range })
}

/// Returns the headings.
pub(super) fn symbols(server: &Server, text: &str, uri: &lsp::Uri) -> Answer {
    let places = Places::new(text, server.workspace.encoding);
    let all: Vec<_> = headings(text);
    let ends = all.iter().skip(1).map(|next| next.start).chain([text.len()]);
    let symbol = |(head, end): (&Range<usize>, usize)| {
        let line = &text[head.clone()];
        let name = line.trim_start_matches('[').split(']').next().unwrap_or(line).trim();
        let name = if name.is_empty() { "?" } else { name };
        let kind = lsp::SymbolKind::Module;
        let whole = head.start..head.start + text[head.start..end].trim_end().len();
        let (whole, own) = (range(&places, &whole), range(&places, head));
        match server.client.nests {
            true => json!({ "name": name, "kind": kind, "range": whole, "selectionRange": own }),
            false => {
                json!({ "name": name, "kind": kind, "location": { "uri": uri, "range": whole } })
            }
        }
    };
    ok(all.iter().zip(ends).map(symbol).collect::<Vec<_>>())
}

fn range(places: &Places<'_>, bytes: &Range<usize>) -> lsp::Range {
    let number = |at| u32::try_from(at).unwrap_or(u32::MAX);
    places.range(Span { file: 0, start: number(bytes.start), end: number(bytes.end) })
}
