//! The shared state of a folder's clients: open texts, the editing client and unsaved changes.
//!
//! It is a value without threads and clocks: client messages come in with the time, and messages to
//! clients go out.

mod document;
mod following;
mod jobs;
mod requests;
mod saving;

use std::collections::BTreeMap;
use std::path::Path;
use std::time::Duration;

use afp_lsp::{Drawings, Message, Server, path_of, uri_of};
use lsp_server::{Notification, Request};
use serde_json::{Value, json};

use crate::MakeHost;
use crate::examples::Example;
use crate::files::{Folder, Listed, with_newlines};
use crate::trust::{Trust, Trusted};
use document::Document;
use following::Following;
use jobs::Jobs;
pub(crate) use jobs::{JobId, Order};

pub type ClientId = u32;

/// Messages with their receivers.
pub type Out = Vec<(ClientId, Message)>;

/// The time for which the edit lock waits for a lost client, long enough for a reconnection or a
/// reload.
const PEN_WAITS: Duration = Duration::from_secs(5);

/// The interval of checks for changes by other programs.
const LOOKS_EVERY: Duration = Duration::from_millis(500);

pub struct Room {
    folder: Folder,
    open: Option<String>,
    examples: Vec<Example>,
    host: MakeHost,
    clients: BTreeMap<ClientId, Client>,
    /// The drawings of all servers, which outlive them.
    drawings: Drawings,
    /// The open texts, by path.
    documents: BTreeMap<String, Document>,
    /// The client with the edit lock.
    pen: Option<ClientId>,
    /// The time when the edit lock moves on, if its holder is gone.
    falls: Option<Duration>,
    listed: Listed,
    looked: Duration,
    /// The time of the last scan of the folder.
    walked: Duration,
    walking: Duration,
    trust: Trust,
    jobs: Jobs,
}

impl std::fmt::Debug for Room {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Room").field("folder", &self.folder).finish_non_exhaustive()
    }
}

/// A client and its language server.
struct Client {
    server: Server,
    /// Whether messages arrived since its server was last idle.
    busy: bool,
    following: Following,
}

impl Room {
    /// A room without clients.
    pub fn new(
        folder: Folder,
        open: Option<&Path>,
        examples: Vec<Example>,
        host: MakeHost,
    ) -> Room {
        let open = open.and_then(|path| folder.inside(path.to_str()?).ok());
        let open = open.and_then(|path| Some(uri_of(path.to_str()?)));
        let listed = folder.list();
        let trust = Trust::of(folder.root());
        Room {
            folder,
            open,
            examples,
            host,
            clients: BTreeMap::new(),
            drawings: Drawings::default(),
            documents: BTreeMap::new(),
            pen: None,
            falls: None,
            listed,
            looked: Duration::ZERO,
            walked: Duration::ZERO,
            walking: Duration::ZERO,
            trust,
            jobs: Jobs::default(),
        }
    }

    pub fn folder(&self) -> &Folder {
        &self.folder
    }

    /// Whether the folder is trusted to run, now and later.
    pub fn trusted(&self) -> Trusted {
        self.trust.shared()
    }

    /// The folder's address for clients.
    fn root(&self) -> String {
        uri_of(&self.folder.root().to_string_lossy())
    }

    /// Draws the plan to open in advance, while the browser starts.
    pub fn draw_ahead(&self) {
        let Some(uri) = &self.open else { return };
        let mut server = self.server();
        let initialize = json!({ "capabilities": {}, "rootUri": self.root() });
        let drawing = json!({ "textDocument": { "uri": uri } });
        for (id, method, params) in [(1, "initialize", initialize), (2, "afp/drawing", drawing)] {
            server.handle(Request::new(id.into(), method.to_owned(), params).into());
        }
    }

    pub fn join(&mut self, client: ClientId) {
        self.pen.get_or_insert(client);
        let (server, following) = (self.server(), Following::default());
        self.clients.insert(client, Client { server, busy: false, following });
    }

