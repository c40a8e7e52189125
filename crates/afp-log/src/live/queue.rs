//! What waits for a client to read it: bounded, so that nobody waits for the client.

use std::collections::btree_map::{BTreeMap, Entry};
use std::collections::{BTreeSet, VecDeque};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use tungstenite::Message;

use super::protocol;

/// So many messages of channels, and so many bytes of them, wait at most; then the oldest are dropped, but never the last one
/// of a channel: what holds until something else is said must not stay wrong.
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
    /// How many of them are of each channel, by the client's number.
    of_channel: BTreeMap<u32, usize>,
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
        waiting.push(subscription, sent.clone());
        while waiting.messages.len() > MESSAGES || waiting.bytes > BYTES {
            let Some(oldest) = waiting.oldest_with_later() else { return };
            waiting.take(oldest);
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
        let (subscription, Sent { at, payload }) = waiting.take(0)?;
        Some(protocol::message(subscription, at, &payload).into())
    }

    /// Whether too many answers were left unread.
    pub fn is_overflown(&self) -> bool {
        self.get().overflown
    }

    /// The client wants a channel, by a number of its own.
    pub fn subscribe(&self, channel: u32, subscription: u32) {
        let mut waiting = self.get();
        if let Some(before) = waiting.wanted.insert(channel, subscription) {
            waiting.forget(before);
        }
    }

    /// The client does not want a channel any more.
    pub fn unsubscribe(&self, subscription: u32) {
        let mut waiting = self.get();
        waiting.wanted.retain(|_, known| *known != subscription);
        waiting.forget(subscription);
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

    /// Nobody reads the messages of a channel any more.
    fn forget(&mut self, subscription: u32) {
        self.messages.retain(|(of, _)| *of != subscription);
        self.bytes = self.messages.iter().map(|(_, sent)| sent.payload.len()).sum();
        self.of_channel.remove(&subscription);
    }

    /// Where the oldest message is that has a later one of its channel; as far to the front as there are channels.
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
        // Who comes and goes leaves nothing waiting.
        (40..5000).for_each(|subscription| {
            queue.subscribe(1, subscription);
            queue.message(1, &sent(1, BYTES / 4));
            queue.unsubscribe(subscription);
        });
        assert!(queue.next().is_none());
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
