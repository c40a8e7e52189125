//! The clients of a run: how each counts lines, which events it subscribed to, joining and leaving.

use std::time::Duration as Wall;

use afp_dsl::files::uri_of;
use dapts::IEvent;
use serde_json::{Value, json};

use super::Adapter;

/// A client of an adapter.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ClientId(u32);

/// A message for a client.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Outgoing {
    pub to: ClientId,
    /// The message, without a header.
    pub message: String,
}

/// What is known of a client.
#[derive(Debug)]
pub(super) struct Client {
    /// What it calls itself.
    pub name: String,
    pub counting: Counting,
    /// Whether it names files by their addresses.
    pub names_uris: bool,
    /// The number of the last message to it.
    sent: i64,
    /// Whether it knows what clients have to know.
    pub admitted: bool,
    /// Whether it is told what happens in the run.
    pub attached: bool,
    /// Whether it wants to be told what is the case.
    pub state: bool,
    /// Whether it wants to be told what the robot's signals say.
    pub sensed: bool,
    /// Whether it wants to be told what happens, as records.
    pub trace: bool,
    /// Whether it knows our own requests, and so our own events.
    pub ours: bool,
    /// What keeps it in its role, where it answers for that.
    pub lease: Option<Lease>,
    /// Whether it has said goodbye.
    pub over: bool,
}

/// When a client was asked last whether it is there, and since when it has not said so.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lease {
    pub asked: Wall,
    /// How long an answer could have been heard to what was asked; none where all is answered.
    pub open: Option<Wall>,
}

/// How a client counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Counting {
    /// The number of the first line.
    pub first_line: u32,
    /// The number of the first column.
    pub first_column: u32,
}

impl ClientId {
    /// The number that clients know each other by.
    pub(super) fn number(self) -> u32 {
        self.0
    }
}

impl Default for Counting {
    fn default() -> Self {
        Counting { first_line: 1, first_column: 1 }
    }
}

/// Names the files of all sources in a message in another way.
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

impl Adapter<'_> {
    /// A client comes; what it says is handed over with its number.
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
        };
        self.clients.insert(id, client);
        id
    }

    /// A client is gone: its breakpoints go with it, and its role. With the last one that it is told to, the run ends.
    pub fn leave(&mut self, id: ClientId) -> Vec<Outgoing> {
        self.detach(id);
        self.clients.remove(&id);
        self.take()
    }

    /// A client is not told of the run any more.
    pub(super) fn detach(&mut self, id: ClientId) {
        let Some(client) = self.clients.get_mut(&id) else { return };
        client.attached = false;
        if self.attached().next().is_none() {
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

    /// Whether a client has said goodbye.
    pub fn is_over(&self, id: ClientId) -> bool {
        self.clients.get(&id).is_none_or(|client| client.over)
    }

    /// Whether a client has been let in: it has launched a run or joined one, with the token where there is one.
    pub fn is_admitted(&self, id: ClientId) -> bool {
        self.clients.get(&id).is_some_and(|client| client.admitted)
    }

    /// Those who have been let in.
    pub(super) fn admitted(&self) -> impl Iterator<Item = ClientId> + '_ {
        self.clients.iter().filter(|(_, client)| client.admitted).map(|(id, _)| *id)
    }

    /// Those who are told what happens in the run.
    pub(super) fn attached(&self) -> impl Iterator<Item = ClientId> + '_ {
        self.clients.iter().filter(|(_, client)| client.attached).map(|(id, _)| *id)
    }

    /// How the client that asks counts.
    pub(super) fn counting(&self) -> Counting {
        self.counting_of(self.asker)
    }

    pub(super) fn counting_of(&self, id: ClientId) -> Counting {
        self.clients.get(&id).map(|client| client.counting).unwrap_or_default()
    }

    pub(super) fn name_of(&self, id: ClientId) -> &str {
        self.clients.get(&id).map_or("a client that is gone", |client| &*client.name)
    }

    /// Takes all messages, numbered for each client.
    pub(super) fn take(&mut self) -> Vec<Outgoing> {
        let mut all = Vec::with_capacity(self.out.len());
        for (to, mut message) in std::mem::take(&mut self.out) {
            let Some(client) = self.clients.get_mut(&to) else { continue };
            client.sent += 1;
            message["seq"] = json!(client.sent);
            if client.names_uris {
                rename_sources(&mut message, uri_of);
            }
            all.push(Outgoing { to, message: message.to_string() });
        }
        all
    }

    /// Sends an event of the protocol to all.
    pub(super) fn event<E: IEvent>(&mut self, body: &E::Body) {
        let body = serde_json::to_value(body).unwrap_or_default();
        self.broadcast(E::EVENT, &body);
    }

    /// Sends an event of the protocol to a client.
    pub(super) fn event_to<E: IEvent>(&mut self, to: ClientId, body: &E::Body) {
        let body = serde_json::to_value(body).unwrap_or_default();
        self.send_event(to, E::EVENT, body);
    }

    /// Sends an event to all.
    pub(super) fn broadcast(&mut self, event: &str, body: &Value) {
        self.send_event_where(|client| client.attached, event, body);
    }

    /// Sends an event to some.
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

    /// Sends an event to a client.
    pub(super) fn send_event(&mut self, to: ClientId, event: &str, body: Value) {
        let mut message = json!({"type": "event", "event": event});
        if !body.is_null() {
            message["body"] = body;
        }
        self.out.push((to, message));
    }
}
