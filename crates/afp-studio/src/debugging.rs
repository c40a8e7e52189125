//! Clients that run and debug plans: their messages go through, a frame each.

use std::sync::mpsc::{Sender, channel};

use axum::extract::ws::{Message, WebSocket};
use tokio::sync::mpsc;

use crate::Debugging;

/// Messages that a client may leave unread before its connection ends.
const UNREAD: usize = 1024;

/// Carries messages between a client and whoever debugs for it, until one of them is gone.
pub(crate) async fn talk(mut socket: WebSocket, debuggers: Sender<Debugging>) {
    let (say, said) = channel();
    let (told, mut tells) = mpsc::channel::<String>(UNREAD);
    if debuggers.send(Debugging { said, told }).is_err() {
        return;
    }
    loop {
        tokio::select! {
            tell = tells.recv() => {
                let Some(tell) = tell else { break };
                if socket.send(Message::Text(tell.into())).await.is_err() {
                    break;
                }
            }
            heard = socket.recv() => {
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
