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
    /// The drawings that the client wants to hear of, by path.
    pub(crate) subscriptions: BTreeMap<String, Subscription>,
    /// What new drawings are made from.
    pub(crate) drawings: Drawings,
    /// The diagnostics that each document was last said to have.
    pub(crate) published: BTreeMap<String, Value>,
    pub(crate) phase: Phase,
    /// The number of the next request to the client.
    pub(crate) asked: i32,
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
}
