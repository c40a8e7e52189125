//! One client: what it says, and what it is sent.

use std::io::ErrorKind;
use std::net::TcpStream;
use std::sync::Arc;
use std::time::{Duration, Instant as Wall};

use serde_json::Value;
use tungstenite::handshake::server::{ErrorResponse, Request, Response};
use tungstenite::http::HeaderValue;
use tungstenite::protocol::WebSocketConfig;
use tungstenite::{Error, Message, WebSocket, accept_hdr_with_config};

use crate::admission::{Refusal, Role, Tokens};
use crate::hub::{Asked, Hub, Question, Service};
use crate::protocol::{self, Call, ClientMessage, NAMES, Parameter};
use crate::queue::Queue;

/// The longest message of a client, in bytes.
const LONGEST: usize = 1 << 20;
/// How long a handshake may rest.
const HANDSHAKE: Duration = Duration::from_secs(5);
/// How long what a client says is waited for, before what it is sent is looked after.
const LISTEN: Duration = Duration::from_millis(10);
/// How long a write may rest before what the client says is looked after.
const WRITE: Duration = Duration::from_millis(100);
/// How long a client may read nothing at all.
const STALLED: Duration = Duration::from_secs(3);
/// How long a client may take for the rest when the run is over.
const GOODBYE: Duration = Duration::from_secs(1);

/// Talks with a client until one of the two has had enough.
pub(crate) fn serve(stream: TcpStream, hub: &Hub, tokens: &Tokens) {
    let Some((socket, role)) = handshake(stream, tokens) else { return };
    let queue = Arc::new(Queue::default());
    hub.join(&queue);
    let _ = Client { socket, hub, queue: &queue, role, stalled: None }.talk();
    hub.leave(&queue);
}

#[allow(clippy::result_large_err)] // The type is that of the library.
fn handshake(stream: TcpStream, tokens: &Tokens) -> Option<(WebSocket<TcpStream>, Role)> {
    // What was accepted by a listener that does not wait may not wait either.
    stream.set_nonblocking(false).ok()?;
    stream.set_nodelay(true).ok()?;
    stream.set_read_timeout(Some(HANDSHAKE)).ok()?;
    stream.set_write_timeout(Some(WRITE)).ok()?;
    let at = stream.local_addr().ok()?;
    let mut role = None;
    let admit = |request: &Request, mut response: Response| {
        let admitted = tokens.admit(request, at).and_then(|role| Ok((role, name(request)?)));
        match admitted {
            Ok((admitted, name)) => {
                role = Some(admitted);
                let header = HeaderValue::from_static(name);
                response.headers_mut().insert("sec-websocket-protocol", header);
                Ok(response)
            }
            Err((code, why)) => Err(refused(code, why)),
        }
    };
    let limits =
        WebSocketConfig::default().max_message_size(Some(LONGEST)).max_frame_size(Some(LONGEST));
    let socket = accept_hdr_with_config(stream, admit, Some(limits)).ok()?;
    socket.get_ref().set_read_timeout(Some(LISTEN)).ok()?;
    Some((socket, role?))
}

/// The name of the protocol that both speak.
fn name(request: &Request) -> Result<&'static str, Refusal> {
    let offered = request.headers().get_all("sec-websocket-protocol");
    let offered = offered.iter().filter_map(|value| value.to_str().ok());
    let offered: Vec<_> = offered.flat_map(|all| all.split(',')).map(str::trim).collect();
    let known = NAMES.into_iter().find(|name| offered.contains(name));
    known.ok_or((400, "this server speaks 'foxglove.sdk.v1', which was not asked for\n"))
}

fn refused(code: u16, why: &str) -> ErrorResponse {
    let mut response = ErrorResponse::new(Some(why.to_owned()));
    *response.status_mut() = code.try_into().unwrap_or_default();
    response
}

struct Client<'a> {
    socket: WebSocket<TcpStream>,
    hub: &'a Hub,
    queue: &'a Arc<Queue>,
    role: Role,
    /// Since when nothing can be written.
    stalled: Option<Wall>,
}

/// Whether nothing was there in time.
fn is_late(error: &Error) -> bool {
    matches!(error, Error::Io(io) if matches!(io.kind(), ErrorKind::WouldBlock | ErrorKind::TimedOut))
}

