//! A client's message queue: bounded, so that the run never waits for the client.

use std::collections::btree_map::{BTreeMap, Entry};
use std::collections::{BTreeSet, VecDeque};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use tungstenite::Message;

use super::protocol;

/// The maximum number of queued messages of channels, and of their bytes. Beyond it, the oldest are
/// dropped, but never the last one of a channel: an outdated state must not stay.
const MESSAGES: usize = 1024;
const BYTES: usize = 8 << 20;
/// The maximum number of queued answers, and of their bytes in addition to the first one. A client
/// with more unread answers loses its connection.
const ANSWERS: usize = 1024;
const ANSWER_BYTES: usize = 4 << 20;

/// A message of a channel, shared by all queues.
#[derive(Clone, Debug)]
pub(crate) struct Sent {
    pub at: u64,
    pub payload: Arc<[u8]>,
}

/// The queue of one client, and its subscriptions.
#[derive(Debug, Default)]
pub(crate) struct Queue(Mutex<Waiting>);

#[derive(Debug, Default)]
struct Waiting {
    answers: VecDeque<Message>,
    answer_bytes: usize,
    messages: VecDeque<(u32, Sent)>,
    /// Number of queued messages by the client's number of the channel.
    of_channel: BTreeMap<u32, usize>,
    bytes: usize,
    dropped: u64,
    overflown: bool,
    /// The client's number of each subscribed channel.
    wanted: BTreeMap<u32, u32>,
    parameters: BTreeSet<String>,
}

impl Queue {
    fn get(&self) -> MutexGuard<'_, Waiting> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Queues an answer, or another message that must not get lost.
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

    /// Queues a message of a channel if the client has subscribed to it.
    pub fn message(&self, channel: u32, sent: &Sent) {
        let mut waiting = self.get();
        let Some(subscription) = waiting.wanted.get(&channel).copied() else { return };
        waiting.push(subscription, sent.clone());
        while waiting.messages.len() > MESSAGES || waiting.bytes > BYTES {
            let Some(oldest) = waiting.oldest_with_later() else { return };
            waiting.take(oldest);
            waiting.dropped += 1;
        }
    }

    /// The next message; `None` if the queue is empty.
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
        let (subscription, Sent { at, payload }) = waiting.take(0)?;
        Some(protocol::message(subscription, at, &payload).into())
    }

    pub fn is_overflown(&self) -> bool {
        self.get().overflown
    }

    /// Subscribes to a channel, with the client's number.
    pub fn subscribe(&self, channel: u32, subscription: u32) {
        let mut waiting = self.get();
        if let Some(before) = waiting.wanted.insert(channel, subscription) {
            waiting.forget(before);
        }
    }

    pub fn unsubscribe(&self, subscription: u32) {
        let mut waiting = self.get();
        waiting.wanted.retain(|_, known| *known != subscription);
        waiting.forget(subscription);
    }

    /// Subscribes to changes of these parameters.
    pub fn watch(&self, names: impl Iterator<Item = String>) {
        self.get().parameters.extend(names);
    }

    /// Ends the subscription to these parameters; empty means all.
    pub fn unwatch(&self, names: &[String]) {
        let known = &mut self.get().parameters;
        match names {
            [] => known.clear(),
            names => names.iter().for_each(|name| _ = known.remove(name)),
        }
    }

    pub fn watches(&self, name: &str) -> bool {
        self.get().parameters.contains(name)
    }
}

impl Waiting {
    fn push(&mut self, subscription: u32, sent: Sent) {
        self.bytes += sent.payload.len();
        *self.of_channel.entry(subscription).or_default() += 1;
        self.messages.push_back((subscription, sent));
    }

    fn take(&mut self, index: usize) -> Option<(u32, Sent)> {
        let (subscription, sent) = self.messages.remove(index)?;
        self.bytes -= sent.payload.len();
        if let Entry::Occupied(mut count) = self.of_channel.entry(subscription) {
            *count.get_mut() -= 1;
            if *count.get() == 0 {
                count.remove();
            }
        }
        Some((subscription, sent))
    }

    /// Drops the queued messages of a subscription.
    fn forget(&mut self, subscription: u32) {
        self.messages.retain(|(of, _)| *of != subscription);
        self.bytes = self.messages.iter().map(|(_, sent)| sent.payload.len()).sum();
        self.of_channel.remove(&subscription);
    }

    /// The position of the oldest message with a later one of its channel. The search is limited to
    /// the number of channels.
    fn oldest_with_later(&self) -> Option<usize> {
        let has_later = |(of, _): &(u32, Sent)| self.of_channel.get(of).is_some_and(|it| *it > 1);
        self.messages.iter().position(has_later)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sent(number: u64, length: usize) -> Sent {
        Sent { at: number, payload: vec![0; length].into() }
    }

    #[test]
    fn a_slow_client_loses_the_oldest_messages_and_is_notified() {
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
    fn the_last_message_of_a_channel_is_never_dropped() {
        let queue = Queue::default();
        (1..=3).for_each(|channel| queue.subscribe(channel, channel * 10));
        queue.message(1, &sent(7, 1));
        queue.message(1, &sent(8, 1));
        queue.message(2, &sent(9, 1));
        (100..5000).for_each(|number| queue.message(3, &sent(number, BYTES / 16)));
        let all = std::iter::from_fn(|| queue.next()).skip(1).map(Message::into_data);
        let all: Vec<_> = all.map(|data| (data[1], data[5])).collect();
        assert_eq!(all[..2], [(10, 8), (20, 9)]);
        let others = 15..=16;
        assert!(others.contains(&(all.len() - 2)) && all[2..].iter().all(|(of, _)| *of == 30));
        // A client that comes and goes leaves no queued messages.
        (40..5000).for_each(|subscription| {
            queue.subscribe(1, subscription);
            queue.message(1, &sent(1, BYTES / 4));
            queue.unsubscribe(subscription);
        });
        assert!(queue.next().is_none());
    }

    #[test]
    fn a_client_with_unread_answers_is_found() {
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
