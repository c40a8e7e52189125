//! The queue of messages to a client. Messages come in bursts, so their number is not limited. The
//! connection ends if the client reads nothing for a while, leaves too many bytes unread, or does
//! not answer a ping.

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Duration;

use axum::extract::ws::{Message, WebSocket};
use tokio::sync::mpsc::{UnboundedReceiver, UnboundedSender, unbounded_channel};
use tokio::time::{Instant, Interval, MissedTickBehavior, interval_at, timeout};

/// The longest time in which a client may read nothing.
const PATIENCE: Duration = Duration::from_secs(5);

/// The interval of pings. Behind a tunnel there is no other sign of a lost client.
const PULSE: Duration = Duration::from_secs(20);

/// The most bytes waiting for a client.
const MOST: usize = 64 << 20;

/// The sending end, which never blocks.
#[derive(Debug)]
pub(crate) struct Outbox {
    to: UnboundedSender<String>,
    bytes: Arc<AtomicUsize>,
}

/// The receiving end.
#[derive(Debug)]
pub(crate) struct Outgoing {
    from: UnboundedReceiver<String>,
    bytes: Arc<AtomicUsize>,
}

/// Makes the two ends for a client.
pub(crate) fn outbox() -> (Outbox, Outgoing) {
    let (to, from) = unbounded_channel();
    let bytes = Arc::new(AtomicUsize::new(0));
    (Outbox { to, bytes: Arc::clone(&bytes) }, Outgoing { from, bytes })
}

impl Outbox {
    /// Queues a message; returns false if the client is gone or reads too slowly.
    pub fn put(&self, message: String) -> bool {
        let waiting = self.bytes.fetch_add(message.len(), Ordering::Relaxed) + message.len();
        waiting <= MOST && self.to.send(message).is_ok()
    }
}

impl Outgoing {
    /// Returns the next message; `None` after the sender is dropped.
    pub async fn next(&mut self) -> Option<String> {
        let message = self.from.recv().await?;
        self.bytes.fetch_sub(message.len(), Ordering::Relaxed);
        Some(message)
    }
}

/// Sends a message; returns whether the client reads it.
pub(crate) async fn is_sent(socket: &mut WebSocket, message: String) -> bool {
    is_taken(socket, Message::Text(message.into())).await
}

async fn is_taken(socket: &mut WebSocket, message: Message) -> bool {
    matches!(timeout(PATIENCE, socket.send(message)).await, Ok(Ok(())))
}

/// Pings a client. Browsers answer automatically.
#[derive(Debug)]
pub(crate) struct Pulse {
    every: Interval,
    /// Whether nothing has arrived since the last ping.
    is_silent: bool,
}

impl Pulse {
    pub fn new() -> Pulse {
        let mut every = interval_at(Instant::now() + PULSE, PULSE);
        every.set_missed_tick_behavior(MissedTickBehavior::Delay);
        Pulse { every, is_silent: false }
    }

    /// Waits for the next ping.
    pub async fn due(&mut self) {
        self.every.tick().await;
    }

    /// Pings the client; returns false if the last ping has no answer.
    pub async fn is_felt(&mut self, socket: &mut WebSocket) -> bool {
        self.may_ask() && is_taken(socket, Message::Ping(Vec::new().into())).await
    }

    /// A client without an answer is not pinged again.
    fn may_ask(&mut self) -> bool {
        !std::mem::replace(&mut self.is_silent, true)
    }

    /// Notes that the client has sent something.
    pub fn heard(&mut self) {
        self.is_silent = false;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_burst_of_messages_is_queued_up_to_a_limit() {
        let (to, mut from) = outbox();
        assert!((0..100_000).all(|number| to.put(number.to_string())));
        let runtime = tokio::runtime::Builder::new_current_thread().build().unwrap();
        runtime.block_on(async {
            for number in 0..100_000 {
                assert_eq!(from.next().await, Some(number.to_string()));
            }
        });
        // Reading frees space.
        let large = "x".repeat(MOST / 4);
        assert!((0..4).all(|_| to.put(large.clone())));
        assert!(!to.put("x".to_owned()));
    }

    #[test]
    fn a_silent_client_is_pinged_once() {
        let runtime = tokio::runtime::Builder::new_current_thread().enable_time().build().unwrap();
        let mut pulse = runtime.block_on(async { Pulse::new() });
        for _ in 0..3 {
            assert!(pulse.may_ask());
            pulse.heard();
        }
        assert!(pulse.may_ask());
        assert!(!pulse.may_ask());
    }

    #[test]
    fn a_lost_client_receives_no_messages() {
        let (to, from) = outbox();
        drop(from);
        assert!(!to.put(String::new()));
    }
}