impl Client<'_> {
    fn talk(&mut self) -> Result<(), Error> {
        let mut over: Option<Wall> = None;
        loop {
            match self.socket.read() {
                Ok(message) => self.on_message(&message),
                Err(why) if is_late(&why) => {}
                Err(why) => return Err(why),
            }
            let more = self.write()?;
            if self.queue.is_overflown() || self.stalled.is_some_and(|it| it.elapsed() > STALLED) {
                return Ok(());
            }
            if self.hub.is_over() {
                let since = *over.get_or_insert_with(Wall::now);
                if !more || since.elapsed() > GOODBYE {
                    return self.socket.close(None).and_then(|()| self.socket.flush());
                }
            }
        }
    }

    /// Sends what waits, as far as the client reads; whether more of it waits.
    fn write(&mut self) -> Result<bool, Error> {
        loop {
            match self.socket.flush() {
                Ok(()) => self.stalled = None,
                Err(why) if is_late(&why) => {
                    self.stalled.get_or_insert_with(Wall::now);
                    return Ok(true);
                }
                Err(why) => return Err(why),
            }
            let Some(message) = self.queue.next() else { return Ok(false) };
            match self.socket.write(message) {
                // What could not be written yet is kept for the next turn.
                Err(why) if !is_late(&why) => return Err(why),
                _ => {}
            }
        }
    }

    fn on_message(&mut self, message: &Message) {
        match message {
            Message::Text(text) => match serde_json::from_str::<ClientMessage>(text) {
                Ok(said) => self.answer(said),
                Err(why) => {
                    self.queue.answer(protocol::status(2, &format!("not understood: {why}")));
                }
            },
            Message::Binary(bytes) => match Call::read(bytes) {
                Some(call) => self.call(&call),
                None => self.queue.answer(protocol::status(2, "not understood: no service call")),
            },
            _ => {}
        }
    }

    fn answer(&mut self, message: ClientMessage) {
        let queue = self.queue;
        match message {
            ClientMessage::Subscribe { subscriptions } => {
                for wanted in subscriptions {
                    let done = self.hub.subscribe(queue, wanted.channel_id, wanted.id);
                    done.unwrap_or_else(|why| queue.answer(protocol::status(2, &why)));
                }
            }
            ClientMessage::Unsubscribe { subscription_ids } => {
                subscription_ids.into_iter().for_each(|id| queue.unsubscribe(id));
            }
            ClientMessage::GetParameters { parameter_names, id } => {
                queue.answer(self.hub.values(&parameter_names, id.as_deref()));
            }
            ClientMessage::SetParameters { parameters, id } => self.set(parameters, id),
            ClientMessage::SubscribeParameterUpdates { parameter_names } => {
                queue.watch(parameter_names)
            }
            ClientMessage::UnsubscribeParameterUpdates { parameter_names } => {
                queue.unwatch(&parameter_names)
            }
            ClientMessage::Unknown => {}
        }
    }

    /// Writes entries; the client is told their values where it wants an answer, and what cannot be written.
    fn set(&mut self, parameters: Vec<Parameter>, id: Option<String>) {
        if self.role == Role::Watcher {
            let text = "this address is for watching: open the other one to write";
            self.queue.answer(protocol::status(2, text));
        } else {
            for Parameter { name, value } in &parameters {
                let text = match value {
                    Value::String(text) => text.clone(),
                    other => other.to_string(),
                };
                let queue = Arc::clone(self.queue);
                let what = Asked::Set { entry: name.clone(), text };
                let answer = Box::new(move |done: Result<(), String>| {
                    if let Err(why) = done {
                        queue.answer(protocol::status(2, &why));
                    }
                });
                self.hub.ask(Question { what, answer });
            }
        }
        if let Some(id) = id {
            let names: Vec<_> = parameters.into_iter().map(|it| it.name).collect();
            self.queue.answer(self.hub.values(&names, Some(&id)));
        }
    }

    fn call(&mut self, call: &Call<'_>) {
        let (queue, service, number) = (Arc::clone(self.queue), call.service, call.call);
        let answer = Box::new(move |done: Result<(), String>| match done {
            Ok(()) => queue.answer(protocol::called(service, number)),
            Err(why) => queue.answer(protocol::call_failed(service, number, &why)),
        });
        match self.asked(call) {
            Ok(what) => self.hub.ask(Question { what, answer }),
            Err(why) => answer(Err(why)),
        }
    }

    /// What a call asks of the run.
    fn asked(&self, call: &Call<'_>) -> Result<Asked, String> {
        let service = self.hub.service(call.service).ok_or("there is no such service")?;
        // Anybody may stop a robot.
        if self.role == Role::Watcher && *service != Service::Stop {
            return Err("this address is for watching: open the other one to press".to_owned());
        }
        if call.encoding != "json" {
            return Err(format!("'{}' is not read: write JSON", call.encoding));
        }
        let said: Value = match call.payload {
            [] => Value::Null,
            payload => serde_json::from_slice(payload).map_err(|why| why.to_string())?,
        };
        let number = |name: &str| match &said[name] {
            Value::Null => Ok(None),
            value => value.as_f64().map(Some).ok_or_else(|| format!("'{name}' is a number")),
        };
        Ok(match service {
            Service::Press(control) => Asked::Press {
                control: control.clone(),
                held: match &said["held"] {
                    Value::Null => None,
                    value => Some(value.as_bool().ok_or("'held' is true or false")?),
                },
            },
            Service::Fail(fault) => Asked::Fail {
                fault: fault.clone(),
                amount: number("amount")?,
                seconds: number("seconds")?,
            },
            Service::Stop => Asked::Stop,
        })
    }
}
