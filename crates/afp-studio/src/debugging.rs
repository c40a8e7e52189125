//! Clients that run and debug plans: their messages are forwarded, a frame each.

use std::sync::Arc;
use std::sync::mpsc::{Sender, channel};

use axum::extract::ws::{Message, WebSocket};
use serde_json::{Value, json};
use tokio::sync::{Semaphore, mpsc};

use crate::Debugging;
use crate::outbox::{Pulse, is_sent};
use crate::sockets::MOST_CLIENTS;

/// The most messages waiting for a client; then senders wait.
const WAITING: usize = 1024;

/// The most clients: a page has one for its run, and one for the world of the next run.
const MOST: usize = 2 * MOST_CLIENTS;

/// The service for debugging clients.
#[derive(Clone)]
pub(crate) struct Debuggers {
    to: Sender<Debugging>,
    /// A permit for each possible client.
    places: Arc<Semaphore>,
}

impl Debuggers {
    /// Passes clients to a receiver.
    pub fn new(to: Sender<Debugging>) -> Debuggers {
        Debuggers { to, places: Arc::new(Semaphore::new(MOST)) }
    }
}

/// Carries messages between a client and its debugger until one of them closes.
pub(crate) async fn talk(mut socket: WebSocket, debuggers: Debuggers) {
    let Ok(_place) = debuggers.places.try_acquire() else {
        return turn_away(socket).await;
    };
    let (say, said) = channel();
    let (told, mut tells) = mpsc::channel::<String>(WAITING);
    if debuggers.to.send(Debugging { said, told }).is_err() {
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
            tell = tells.recv() => {
                let Some(tell) = tell else { break };
                if !is_sent(&mut socket, tell).await {
                    break;
                }
            }
            heard = socket.recv() => {
                pulse.heard();
                let text = match heard {
                    Some(Ok(Message::Text(text))) => text.to_string(),
                    Some(Ok(Message::Ping(_) | Message::Pong(_))) => continue,
                    _ => break,
                };
                if say.send(text).is_err() {
                    break;
                }
            }
        }
    }
}

/// Rejects a surplus client, as the response to its first request.
async fn turn_away(mut socket: WebSocket) {
    let Some(Ok(Message::Text(text))) = socket.recv().await else { return };
    let asked: Value = serde_json::from_str(&text).unwrap_or_default();
    let why =
        format!("{MOST_CLIENTS} pages run plans in this folder: end a run, or close its page");
    let answer = json!({
        "seq": 0, "type": "response", "request_seq": asked["seq"], "command": asked["command"],
        "success": false, "message": why,
        "body": { "error": { "id": 1, "format": why, "showUser": true } },
    });
    is_sent(&mut socket, answer.to_string()).await;
}
