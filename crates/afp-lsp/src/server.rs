//! The state of the server.

use std::collections::BTreeMap;
use std::fmt;

use serde_json::Value;

use crate::custom::{Drawings, Subscription};
use crate::host::Host;
use crate::uri;
use crate::workspace::Workspace;

/// A language server for one client.
pub struct Server {
    pub(crate) workspace: Workspace,
    pub(crate) client: Client,
    /// The subscribed drawings, by path.
    pub(crate) subscriptions: BTreeMap<String, Subscription>,
    /// Recent drawings, the base of new ones.
    pub(crate) drawings: Drawings,
    /// The last published diagnostics of each document.
    pub(crate) published: BTreeMap<String, Value>,
    pub(crate) phase: Phase,
    /// The number of the last request to the client.
    pub(crate) asked: i32,
}

#[derive(Clone, Debug, Default)]
pub(crate) struct Client {
    /// The client pulls diagnostics, so the server does not push them.
    pub pulls: bool,
    /// The client supports refreshing diagnostics, tokens and hints.
    pub refreshes: [bool; 3],
    /// The client supports placeholders in completions.
    pub snippets: bool,
    /// The client supports edits with versions, and new files.
    pub versions: bool,
    /// The client supports nested symbols.
    pub nests: bool,
    /// The client requests the texts of addresses that are not files.
    pub contents: bool,
    /// The commands that the client offers above plans and scenarios.
    pub commands: Vec<String>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Phase {
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
    /// A server that waits for `initialize`.
    pub fn new(host: Box<dyn Host>) -> Server {
        Server::among(host, Drawings::default())
    }

    /// A server that shares its drawings with others.
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

    /// The text of a document that the client has open, with the client's version of it.
    pub fn text(&self, uri: &str) -> Option<(i32, &str)> {
        let document = self.workspace.documents.get(&uri::path_of(uri))?;
        Some((document.version, &document.text))
    }

    /// The exit code after `exit`: 0, or 1 without a preceding `shutdown`.
    pub fn exit_code(&self) -> Option<u8> {
        match self.phase {
            Phase::New | Phase::Running | Phase::ShutDown => None,
            Phase::Exited { code } => Some(code),
        }
    }
}
