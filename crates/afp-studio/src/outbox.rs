//! What is under way to a client. Messages come in bursts, so their number says nothing: the connection ends where the
//! client reads nothing for a while, leaves more unread than there should be memory for, or does not answer when it is asked
//! whether it is there.

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Duration;

use axum::extract::ws::{Message, WebSocket};
use tokio::sync::mpsc::{UnboundedReceiver, UnboundedSender, unbounded_channel};
use tokio::time::{Instant, Interval, MissedTickBehavior, interval_at, timeout};

/// How long a client may read nothing.
const PATIENCE: Duration = Duration::from_secs(5);

/// How often a client is asked whether it is there. Behind a tunnel nobody else tells when it is gone.
const PULSE: Duration = Duration::from_secs(20);

/// So many bytes may wait for a client.
const MOST: usize = 64 << 20;

/// The end at which messages are put in; nobody waits there.
#[derive(Debug)]
pub(crate) struct Outbox {
    to: UnboundedSender<String>,
    bytes: Arc<AtomicUsize>,
}

/// The end at which they are taken out.
#[derive(Debug)]
pub(crate) struct Outgoing {
    from: UnboundedReceiver<String>,
    bytes: Arc<AtomicUsize>,
}

/// The two ends for one client.
pub(crate) fn outbox() -> (Outbox, Outgoing) {
    let (to, from) = unbounded_channel();
    let bytes = Arc::new(AtomicUsize::new(0));
    (Outbox { to, bytes: Arc::clone(&bytes) }, Outgoing { from, bytes })
}

impl Outbox {
    /// Puts a message in; whether the client is there, and has read enough.
    pub fn put(&self, message: String) -> bool {
        let waiting = self.bytes.fetch_add(message.len(), Ordering::Relaxed) + message.len();
        waiting <= MOST && self.to.send(message).is_ok()
    }
}

impl Outgoing {
    /// The next message; none once nobody puts any in.
    pub async fn next(&mut self) -> Option<String> {
        let message = self.from.recv().await?;
        self.bytes.fetch_sub(message.len(), Ordering::Relaxed);
        Some(message)
    }
}

/// Sends a message; whether the client reads it.
pub(crate) async fn is_sent(socket: &mut WebSocket, message: String) -> bool {
    is_taken(socket, Message::Text(message.into())).await
}

async fn is_taken(socket: &mut WebSocket, message: Message) -> bool {
    matches!(timeout(PATIENCE, socket.send(message)).await, Ok(Ok(())))
}

/// Asks a client now and then whether it is still there. Browsers answer by themselves.
#[derive(Debug)]
pub(crate) struct Pulse {
    every: Interval,
    /// Whether nothing was heard since it was asked last.
    is_silent: bool,
}

impl Pulse {
    pub fn new() -> Pulse {
        let mut every = interval_at(Instant::now() + PULSE, PULSE);
        every.set_missed_tick_behavior(MissedTickBehavior::Delay);
        Pulse { every, is_silent: false }
    }

    /// Waits until it is time to ask.
    pub async fn due(&mut self) {
        self.every.tick().await;
    }

    /// Whether the client has answered since last time and can be asked again.
    pub async fn is_felt(&mut self, socket: &mut WebSocket) -> bool {
        self.may_ask() && is_taken(socket, Message::Ping(Vec::new().into())).await
    }

    /// Who was silent since it was asked last is not asked again.
    fn may_ask(&mut self) -> bool {
        !std::mem::replace(&mut self.is_silent, true)
    }

    /// The client has said something.
    pub fn heard(&mut self) {
        self.is_silent = false;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_burst_of_messages_waits_and_too_much_of_them_does_not() {
        let (to, mut from) = outbox();
        assert!((0..100_000).all(|number| to.put(number.to_string())));
        let runtime = tokio::runtime::Builder::new_current_thread().build().unwrap();
        runtime.block_on(async {
            for number in 0..100_000 {
                assert_eq!(from.next().await, Some(number.to_string()));
            }
        });
        // What was read makes room.
        let large = "x".repeat(MOST / 4);
        assert!((0..4).all(|_| to.put(large.clone())));
        assert!(!to.put("x".to_owned()));
    }

    #[test]
    fn who_does_not_answer_is_asked_once() {
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
    fn a_client_that_is_gone_takes_nothing() {
        let (to, from) = outbox();
        drop(from);
        assert!(!to.put(String::new()));
    }
}