    /// Removes a client. The edit lock and its jobs wait for a while.
    pub fn leave(&mut self, client: ClientId, now: Duration) {
        self.clients.remove(&client);
        if self.pen == Some(client) {
            self.falls = Some(now + PEN_WAITS);
        }
        self.leave_jobs(client, now);
        self.forget();
    }

    /// Handles a client's previous id after a reconnection. It regains its edit lock and its jobs.
    /// A new client that is the only one gets a waiting lock at once.
    fn greeted(&mut self, client: ClientId, before: Option<ClientId>) {
        let is_alone = before.is_none() && self.clients.len() == 1;
        if self.falls.is_some() && (before == self.pen || is_alone) {
            (self.pen, self.falls) = (Some(client), None);
        }
        before.into_iter().for_each(|before| self.take_jobs(client, before));
    }

    fn server(&self) -> Server {
        Server::among((self.host)(), self.drawings.clone())
    }

    pub fn handle(&mut self, client: ClientId, message: Message, now: Duration) -> Out {
        if !self.clients.contains_key(&client) {
            return Vec::new();
        }
        match message {
            Message::Request(request) if requests::is_ours(&request.method) => {
                let Request { id, method, params } = request;
                let (answer, mut out) = requests::answer(self, client, &method, &params, now);
                let response = match answer {
                    Ok(value) => lsp_server::Response::new_ok(id, value),
                    Err(why) => lsp_server::Response::new_err(id, REFUSED, why),
                };
                out.insert(0, (client, response.into()));
                out
            }
            Message::Notification(notification) => self.notified(client, notification, now),
            other => self.forward(client, other),
        }
    }

    /// Returns the idle messages of the language servers, when no message is waiting.
    pub fn idle(&mut self) -> Out {
        let mut out = Vec::new();
        for (&id, client) in &mut self.clients {
            if std::mem::take(&mut client.busy) {
                out.extend(client.server.idle().into_iter().map(|message| (id, message)));
            }
        }
        out
    }

    fn forward(&mut self, id: ClientId, message: Message) -> Out {
        let Some(client) = self.clients.get_mut(&id) else { return Vec::new() };
        client.busy = true;
        client.server.handle(message).into_iter().map(|message| (id, message)).collect()
    }

    fn notified(&mut self, id: ClientId, notification: Notification, now: Duration) -> Out {
        let uri = notification.params["textDocument"]["uri"].as_str().map(str::to_owned);
        let taken = notification.params["taken"].as_u64().and_then(|number| number.try_into().ok());
        let method = notification.method.clone();
        let mut out = self.forward(id, notification.into());
        let Some(uri) = uri else { return out };
        match method.as_str() {
            "textDocument/didOpen" => out.extend(self.opened(id, &uri)),
            "textDocument/didChange" => out.extend(self.changed(id, &uri, taken, now)),
            "textDocument/didClose" => self.closed(id, &uri),
            _ => {}
        }
        out
    }

    /// A client has opened a text, and receives the room's text if it differs.
    fn opened(&mut self, id: ClientId, uri: &str) -> Out {
        let path = path_of(uri);
        let Some((version, own)) = self.text_of(id, uri) else { return Vec::new() };
        let own = own.to_owned();
        let following = self.clients.get_mut(&id).map(|client| &mut client.following);
        following.into_iter().for_each(|following| following.opened(uri, version));
        match self.document(&path) {
            Ok(document) => {
                let (text, theirs) = (document.text.clone(), document.theirs().map(str::to_owned));
                let mut out = Vec::new();
                if own != text {
                    out.extend(self.tell(id, uri, &text));
                }
                // A client that arrives during a conflict can also choose.
                out.extend(theirs.map(|theirs| (id, disputed(uri, &theirs))));
                out
            }
            // Texts outside the folder are shown and never written.
            Err(_) => Vec::new(),
        }
    }

