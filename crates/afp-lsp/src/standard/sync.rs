//! Diagnostics on request, and texts of built-in toolboxes.

use gen_lsp_types as lsp;
use serde_json::json;

use crate::answer::{Answer, Failure, ok};
use crate::server::Server;
use crate::{diagnostics, uri};

pub(crate) fn diagnostics(server: &mut Server, params: lsp::DocumentDiagnosticParams) -> Answer {
    let path = uri::path(&params.text_document.uri);
    let items = diagnostics::of(&mut server.workspace, &path);
    ok(json!({ "kind": "full", "items": items }))
}

/// Returns the text of a built-in toolbox.
pub(crate) fn content(server: &mut Server, params: lsp::TextDocumentContentParams) -> Answer {
    let text = server.workspace.text(&uri::path(&params.uri)).map_err(Failure::Refused)?;
    ok(json!({ "text": text }))
}
