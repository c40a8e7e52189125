//! What waits for a client to read it: bounded, so that nobody waits for the client.

use std::collections::{BTreeMap, BTreeSet, VecDeque};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use tungstenite::Message;

use crate::protocol;

/// So many messages of channels, and so many bytes of them, wait at most; then the oldest are dropped.
const MESSAGES: usize = 1024;
const BYTES: usize = 8 << 20;
/// So many answers wait at most; a client that leaves more unread has lost its connection.
const ANSWERS: usize = 1024;

/// A message of a channel, shared by all who wait for it.
#[derive(Clone, Debug)]
pub(crate) struct Sent {
    pub at: u64,
    pub payload: Arc<[u8]>,
}

/// The queue of one client, and what the client wants.
#[derive(Debug, Default)]
pub(crate) struct Queue(Mutex<Waiting>);

#[derive(Debug, Default)]
struct Waiting {
    answers: VecDeque<Message>,
    messages: VecDeque<(u32, Sent)>,
    bytes: usize,
    dropped: u64,
    /// Whether too many answers were left unread.
    overflown: bool,
    /// The client's number of each channel that it wants.
    wanted: BTreeMap<u32, u32>,
    /// The parameters that it wants to be told of; all where that is said by no name.
    parameters: Option<BTreeSet<String>>,
}

impl Queue {
    fn get(&self) -> MutexGuard<'_, Waiting> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// An answer, or something else that must not get lost.
    pub fn answer(&self, message: impl Into<Message>) {
        let mut waiting = self.get();
        waiting.overflown |= waiting.answers.len() >= ANSWERS;
        if !waiting.overflown {
            waiting.answers.push_back(message.into());
        }
    }

    /// A message of a channel, if the client wants it.
    pub fn message(&self, channel: u32, sent: &Sent) {
        let mut waiting = self.get();
        let Some(subscription) = waiting.wanted.get(&channel).copied() else { return };
        waiting.bytes += sent.payload.len();
        waiting.messages.push_back((subscription, sent.clone()));
        while waiting.messages.len() > MESSAGES || waiting.bytes > BYTES {
            let Some((_, oldest)) = waiting.messages.pop_front() else { return };
            waiting.bytes -= oldest.payload.len();
            waiting.dropped += 1;
        }
    }

    /// What is to be sent next; none while there is nothing.
    pub fn next(&self) -> Option<Message> {
        let mut waiting = self.get();
        if let Some(answer) = waiting.answers.pop_front() {
            return Some(answer);
        }
        if waiting.dropped > 0 {
            let count = std::mem::take(&mut waiting.dropped);
            let text = format!("{count} messages were dropped: this client reads too slowly");
            return Some(protocol::status(1, &text).into());
        }
        let (subscription, Sent { at, payload }) = waiting.messages.pop_front()?;
        waiting.bytes -= payload.len();
        Some(protocol::message(subscription, at, &payload).into())
    }

    /// Whether too many answers were left unread.
    pub fn is_overflown(&self) -> bool {
        self.get().overflown
    }

    /// The client wants a channel, by a number of its own.
    pub fn subscribe(&self, channel: u32, subscription: u32) {
        self.get().wanted.insert(channel, subscription);
    }

    /// The client does not want a channel any more.
    pub fn unsubscribe(&self, subscription: u32) {
        self.get().wanted.retain(|_, known| *known != subscription);
    }

    /// The client wants to be told of parameters when they change, of all where it names none.
    pub fn watch(&self, names: Vec<String>) {
        self.get().parameters.get_or_insert_default().extend(names);
    }

    /// The client does not want to be told of these any more, of none where it names none.
    pub fn unwatch(&self, names: &[String]) {
        let mut waiting = self.get();
        match &mut waiting.parameters {
            Some(known) if !names.is_empty() => known.retain(|name| !names.contains(name)),
            all => *all = None,
        }
    }

    /// Whether the client wants to be told of a parameter.
    pub fn watches(&self, name: &str) -> bool {
        let waiting = self.get();
        let watched = waiting.parameters.as_ref();
        watched.is_some_and(|names| names.is_empty() || names.contains(name))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sent(number: u64, length: usize) -> Sent {
        Sent { at: number, payload: vec![0; length].into() }
    }

    #[test]
    fn who_reads_too_slowly_loses_the_oldest_and_is_told() {
        for (length, kept) in [(1, MESSAGES), (BYTES / 4, 4)] {
            let queue = Queue::default();
            queue.message(3, &sent(0, length));
            queue.subscribe(3, 77);
            for number in 0..2000 {
                queue.message(3, &sent(number, length));
            }
            let first = queue.next().expect("something waits").to_string();
            assert!(first.contains(&format!("{} messages were dropped", 2000 - kept)), "{first}");
            let data = queue.next().expect("the oldest one").into_data();
            assert_eq!(data[..5], [1, 77, 0, 0, 0]);
            assert_eq!(data[5..13], (2000 - kept as u64).to_le_bytes());
            assert_eq!(std::iter::from_fn(|| queue.next()).count(), kept - 1);
            queue.unsubscribe(77);
            queue.message(3, &sent(1, 1));
            assert!(queue.next().is_none());
        }
    }

    #[test]
    fn who_leaves_answers_unread_is_known() {
        let queue = Queue::default();
        (0..=ANSWERS).for_each(|_| queue.answer("x"));
        assert!(queue.is_overflown());
    }
}
