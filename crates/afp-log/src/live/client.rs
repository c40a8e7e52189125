//! One client: its requests and its messages.

use std::io::ErrorKind;
use std::iter::repeat;
use std::net::TcpStream;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant as Wall};

use afp_core::Duration as Span;
use afp_session::{HOLD, NameWithUnit, Stimulus};
use serde_json::Value;
use tungstenite::{Error, Message, WebSocket};

use super::admission::{Role, Tokens};
use super::handshake::{Admitted, handshake};
use super::hub::{Hub, Question, Service, Written};
use super::paced::Paced;
use super::protocol::{self, Call, ClientMessage, Parameter};
use super::queue::Queue;

/// The time to wait for a request before messages are sent.
const LISTEN: Duration = Duration::from_millis(10);
/// The maximum time in which a client reads nothing.
const STALLED: Duration = Duration::from_secs(3);
/// The time for the remaining messages after the end of the run.
const GOODBYE: Duration = Duration::from_secs(1);

/// Talks with a client until one side ends; `admitted` is set after the handshake.
pub(crate) fn serve(stream: TcpStream, hub: &Arc<Hub>, tokens: &Tokens, admitted: &AtomicBool) {
    let Some(Admitted { socket, role, place: _place }) = handshake(stream, hub, tokens) else {
        return;
    };
    admitted.store(true, Ordering::Release);
    if socket.get_ref().stream().set_read_timeout(Some(LISTEN)).is_err() {
        return;
    }
    let queue = Arc::new(Queue::default());
    hub.join(&queue);
    let _ = Client { socket, hub, queue: &queue, role, stalled: None }.talk();
    hub.leave(&queue);
}

struct Client<'a> {
    socket: WebSocket<Paced>,
    hub: &'a Arc<Hub>,
    queue: &'a Arc<Queue>,
    role: Role,
    stalled: Option<Wall>,
}

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
                    self.socket.get_mut().begin_turn();
                    return self.socket.close(None).and_then(|()| self.socket.flush());
                }
            }
        }
    }

    /// Sends queued messages for one turn; returns whether more are queued.
    fn write(&mut self) -> Result<bool, Error> {
        self.socket.get_mut().begin_turn();
        loop {
            match self.socket.flush() {
                Ok(()) => self.stalled = None,
                Err(why) if is_late(&why) => {
                    self.note_stall();
                    return Ok(true);
                }
                Err(why) => return Err(why),
            }
            let Some(message) = self.queue.next() else { return Ok(false) };
            match self.socket.write(message) {
                // The unwritten rest is kept for the next turn.
                Err(why) if !is_late(&why) => return Err(why),
                _ => {}
            }
        }
    }

    /// Records since when the client has read nothing.
    fn note_stall(&mut self) {
        match self.socket.get_ref().has_written() {
            true => self.stalled = None,
            false => _ = self.stalled.get_or_insert_with(Wall::now),
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
                self.hub.watch(queue, &parameter_names)
            }
            ClientMessage::UnsubscribeParameterUpdates { parameter_names } => {
                queue.unwatch(&parameter_names)
            }
            ClientMessage::Unknown => {}
        }
    }

    /// Writes entries. The client gets the errors and, on request, the new values.
    fn set(&mut self, parameters: Vec<Parameter>, id: Option<String>) {
        let (queue, hub) = (Arc::clone(self.queue), Arc::clone(self.hub));
        let entries: Vec<_> = parameters.into_iter().map(Parameter::into_text).collect();
        let names: Vec<_> = entries.iter().map(|(name, _)| name.clone()).collect();
        let answer = move |written: Vec<Written>| {
            let refused = written.iter().filter_map(|done| done.as_ref().err());
            refused.for_each(|why| queue.answer(protocol::status(2, why)));
            if let Some(id) = id {
                let written = written.into_iter().map(Result::ok).chain(repeat(None));
                queue.answer(hub.values_after(names.into_iter().zip(written).collect(), &id));
            }
        };
        if self.role == Role::Watcher {
            let why = "this address is for watching: open the other address to write".to_owned();
            return answer(vec![Err(why)]);
        }
        let answer = Box::new(answer);
        self.hub.ask(Question::Write { entries, answer });
    }

    fn call(&mut self, call: &Call<'_>) {
        let (queue, service, number) = (Arc::clone(self.queue), call.service, call.call);
        let answer = Box::new(move |done: Result<(), String>| match done {
            Ok(()) => queue.answer(protocol::called(service, number)),
            Err(why) => queue.answer(protocol::call_failed(service, number, &why)),
        });
        match self.asked(call) {
            Ok(what) => self.hub.ask(Question::Do { what, answer }),
            Err(why) => answer(Err(why)),
        }
    }

    fn asked(&self, call: &Call<'_>) -> Result<Stimulus, String> {
        let service = self.hub.service(call.service).ok_or("there is no such service")?;
        // Every client may stop a robot.
        if self.role == Role::Watcher && *service != Service::Stop {
            return Err("this address is for watching: open the other address to press".to_owned());
        }
        if call.encoding != "json" {
            return Err(format!("'{}' is not JSON: write JSON", call.encoding));
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
            Service::Press(control) => match &said["held"] {
                Value::Null => Stimulus::Hold(control.clone(), HOLD),
                value => {
                    let held = value.as_bool().ok_or("'held' is true or false")?;
                    Stimulus::Press(control.clone(), held)
                }
            },
            Service::Fail(fault) => {
                let fault = NameWithUnit { name: fault.clone(), unit: String::new() };
                let amount = number("amount")?;
                let lasting = match number("seconds")? {
                    None => Span::MAX,
                    Some(seconds) if seconds > 0.0 && seconds < 1e9 => Span::from_secs_f64(seconds),
                    Some(_) => return Err("'seconds' is a number above 0".to_owned()),
                };
                Stimulus::Break(fault, amount, lasting)
            }
            Service::Stop => Stimulus::Stop,
        })
    }
}