    /// A client has changed a text: the others receive it, or the client receives a rejection.
    fn changed(&mut self, id: ClientId, uri: &str, taken: Option<u32>, now: Duration) -> Out {
        let path = path_of(uri);
        let Some((version, own)) = self.text_of(id, uri) else { return Vec::new() };
        let own = own.to_owned();
        let pen = *self.pen.get_or_insert(id);
        let Ok(document) = self.document(&path) else { return Vec::new() };
        let kept = document.text.clone();
        let Some(client) = self.clients.get_mut(&id) else { return Vec::new() };
        if !client.following.has_all(uri, version, taken, own == kept) {
            return Vec::new();
        }
        if own == kept {
            return self.tell_if_saved(id, &path);
        }
        if pen != id {
            return Vec::from_iter(self.tell(id, uri, &kept));
        }
        let text = with_newlines(&own);
        if let Ok(document) = self.document(&path) {
            document.set(text.to_string(), now);
        }
        let mut out = self.tell_all(uri, &text);
        out.extend(self.tell_if_saved(id, &path));
        out
    }

    fn closed(&mut self, id: ClientId, uri: &str) {
        let following = self.clients.get_mut(&id).map(|client| &mut client.following);
        following.into_iter().for_each(|following| following.closed(uri));
        self.forget();
    }

    /// Forgets saved texts that no client has open.
    fn forget(&mut self) {
        let clients = &self.clients;
        self.documents.retain(|path, document| {
            let uri = uri_of(path);
            let is_open = clients.values().any(|client| client.server.text(&uri).is_some());
            is_open || !document.is_in_file()
        });
    }

    /// Returns a text of the folder, and reads it if it is not open.
    fn document(&mut self, path: &str) -> Result<&mut Document, String> {
        if !self.documents.contains_key(path) {
            let file = self.folder.inside(path)?;
            self.documents.insert(path.to_owned(), Document::read(file)?);
        }
        self.documents.get_mut(path).ok_or_else(|| "there is no such file".to_owned())
    }

    /// The text that a client has open, and its version.
    fn text_of(&self, id: ClientId, uri: &str) -> Option<(i32, &str)> {
        self.clients.get(&id)?.server.text(uri)
    }

    /// The clients with that text open.
    fn having(&self, uri: &str) -> Vec<ClientId> {
        let clients = self.clients.keys().copied();
        clients.filter(|&id| self.text_of(id, uri).is_some()).collect()
    }

    fn tell(&mut self, id: ClientId, uri: &str, text: &str) -> Option<(ClientId, Message)> {
        Some((id, self.clients.get_mut(&id)?.following.tell(uri, text)))
    }

    /// Sends the room's text to clients that have, or are about to have, a different one.
    fn tell_all(&mut self, uri: &str, text: &str) -> Out {
        let has_other = |(_, client): &(&ClientId, &Client)| {
            let own = client.server.text(uri);
            own.is_some_and(|(_, own)| own != text || client.following.is_behind(uri))
        };
        let clients: Vec<_> = self.clients.iter().filter(has_other).map(|(&id, _)| id).collect();
        clients.into_iter().filter_map(|id| self.tell(id, uri, text)).collect()
    }

    fn hand_pen(&mut self, to: Option<ClientId>) -> Out {
        (self.pen, self.falls) = (to, None);
        let say = |&id: &ClientId| {
            (id, notification("afp/pen", json!({ "holder": to, "yours": to == Some(id) })))
        };
        self.clients.keys().map(say).collect()
    }

    /// The file list for clients.
    fn files(&self) -> Value {
        let file = |path: &String| json!({ "uri": uri_of(path), "name": self.folder.name(path) });
        self.listed.files.keys().map(file).collect()
    }
}

/// The error code of a request that the room rejects with a readable reason.
const REFUSED: i32 = -32803;

fn notification(method: &str, params: Value) -> Message {
    Notification { method: method.to_owned(), params }.into()
}

/// The message for a conflict between the room's text and the file's.
fn disputed(uri: &str, theirs: &str) -> Message {
    notification("afp/changed", json!({ "uri": uri, "text": theirs, "clean": false }))
}
