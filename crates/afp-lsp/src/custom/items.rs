//! From text positions to items and back, so that selection and cursor follow each other.

use afp_dsl::Compiled;
use afp_dsl::outline::{Identity, Part};
use afp_ide::edit::{item, path, with_comments};
use gen_lsp_types as lsp;
use serde::Deserialize;
use serde_json::{Value, json};

use super::Document;
use super::scene::part;
use crate::answer::{Answer, Failure, ok};
use crate::server::Server;

/// Returns the smallest item, or part of one, at a text position.
pub(crate) fn item_at(server: &mut Server, params: lsp::TextDocumentPositionParams) -> Answer {
    let (analysis, offset) = server.at(&params)?;
    let found = analysis.compiled.outline.identity_at(analysis.file, offset);
    ok(found.map(|found| json!({ "item": path(&found.item), "part": part(&found.part) })))
}

/// An item of a document, or a part of one.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct SpanOf {
    text_document: Document,
    item: String,
    part: Option<PartOf>,
    /// Whether the span includes the item's comments, as for copying.
    #[serde(default)]
    comments: bool,
}

/// A part of an item, in the format of [`part`].
#[derive(Clone, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct PartOf {
    kind: String,
    #[serde(default)]
    name: String,
    #[serde(default = "first")]
    nth: u16,
}

fn first() -> u16 {
    1
}

pub(crate) fn span_of(server: &mut Server, params: SpanOf) -> Answer {
    let analysis = server.analysis(&params.text_document.uri)?;
    let item = item(&params.item).ok_or_else(|| no_item(&params.item))?;
    if params.comments {
        let span = with_comments(analysis.file, analysis.view().text(), &item);
        return ok(span.map(|span| server.places(&analysis).range(span)));
    }
    let part = params.part.map_or(Some(Part::Whole), meant);
    let part = part.ok_or_else(|| Failure::Malformed("there is no such part".to_owned()))?;
    let identity = Identity { file: analysis.file, item, part };
    let span = analysis.compiled.outline.span_of(&identity);
    ok(span.map(|span| server.places(&analysis).range(span)))
}

/// An item of a document.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct OfItem {
    pub(super) text_document: Document,
    pub(super) item: String,
}

/// Lists the places in a document that read or write an entry, each once, in source order.
pub(crate) fn uses(server: &mut Server, params: OfItem) -> Answer {
    let analysis = server.analysis(&params.text_document.uri)?;
    let item = item(&params.item).ok_or_else(|| no_item(&params.item))?;
    let Compiled { outline, index, .. } = &analysis.compiled;
    let entries = outline
        .plans
        .iter()
        .filter(|plan| plan.file() == analysis.file)
        .flat_map(|plan| &plan.entries);
    let entry =
        entries.filter_map(|entry| (entry.item == item).then_some(entry.name.as_ref()?)).next();
    let Some(definition) = entry.and_then(|name| index.declared_at(name.span)) else {
        return ok(Value::Array(Vec::new()));
    };
    let own = index.references(definition).filter(|span| span.file == analysis.file);
    let mut found: Vec<_> =
        own.filter_map(|span| outline.identity_at(analysis.file, span.start)).collect();
    found.dedup();
    let found = found.iter().map(|one| json!({ "item": path(&one.item), "part": part(&one.part) }));
    ok(found.collect::<Vec<_>>())
}

pub(crate) fn no_item(path: &str) -> Failure {
    Failure::Malformed(format!("'{path}' is not the path of an item"))
}

fn meant(part: PartOf) -> Option<Part> {
    let PartOf { kind, name, nth } = part;
    Some(match kind.as_str() {
        "whole" => Part::Whole,
        "start" => Part::Start(nth),
        "input" => Part::Input { name, nth },
        "output" => Part::Output { name, nth },
        "exit" => Part::Exit { name, nth },
        _ => return None,
    })
}
