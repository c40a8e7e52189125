//! The function for each request.

use lsp_server::Request;
use serde_json::Value;

use crate::answer::{Answer, Failure, params};
use crate::custom::{drawing, edit, explain, export, items, offers, robot};
use crate::server::Server;
use crate::standard::{actions, completion, edits, hierarchy, looks, navigation, sync};

/// Answers a request of an initialized conversation.
pub(crate) fn request(server: &mut Server, request: Request) -> Answer {
    let Request { method, params: value, .. } = request;
    match method.as_str() {
        "textDocument/completion" => call(server, value, completion::completion),
        "textDocument/signatureHelp" => call(server, value, completion::signature),
        "textDocument/hover" => call(server, value, looks::hover),
        "textDocument/definition" => call(server, value, navigation::definition),
        "textDocument/typeDefinition" => call(server, value, navigation::type_definition),
        "textDocument/references" => call(server, value, navigation::references),
        "textDocument/documentHighlight" => call(server, value, navigation::highlights),
        "textDocument/documentSymbol" => call(server, value, navigation::symbols),
        "workspace/symbol" => call(server, value, navigation::workspace_symbols),
        "textDocument/prepareCallHierarchy" => call(server, value, hierarchy::prepare),
        "callHierarchy/incomingCalls" => call(server, value, hierarchy::incoming),
        "callHierarchy/outgoingCalls" => call(server, value, hierarchy::outgoing),
        "textDocument/foldingRange" => call(server, value, looks::folding),
        "textDocument/selectionRange" => call(server, value, looks::selection),
        "textDocument/semanticTokens/full" => call(server, value, looks::tokens),
        "textDocument/inlayHint" => call(server, value, looks::hints),
        "textDocument/codeLens" => call(server, value, looks::lenses),
        "textDocument/codeAction" => call(server, value, actions::actions),
        "textDocument/prepareRename" => call(server, value, edits::prepare_rename),
        "textDocument/rename" => call(server, value, edits::rename),
        "textDocument/formatting" => call(server, value, edits::formatting),
        "textDocument/diagnostic" => call(server, value, sync::diagnostics),
        "workspace/textDocumentContent" => call(server, value, sync::content),
        "afp/drawing" => call(server, value, drawing::drawing),
        "afp/edit" => call(server, value, edit::edit),
        "afp/place" => call(server, value, edit::place),
        "afp/copy" => call(server, value, edit::copy),
        "afp/paste" => call(server, value, edit::paste),
        "afp/itemAt" => call(server, value, items::item_at),
        "afp/spanOf" => call(server, value, items::span_of),
        "afp/uses" => call(server, value, items::uses),
        "afp/palette" => call(server, value, offers::palette),
        "afp/candidates" => call(server, value, offers::candidates),
        "afp/parts" => call(server, value, offers::parts),
        "afp/robot" => call(server, value, robot::robot),
        "afp/timing" => call(server, value, export::timing),
        "afp/export" => call(server, value, export::export),
        "afp/explain" => call(server, value, explain::explain),
        _ => Err(Failure::Unknown(method)),
    }
}

fn call<P: serde::de::DeserializeOwned>(
    server: &mut Server,
    value: Value,
    answer: fn(&mut Server, P) -> Answer,
) -> Answer {
    answer(server, params(value)?)
}
