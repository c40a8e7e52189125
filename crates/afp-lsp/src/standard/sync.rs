//! Diagnostics for clients that ask for them, and texts of built-in toolboxes.

use gen_lsp_types as lsp;
use serde_json::json;

use crate::answer::{Answer, Failure, ok};
use crate::server::Server;
use crate::{diagnostics, uri};

/// What is wrong with a document.
pub(crate) fn diagnostics(server: &mut Server, params: lsp::DocumentDiagnosticParams) -> Answer {
    let path = uri::path(&params.text_document.uri);
    let items = diagnostics::of(&mut server.workspace, &path);
    ok(json!({ "kind": "full", "items": items }))
}

/// The text of a toolbox that is built in.
pub(crate) fn content(server: &mut Server, params: lsp::TextDocumentContentParams) -> Answer {
    let text = server.workspace.text(&uri::path(&params.uri)).map_err(Failure::Refused)?;
    ok(json!({ "text": text }))
}
