//! The server: its state and the order of a conversation.

use std::collections::BTreeMap;
use std::fmt;

use gen_lsp_types as lsp;
use lsp_server::{Message, Notification, Request};
use serde_json::Value;

use crate::answer::{Answer, Failure, params, response};
use crate::custom::{Drawings, Subscription};
use crate::host::Host;
use crate::uri;
use crate::workspace::{PROJECT, Workspace};
use crate::{diagnostics, dispatch, standard};

/// A language server for one client.
pub struct Server {
    pub(crate) workspace: Workspace,
    pub(crate) client: Client,
    /// The drawings that the client wants to hear of, by path.
    pub(crate) subscriptions: BTreeMap<String, Subscription>,
    /// What new drawings are made from.
    pub(crate) drawings: Drawings,
    /// The diagnostics that each document was last said to have.
    published: BTreeMap<String, Value>,
    phase: Phase,
    /// The number of the next request to the client.
    asked: i32,
}

/// What the client can do.
#[derive(Clone, Debug, Default)]
pub(crate) struct Client {
    /// It asks for diagnostics, so that none are pushed.
    pub pulls: bool,
    /// It takes up a refresh of diagnostics, tokens and hints.
    pub refreshes: [bool; 3],
    /// It fills holes in what is completed.
    pub snippets: bool,
    /// It takes edits with versions, and new files.
    pub versions: bool,
    /// It nests symbols.
    pub nests: bool,
    /// It asks for texts of addresses that are no files.
    pub contents: bool,
    /// The commands that it offers above plans and scenarios.
    pub commands: Vec<String>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Phase {
    New,
    Running,
    ShutDown,
    Exited { code: u8 },
}

impl fmt::Debug for Server {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Server").field("phase", &self.phase).finish_non_exhaustive()
    }
}

impl Server {
    /// A server that has not heard of its client yet.
    pub fn new(host: Box<dyn Host>) -> Server {
        Server::among(host, Drawings::default())
    }

    /// A server that shares what it draws with others.
    pub fn among(host: Box<dyn Host>, drawings: Drawings) -> Server {
        Server {
            drawings,
            workspace: Workspace::new(host),
            client: Client::default(),
            subscriptions: BTreeMap::new(),
            published: BTreeMap::new(),
            phase: Phase::New,
            asked: 0,
        }
    }

    /// Takes a message of the client and gives what it brings about at once: the response to a request.
    pub fn handle(&mut self, message: Message) -> Vec<Message> {
        match message {
            Message::Request(request) => {
                let id = request.id.clone();
                vec![response(id, self.request(request)).into()]
            }
            Message::Notification(notification) => {
                // Nobody can be told that a notification makes no sense.
                let _ = self.notification(notification);
                Vec::new()
            }
            // The answers to what the server asks say nothing.
            Message::Response(_) => Vec::new(),
        }
    }

    /// What has changed since it was last called: diagnostics of open documents and drawings.
    ///
    /// To be called when no further message of the client is waiting. Each document that a change
    /// concerns is compiled once.
    pub fn idle(&mut self) -> Vec<Message> {
        if self.phase != Phase::Running {
            return Vec::new();
        }
        let mut messages = self.changed_diagnostics();
        messages.extend(self.changed_drawings());
        messages
    }

    /// The text of a document that the client has open, with the client's version of it.
    pub fn text(&self, uri: &str) -> Option<(i32, &str)> {
        let document = self.workspace.documents.get(&uri::path_of(uri))?;
        Some((document.version, &document.text))
    }

    /// The code to exit with, once the client has said goodbye: 0, or 1 where it did not shut the
    /// server down before.
    pub fn exit_code(&self) -> Option<u8> {
        match self.phase {
            Phase::New | Phase::Running | Phase::ShutDown => None,
            Phase::Exited { code } => Some(code),
        }
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
            (Phase::Running, "initialize") => Err(Failure::OutOfTurn("the server runs already")),
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

    /// Diagnostics that differ from what the client was last told, and a refresh where it asks itself.
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

    /// Asks the client to ask again for what a change elsewhere may have changed.
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

/// The message that tells the diagnostics of a document.
fn published(uri: lsp::Uri, version: Option<i32>, diagnostics: Vec<lsp::Diagnostic>) -> Message {
    let params = lsp::PublishDiagnosticsParams { uri, version, diagnostics };
    Notification::new("textDocument/publishDiagnostics".to_owned(), params).into()
}

/// Whether a path is that of a project file.
pub(crate) fn is_project(path: &str) -> bool {
    path.rsplit('/').next() == Some(PROJECT)
}
