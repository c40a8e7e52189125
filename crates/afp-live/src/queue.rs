//! What waits for a client to read it: bounded, so that nobody waits for the client.

use std::collections::{BTreeMap, BTreeSet, VecDeque};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use tungstenite::Message;

use crate::protocol;

/// So many messages of channels, and so many bytes of them, wait at most; then the oldest are dropped.
const MESSAGES: usize = 1024;
const BYTES: usize = 8 << 20;
/// So many answers, and so many bytes of them beside the first one, wait at most; a client that leaves more unread has lost
/// its connection.
const ANSWERS: usize = 1024;
const ANSWER_BYTES: usize = 4 << 20;

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
    answer_bytes: usize,
    messages: VecDeque<(u32, Sent)>,
    bytes: usize,
    dropped: u64,
    /// Whether too many answers were left unread.
    overflown: bool,
    /// The client's number of each channel that it wants.
    wanted: BTreeMap<u32, u32>,
    /// The parameters that it wants to be told of.
    parameters: BTreeSet<String>,
}

impl Queue {
    fn get(&self) -> MutexGuard<'_, Waiting> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// An answer, or something else that must not get lost.
    pub fn answer(&self, message: impl Into<Message>) {
        let (mut waiting, message) = (self.get(), message.into());
        let bytes = waiting.answer_bytes + message.len();
        let is_long = bytes > ANSWER_BYTES && !waiting.answers.is_empty();
        waiting.overflown |= is_long || waiting.answers.len() >= ANSWERS;
        if !waiting.overflown {
            waiting.answer_bytes = bytes;
            waiting.answers.push_back(message);
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
            waiting.answer_bytes -= answer.len();
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

    /// The client wants to be told of these parameters when they change.
    pub fn watch(&self, names: impl Iterator<Item = String>) {
        self.get().parameters.extend(names);
    }

    /// The client does not want to be told of these any more, of none where it names none.
    pub fn unwatch(&self, names: &[String]) {
        let known = &mut self.get().parameters;
        match names {
            [] => known.clear(),
            names => names.iter().for_each(|name| _ = known.remove(name)),
        }
    }

    /// Whether the client wants to be told of a parameter.
    pub fn watches(&self, name: &str) -> bool {
        self.get().parameters.contains(name)
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
        for (length, kept) in [(1, ANSWERS), (ANSWER_BYTES / 4, 4), (ANSWER_BYTES * 2, 1)] {
            let queue = Queue::default();
            let answer = || queue.answer("x".repeat(length));
            (0..kept).for_each(|_| answer());
            assert!(!queue.is_overflown(), "{kept} of {length} bytes");
            assert!(queue.next().is_some());
            answer();
            assert!(!queue.is_overflown(), "one was read");
            answer();
            assert!(queue.is_overflown(), "{kept} of {length} bytes");
        }
    }
}
