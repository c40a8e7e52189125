//! From names to their definitions and uses.

use std::collections::BTreeSet;

use afp_dsl::index::DefinitionKind;
use afp_ide::definition::Definitions;
use afp_ide::references;
use afp_ide::symbols::Symbol;
use gen_lsp_types as lsp;
use serde_json::{Value, json};

use crate::answer::{Answer, Failure, ok};
use crate::convert::Places;
use crate::server::Server;
use crate::standard::project;
use crate::workspace::Analysis;

/// Returns the declaration of a name.
pub(crate) fn definition(server: &mut Server, params: lsp::DefinitionParams) -> Answer {
    let (analysis, offset) = server.at(&params.text_document_position_params)?;
    locations(server, &analysis, afp_ide::definition::definition(&analysis.view(), offset))
}

/// Returns the template or type of a name.
pub(crate) fn type_definition(server: &mut Server, params: lsp::TypeDefinitionParams) -> Answer {
    let (analysis, offset) = server.at(&params.text_document_position_params)?;
    locations(server, &analysis, afp_ide::definition::type_definition(&analysis.view(), offset))
}

fn locations(server: &Server, analysis: &Analysis, found: Option<Definitions>) -> Answer {
    let found = found.ok_or(Failure::Nothing)?;
    let location = |target: &afp_ide::definition::Target| {
        server.workspace.location(&analysis.compiled, target.name)
    };
    ok(found.targets.iter().filter_map(location).collect::<Vec<_>>())
}

/// Returns all references to a name in the plan files of the workspace.
pub(crate) fn references(server: &mut Server, params: lsp::ReferenceParams) -> Answer {
    let (analysis, offset) = server.at(&params.text_document_position_params)?;
    let view = analysis.view();
    let found = afp_ide::definition::definition(&view, offset);
    let target = found.and_then(|found| found.targets.first().copied()).ok_or(Failure::Nothing)?;
    let home = analysis.compiled.sources.get(target.name.file).ok_or(Failure::Nothing)?;
    let mut all = BTreeSet::new();
    let mut add = |server: &Server, analysis: &Analysis| {
        let sources = &analysis.compiled.sources;
        let file = sources.iter().position(|source| source.name == home.name);
        let Some(file) = file.and_then(|file| u16::try_from(file).ok()) else { return };
        let name = afp_syntax::source::Span { file, ..target.name };
        for span in references::references_to(&analysis.view(), name) {
            let declares = span == name;
            if let Some(at) = server.workspace.location(&analysis.compiled, span)
                && (!declares || params.context.include_declaration)
            {
                all.insert((at.uri.0, at.range.start, at.range.end));
            }
        }
    };
    add(server, &analysis);
    for path in server.workspace.plan_files() {
        if let Some(other) = server.workspace.analysis(&path) {
            add(server, &other);
        }
    }
    let location =
        |(uri, start, end)| lsp::Location { uri: lsp::Uri(uri), range: lsp::Range { start, end } };
    ok(all.into_iter().map(location).collect::<Vec<_>>())
}

/// Returns the references within the document.
pub(crate) fn highlights(server: &mut Server, params: lsp::DocumentHighlightParams) -> Answer {
    let (analysis, offset) = server.at(&params.text_document_position_params)?;
    let places = server.places(&analysis);
    let all = references::highlights(&analysis.view(), offset);
    let highlight = |span| lsp::DocumentHighlight { range: places.range(span), kind: None };
    ok(all.into_iter().map(highlight).collect::<Vec<_>>())
}

pub(crate) fn symbols(server: &mut Server, params: lsp::DocumentSymbolParams) -> Answer {
    let uri = params.text_document.uri;
    if let Some(text) = project::text(server, &uri) {
        return project::symbols(server, &text, &uri);
    }
    let analysis = server.analysis(&uri)?;
    let places = server.places(&analysis);
    let all = afp_ide::symbols::symbols(&analysis.view());
    if server.client.nests {
        return ok(all.iter().map(|one| nested(one, &places)).collect::<Vec<_>>());
    }
    let mut list = Vec::new();
    flat(&all, None, &mut |one, owner| list.push(information(one, owner, &uri, &places)));
    ok(list)
}

fn nested(one: &Symbol, places: &Places<'_>) -> Value {
    json!({
        "name": name(one),
        "detail": one.detail,
        "kind": kind(one.kind),
        "range": places.range(one.span),
        "selectionRange": places.range(one.name_span),
        "children": one.children.iter().map(|child| nested(child, places)).collect::<Vec<_>>(),
    })
}

/// Clients reject symbols without a name.
fn name(one: &Symbol) -> String {
    if one.name.is_empty() { "?".to_owned() } else { one.name.clone() }
}

fn flat(all: &[Symbol], owner: Option<&str>, take: &mut dyn FnMut(&Symbol, Option<&str>)) {
    for one in all {
        take(one, owner);
        flat(&one.children, Some(&one.name), take);
    }
}

fn information(one: &Symbol, owner: Option<&str>, uri: &lsp::Uri, places: &Places<'_>) -> Value {
    json!({
        "name": name(one),
        "kind": kind(one.kind),
        "containerName": owner,
        "location": { "uri": uri, "range": places.range(one.span) },
    })
}

/// Returns the symbols of all plan files in the workspace whose names contain a text.
pub(crate) fn workspace_symbols(server: &mut Server, params: lsp::WorkspaceSymbolParams) -> Answer {
    let wanted = params.query.to_lowercase();
    let mut list = Vec::new();
    for path in server.workspace.plan_files() {
        let Some(analysis) = server.workspace.analysis(&path) else { continue };
        let (places, uri) = (server.places(&analysis), server.workspace.uri(&path));
        flat(&afp_ide::symbols::symbols(&analysis.view()), None, &mut |one, owner| {
            if one.name.to_lowercase().contains(&wanted) {
                list.push(information(one, owner, &uri, &places));
            }
        });
    }
    ok(list)
}

pub(crate) fn kind(kind: DefinitionKind) -> lsp::SymbolKind {
    use DefinitionKind as Is;
    use lsp::SymbolKind as Kind;

    match kind {
        Is::Toolbox | Is::Alias => Kind::Module,
        Is::Template(_) | Is::Plan => Kind::Class,
        Is::Input | Is::Output => Kind::Property,
        Is::Table => Kind::Array,
        Is::State | Is::Event => Kind::Event,
        Is::Object => Kind::Struct,
        Is::Enum => Kind::Enum,
        Is::Value => Kind::EnumMember,
        Is::Entry(_) => Kind::Variable,
        Is::Component(_) => Kind::Function,
        Is::Scenario => Kind::Method,
        Is::Device => Kind::Interface,
        _ => Kind::Field,
    }
}
