//! The clients of a run: their numbering, subscriptions, joining and leaving.

use std::collections::BTreeMap;
use std::time::Duration as Wall;

use afp_dsl::files::uri_of;
use dapts::IEvent;
use serde_json::{Value, json};

use super::Adapter;

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ClientId(u32);

/// A message with its receiver.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Outgoing {
    pub to: ClientId,
    /// The message, without a header.
    pub message: String,
}

#[derive(Debug)]
pub(super) struct Client {
    pub name: String,
    pub counting: Counting,
    pub names_uris: bool,
    /// The number of the last message sent to it.
    sent: i64,
    /// Whether it has given the token.
    pub admitted: bool,
    /// Whether it receives the run's events.
    pub attached: bool,
    /// Whether it receives state messages.
    pub state: bool,
    /// Whether it receives the robot's signals.
    pub sensed: bool,
    /// Whether it receives the trace as records.
    pub trace: bool,
    /// Whether it knows AFP's own requests, and therefore AFP's own events.
    pub ours: bool,
    /// The lease on its role, if it has one.
    pub lease: Option<Lease>,
    /// Whether it has disconnected.
    pub over: bool,
    /// The names of the program's files on the client's machine, if they differ.
    pub paths: BTreeMap<String, String>,
}

/// The time of the last question of a lease, and how long it is unanswered.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lease {
    pub asked: Wall,
    /// The time during which an answer could have arrived; `None` if no question is open.
    pub open: Option<Wall>,
}

/// The line and column numbers of a client.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Counting {
    /// The number of the first line.
    pub first_line: u32,
    /// The number of the first column.
    pub first_column: u32,
}

impl ClientId {
    pub(super) fn number(self) -> u32 {
        self.0
    }
}

impl Default for Counting {
    fn default() -> Self {
        Counting { first_line: 1, first_column: 1 }
    }
}

pub(super) fn rename_sources(message: &mut Value, rename: fn(&str) -> String) {
    if let Some(Value::String(path)) = message.pointer_mut("/source/path") {
        *path = rename(path);
    }
    match message {
        Value::Object(fields) => fields.values_mut().for_each(|it| rename_sources(it, rename)),
        Value::Array(all) => all.iter_mut().for_each(|it| rename_sources(it, rename)),
        _ => {}
    }
}

/// Gives sources the names that the client's files have. The client shows its own text.
fn to_client(message: &mut Value, paths: &BTreeMap<String, String>) {
    if let Some(source) = message.get_mut("source").and_then(Value::as_object_mut)
        && let Some(path) = source.get("path").and_then(Value::as_str).and_then(|it| paths.get(it))
    {
        source.insert("path".to_owned(), json!(path));
        source.remove("sourceReference");
    }
    match message {
        Value::Object(fields) => fields.values_mut().for_each(|it| to_client(it, paths)),
        Value::Array(all) => all.iter_mut().for_each(|it| to_client(it, paths)),
        _ => {}
    }
}

impl Adapter<'_> {
    /// Adds a client and returns its id for later messages.
    pub fn join(&mut self) -> ClientId {
        self.joined += 1;
        let (id, number) = (ClientId(self.joined), self.joined);
        let client = Client {
            name: format!("client {number}"),
            counting: Counting::default(),
            names_uris: false,
            sent: 0,
            admitted: false,
            attached: false,
            state: false,
            sensed: false,
            trace: false,
            ours: false,
            lease: None,
            over: false,
            paths: BTreeMap::new(),
        };
        self.clients.insert(id, client);
        id
    }

    /// Removes a client with its breakpoints and its role. The run ends with the last attached
    /// client.
    pub fn leave(&mut self, id: ClientId) -> Vec<Outgoing> {
        self.detach(id);
        self.clients.remove(&id);
        self.rewire();
        self.take()
    }

    /// Stops sending the run's events to a client.
    pub(super) fn detach(&mut self, id: ClientId) {
        let Some(client) = self.clients.get_mut(&id) else { return };
        client.attached = false;
        let live = self.run.as_ref().is_some_and(|run| run.target.is_live());
        if self.attached().next().is_none() && !live {
            if let Some(mut run) = self.run.take() {
                run.target.stop(&mut |_, _| {});
            }
            self.breakpoints.forget(id);
            self.operator = None;
            return;
        }
        if self.operator == Some(id) {
            return self.lose_operator("is gone");
        }
        self.forget_breakpoints(id);
        self.send_roles();
    }

    /// Whether a client has disconnected.
    pub fn is_over(&self, id: ClientId) -> bool {
        self.clients.get(&id).is_none_or(|client| client.over)
    }

    /// Whether a client is admitted: it has launched or joined a run, with the token if one is set.
    pub fn is_admitted(&self, id: ClientId) -> bool {
        self.clients.get(&id).is_some_and(|client| client.admitted)
    }

    pub(super) fn admitted(&self) -> impl Iterator<Item = ClientId> + '_ {
        self.clients.iter().filter(|(_, client)| client.admitted).map(|(id, _)| *id)
    }

    /// The clients that receive the run's events.
    pub(super) fn attached(&self) -> impl Iterator<Item = ClientId> + '_ {
        self.clients.iter().filter(|(_, client)| client.attached).map(|(id, _)| *id)
    }

    /// The numbering of the asking client.
    pub(super) fn counting(&self) -> Counting {
        self.counting_of(self.asker)
    }

    pub(super) fn counting_of(&self, id: ClientId) -> Counting {
        self.clients.get(&id).map(|client| client.counting).unwrap_or_default()
    }

    pub(super) fn name_of(&self, id: ClientId) -> &str {
        self.clients.get(&id).map_or("a client that is gone", |client| &*client.name)
    }

    /// Takes all messages, with sequence numbers for each client.
    pub(super) fn take(&mut self) -> Vec<Outgoing> {
        let mut all = Vec::with_capacity(self.out.len());
        for (to, mut message) in std::mem::take(&mut self.out) {
            let Some(client) = self.clients.get_mut(&to) else { continue };
            client.sent += 1;
            message["seq"] = json!(client.sent);
            if !client.paths.is_empty() {
                to_client(&mut message, &client.paths);
            }
            if client.names_uris {
                rename_sources(&mut message, uri_of);
            }
            all.push(Outgoing { to, message: message.to_string() });
        }
        all
    }

    /// Sends a protocol event to all clients.
    pub(super) fn event<E: IEvent>(&mut self, body: &E::Body) {
        let body = serde_json::to_value(body).unwrap_or_default();
        self.broadcast(E::EVENT, &body);
    }

    /// Sends a protocol event to a client.
    pub(super) fn event_to<E: IEvent>(&mut self, to: ClientId, body: &E::Body) {
        let body = serde_json::to_value(body).unwrap_or_default();
        self.send_event(to, E::EVENT, body);
    }

    pub(super) fn broadcast(&mut self, event: &str, body: &Value) {
        self.send_event_where(|client| client.attached, event, body);
    }

    pub(super) fn send_event_where(
        &mut self,
        wanted: impl Fn(&Client) -> bool,
        event: &str,
        body: &Value,
    ) {
        let some = self.clients.iter().filter(|(_, client)| wanted(client));
        for to in some.map(|(id, _)| *id).collect::<Vec<_>>() {
            self.send_event(to, event, body.clone());
        }
    }

    pub(super) fn send_event(&mut self, to: ClientId, event: &str, body: Value) {
        let mut message = json!({"type": "event", "event": event});
        if !body.is_null() {
            message["body"] = body;
        }
        self.out.push((to, message));
    }
}
