//! Capabilities of client and server.

use afp_ide::tokens::ColourKind;
use afp_syntax::source::Encoding;
use gen_lsp_types as lsp;
use serde_json::{Value, json};

use crate::answer::Answer;
use crate::server::{Client, Server};
use crate::uri;

/// Stores the client's capabilities and returns the server's.
pub(crate) fn initialize(server: &mut Server, params: Value) -> Answer {
    // Clients omit and add much; an unreadable capability counts as missing.
    let can = |path: &str| params.pointer(&format!("/capabilities/{path}"));
    let is = |path: &str| can(path).and_then(Value::as_bool).unwrap_or(false);
    let commands = params.pointer("/initializationOptions/commands").and_then(Value::as_array);
    let commands = commands.into_iter().flatten().filter_map(Value::as_str).map(str::to_owned);
    server.client = Client {
        pulls: can("textDocument/diagnostic").is_some_and(Value::is_object),
        refreshes: [
            is("workspace/diagnostics/refreshSupport"),
            is("workspace/semanticTokens/refreshSupport"),
            is("workspace/inlayHint/refreshSupport"),
        ],
        snippets: is("textDocument/completion/completionItem/snippetSupport"),
        versions: is("workspace/workspaceEdit/documentChanges"),
        nests: is("textDocument/documentSymbol/hierarchicalDocumentSymbolSupport"),
        contents: can("workspace/textDocumentContent").is_some_and(Value::is_object),
        commands: commands.collect(),
    };
    let encodings = can("general/positionEncodings").and_then(Value::as_array);
    let bytes = encodings.is_some_and(|all| all.iter().any(|each| each == "utf-8"));
    server.workspace.encoding = if bytes { Encoding::Utf8 } else { Encoding::Utf16 };
    server.workspace.folders = folders(&params);
    Ok(json!({
        "capabilities": capabilities(&server.client, bytes),
        "serverInfo": { "name": "afp", "version": env!("CARGO_PKG_VERSION") },
    }))
}

fn folders(params: &Value) -> Vec<String> {
    let listed = params.get("workspaceFolders").and_then(Value::as_array);
    let listed = listed.into_iter().flatten().filter_map(|folder| folder.get("uri")?.as_str());
    let mut all: Vec<_> = listed.map(str::to_owned).collect();
    if all.is_empty() {
        all.extend(params.get("rootUri").and_then(Value::as_str).map(str::to_owned));
    }
    all.into_iter().map(|address| uri::path(&lsp::Uri(address))).collect()
}

fn capabilities(client: &Client, bytes: bool) -> Value {
    let kinds: Vec<_> = ColourKind::ALL.iter().map(|kind| kind.name()).collect();
    let mut offered = json!({
        "positionEncoding": if bytes { "utf-8" } else { "utf-16" },
        "textDocumentSync": { "openClose": true, "change": 2, "save": true },
        "completionProvider": { "triggerCharacters": [".", ">", "=", "(", ":"] },
        "hoverProvider": true,
        "signatureHelpProvider": { "triggerCharacters": ["(", ","] },
        "definitionProvider": true,
        "typeDefinitionProvider": true,
        "referencesProvider": true,
        "documentHighlightProvider": true,
        "documentSymbolProvider": true,
        "workspaceSymbolProvider": true,
        "codeActionProvider": { "codeActionKinds": ["quickfix", "refactor.extract", "refactor.inline"] },
        "documentFormattingProvider": true,
        "renameProvider": { "prepareProvider": true },
        "foldingRangeProvider": true,
        "selectionRangeProvider": true,
        "callHierarchyProvider": true,
        "inlayHintProvider": true,
        "semanticTokensProvider": {
            "legend": { "tokenTypes": kinds, "tokenModifiers": ["declaration", "readonly"] },
            "full": true,
        },
        "workspace": { "workspaceFolders": { "supported": true, "changeNotifications": true } },
        "experimental": { "afp": crate::custom::METHODS },
    });
    if !client.commands.is_empty() {
        offered["codeLensProvider"] = json!({});
    }
    if client.pulls {
        offered["diagnosticProvider"] =
            json!({ "interFileDependencies": true, "workspaceDiagnostics": false });
    }
    if client.contents {
        offered["workspace"]["textDocumentContent"] = json!({ "schemes": ["afp"] });
    }
    offered
}
