//! Clients over sockets, and the thread of the room.

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicU32, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, TryRecvError, channel};
use std::time::{Duration, Instant};

use afp_lsp::Message;
use axum::extract::ws::{self, WebSocket};

use crate::event::Event;
use crate::jobs::Runner;
use crate::outbox::{Outbox, Pulse, is_sent, outbox};
use crate::room::{ClientId, Out, Room};

pub(crate) const MOST_CLIENTS: usize = 8;

/// The channel to the room.
#[derive(Clone)]
pub(crate) struct Sockets {
    events: Sender<Event>,
    next: Arc<AtomicU32>,
}

impl Sockets {
    pub fn new() -> (Sockets, Receiver<Event>) {
        let (events, arrived) = channel();
        (Sockets { events, next: Arc::new(AtomicU32::new(1)) }, arrived)
    }

    pub fn jobs(&self, program: PathBuf, folder: PathBuf) -> Runner {
        Runner::new(program, folder, self.events.clone())
    }

    /// Makes the room save everything and end.
    pub fn end(&self) {
        let _ = self.events.send(Event::End);
    }
}

/// Carries messages between a client and the room until one of them closes.
pub(crate) async fn talk(mut socket: WebSocket, sockets: Sockets) {
    let id = sockets.next.fetch_add(1, Ordering::Relaxed);
    let (out, mut answers) = outbox();
    if sockets.events.send(Event::Joined(id, out)).is_err() {
        return;
    }
    let mut pulse = Pulse::new();
    loop {
        tokio::select! {
            () = pulse.due() => {
                if !pulse.is_felt(&mut socket).await {
                    break;
                }
            }
            answer = answers.next() => {
                // The room has dropped the client: it reads too slowly, or there are too many.
                let Some(answer) = answer else { break };
                if !is_sent(&mut socket, answer).await {
                    break;
                }
            }
            said = socket.recv() => {
                pulse.heard();
                let Some(Ok(said)) = said else { break };
                let text = match &said {
                    ws::Message::Text(text) => text.as_str(),
                    ws::Message::Close(_) | ws::Message::Binary(_) => break,
                    ws::Message::Ping(_) | ws::Message::Pong(_) => continue,
                };
                // Only foreign clients send invalid messages.
                let Ok(message) = serde_json::from_str(text) else { break };
                if sockets.events.send(Event::Said(id, message)).is_err() {
                    break;
                }
            }
        }
    }
    let _ = sockets.events.send(Event::Left(id));
}

/// The thread of the room: handles messages in order, and due work in between.
pub(crate) fn run(mut room: Room, arrived: Receiver<Event>, mut jobs: Runner) {
    let begin = Instant::now();
    room.draw_ahead();
    let mut clients = BTreeMap::new();
    loop {
        let event = match arrived.try_recv() {
            Ok(event) => Some(event),
            Err(TryRecvError::Empty) => {
                let said = room.idle();
                send(&mut clients, said);
                let wait = room.due().saturating_sub(begin.elapsed());
                match arrived.recv_timeout(wait.max(Duration::from_millis(1))) {
                    Ok(event) => Some(event),
                    Err(RecvTimeoutError::Timeout) => None,
                    Err(RecvTimeoutError::Disconnected) => break,
                }
            }
            Err(TryRecvError::Disconnected) => break,
        };
        let out = match event {
            Some(Event::Joined(_, _)) if clients.len() >= MOST_CLIENTS => Vec::new(),
            Some(Event::Joined(id, to)) => {
                clients.insert(id, to);
                room.join(id);
                Vec::new()
            }
            Some(Event::Said(id, message)) => room.handle(id, message, begin.elapsed()),
            Some(Event::Left(id)) => {
                clients.remove(&id);
                room.leave(id, begin.elapsed());
                Vec::new()
            }
            Some(Event::JobSaid(id, line)) => {
                room.job_said(id, &line);
                Vec::new()
            }
            Some(Event::JobEnded(id)) => room.job_done(id, jobs.ended(id)),
            Some(Event::End) => break,
            None => Vec::new(),
        };
        send(&mut clients, out);
        let orders = room.orders();
        if !orders.is_empty() {
            // Jobs read the files on disk.
            let out = room.save_all(begin.elapsed());
            send(&mut clients, out);
        }
        orders.into_iter().for_each(|order| jobs.take(order));
        let out = room.tick(begin.elapsed());
        send(&mut clients, out);
    }
    let out = room.save_all(begin.elapsed());
    send(&mut clients, out);
}

/// A client that reads too slowly is disconnected.
fn send(clients: &mut BTreeMap<ClientId, Outbox>, out: Out) {
    for (id, message) in out {
        let Some(to) = clients.get(&id) else { continue };
        if !to.put(written(&message)) {
            clients.remove(&id);
        }
    }
}

fn written(message: &Message) -> String {
    let mut value = serde_json::to_value(message).unwrap_or_default();
    value["jsonrpc"] = "2.0".into();
    value.to_string()
}
