//! The order of a conversation: which messages each client message causes.

use gen_lsp_types as lsp;
use lsp_server::{Message, Notification, Request};
use serde_json::Value;

use crate::answer::{Answer, Failure, params, response};
use crate::server::{Phase, Server};
use crate::uri;
use crate::{diagnostics, dispatch, standard};

impl Server {
    /// Handles a message of the client and returns the response to a request.
    pub fn handle(&mut self, message: Message) -> Vec<Message> {
        match message {
            Message::Request(request) => {
                let id = request.id.clone();
                vec![response(id, self.request(request)).into()]
            }
            Message::Notification(notification) => {
                // The protocol has no response to an invalid notification.
                let _ = self.notification(notification);
                Vec::new()
            }
            // Responses to the server's own requests carry no data.
            Message::Response(_) => Vec::new(),
        }
    }

    /// Returns changed diagnostics of open documents, and changed drawings.
    ///
    /// Call it when no client message is waiting. Each affected document is compiled once.
    pub fn idle(&mut self) -> Vec<Message> {
        if self.phase != Phase::Running {
            return Vec::new();
        }
        let mut messages = self.changed_diagnostics();
        messages.extend(self.changed_drawings());
        messages
    }

    fn request(&mut self, request: Request) -> Answer {
        match (self.phase, request.method.as_str()) {
            (Phase::New, "initialize") => {
                let answer = standard::initialize(self, params(request.params)?);
                self.phase = Phase::Running;
                answer
            }
            (Phase::New, _) => Err(Failure::NotInitialized),
            (Phase::Running, "shutdown") => {
                self.phase = Phase::ShutDown;
                Ok(Value::Null)
            }
            (Phase::Running, "initialize") => {
                Err(Failure::OutOfTurn("the server is already running"))
            }
            (Phase::Running, _) => dispatch::request(self, request),
            _ => Err(Failure::OutOfTurn("the server has been shut down")),
        }
    }

    fn notification(&mut self, notification: Notification) -> Result<(), Failure> {
        let Notification { method, params: value } = notification;
        if method == "exit" {
            self.phase = Phase::Exited { code: u8::from(self.phase != Phase::ShutDown) };
            return Ok(());
        }
        if self.phase != Phase::Running {
            return Ok(());
        }
        let workspace = &mut self.workspace;
        match method.as_str() {
            "textDocument/didOpen" => {
                let item = params::<lsp::DidOpenTextDocumentParams>(value)?.text_document;
                workspace.documents.open(uri::path(&item.uri), item);
            }
            "textDocument/didChange" => {
                let change: lsp::DidChangeTextDocumentParams = params(value)?;
                let id = change.text_document;
                let path = uri::path(&id.text_document_identifier.uri);
                let encoding = workspace.encoding;
                workspace.documents.change(&path, id.version, change.content_changes, encoding);
            }
            "textDocument/didClose" => {
                let id = params::<lsp::DidCloseTextDocumentParams>(value)?.text_document;
                let path = uri::path(&id.uri);
                workspace.documents.close(&path);
                workspace.forget(&path);
                self.subscriptions.remove(&path);
            }
            "textDocument/didSave" | "workspace/didChangeWatchedFiles" => {
                workspace.documents.disk_changed();
            }
            "workspace/didChangeWorkspaceFolders" => {
                let event = params::<lsp::DidChangeWorkspaceFoldersParams>(value)?.event;
                let gone: Vec<_> = event.removed.iter().map(|it| uri::path(&it.uri)).collect();
                workspace.folders.retain(|folder| !gone.contains(folder));
                workspace.folders.extend(event.added.iter().map(|it| uri::path(&it.uri)));
            }
            _ => {}
        }
        Ok(())
    }

    /// Returns diagnostics that changed since the last message, and a refresh for a client that
    /// pulls.
    fn changed_diagnostics(&mut self) -> Vec<Message> {
        let open = self.workspace.documents.iter();
        let open: Vec<_> =
            open.map(|(path, it)| (path.to_owned(), it.uri.clone(), it.version)).collect();
        let mut messages = Vec::new();
        let mut stale = false;
        for (path, uri, version) in &open {
            let list = diagnostics::of(&mut self.workspace, path);
            let said = serde_json::to_value(&list).unwrap_or_default();
            if self.published.get(path) == Some(&said) {
                continue;
            }
            stale |= self.published.insert(path.clone(), said).is_some();
            if !self.client.pulls {
                messages.push(published(uri.clone(), Some(*version), list));
            }
        }
        let closed =
            self.published.keys().filter(|path| self.workspace.documents.get(path).is_none());
        for path in closed.cloned().collect::<Vec<_>>() {
            self.published.remove(&path);
            if !self.client.pulls {
                messages.push(published(uri::uri(&path), None, Vec::new()));
            }
        }
        if stale {
            messages.extend(self.refreshes());
        }
        messages
    }

    /// Asks the client to refresh tokens and hints after a change elsewhere.
    fn refreshes(&mut self) -> Vec<Message> {
        const METHODS: [&str; 3] = [
            "workspace/diagnostic/refresh",
            "workspace/semanticTokens/refresh",
            "workspace/inlayHint/refresh",
        ];
        let wanted = METHODS.iter().zip(self.client.refreshes).filter(|(_, wanted)| *wanted);
        let wanted: Vec<_> = wanted.map(|(method, _)| (*method).to_owned()).collect();
        let ask = |method: String| {
            self.asked += 1;
            Request::new(self.asked.into(), method, Value::Null).into()
        };
        wanted.into_iter().map(ask).collect()
    }
}

fn published(uri: lsp::Uri, version: Option<i32>, diagnostics: Vec<lsp::Diagnostic>) -> Message {
    let params = lsp::PublishDiagnosticsParams { uri, version, diagnostics };
    Notification::new("textDocument/publishDiagnostics".to_owned(), params).into()
}
