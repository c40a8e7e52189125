//! The queue of the search: states by the lower bound of their path's cost.
//!
//! Most states of a search are never expanded, so it is not worth sorting them. States wait in
//! buckets of similar cost, and only the current bucket is sorted. A heap holds later additions to
//! it. States come out in the order of a single heap.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// The number of buckets, and the bits of a cost that are equal in one.
const BUCKETS: u64 = 1024;
const ALIKE: u32 = 8;

/// Buckets with more entries free their memory: each search fills other buckets.
const MOST_KEPT: usize = 1024;

/// The bits of a cost in an entry; the costs of paths over 32-bit positions are far below the
/// limit.
const COST_BITS: u32 = 48;
const MOST: u64 = (1 << COST_BITS) - 1;

/// A waiting state as one number for comparisons: the lower bound of a path's cost, the remaining
/// part of it (among equals, the farthest comes first), the state.
type Entry = Reverse<u128>;

/// The states to expand, the cheapest first.
#[derive(Debug)]
pub(super) struct Queue {
    /// The contents of the current bucket at its turn, the last first.
    now: Vec<Entry>,
    /// Later additions to the current bucket or before it.
    late: BinaryHeap<Entry>,
    /// The number of the current bucket; bucket `n` is `n % BUCKETS` of `later`.
    at: u64,
    /// The first bucket without space in `later`.
    end: u64,
    later: Vec<Vec<Entry>>,
    /// The number of states in `later`.
    waiting: usize,
    /// Entries for buckets from `end` on.
    beyond: Vec<Entry>,
}

impl Queue {
    pub(super) fn new() -> Queue {
        Queue {
            now: Vec::new(),
            late: BinaryHeap::new(),
            at: 0,
            end: BUCKETS,
            later: vec![Vec::new(); BUCKETS as usize],
            waiting: 0,
            beyond: Vec::new(),
        }
    }

    /// Empties the queue.
    pub(super) fn clear(&mut self) {
        self.now.clear();
        self.late.clear();
        self.beyond.clear();
        if self.waiting > 0 {
            self.later.iter_mut().for_each(empty);
            self.waiting = 0;
        }
        self.move_to(0);
    }

    /// Adds a state with its cost and the lower bound of the remaining cost.
    pub(super) fn push(&mut self, cost: u64, rest: u64, state: u32) {
        let (least, rest) = (cost.saturating_add(rest).min(MOST), rest.min(MOST));
        let costs = u128::from(least) << COST_BITS | u128::from(rest);
        self.put(Reverse(costs << u32::BITS | u128::from(state)));
    }

    /// Removes the cheapest state and returns it with its cost.
    pub(super) fn pop(&mut self) -> Option<(u64, u32)> {
        loop {
            if let Some(Reverse(entry)) = self.next() {
                let rest = (entry >> u32::BITS) as u64 & MOST;
                // The lower bits are the state.
                return Some((least(entry) - rest, entry as u32));
            }
            if self.waiting == 0 {
                let first = self.beyond.iter().map(|entry| bucket(entry.0)).min()?;
                self.move_to(first);
                for entry in std::mem::take(&mut self.beyond) {
                    self.put(entry);
                }
                continue;
            }
            self.at += 1;
            let next = &mut self.later[(self.at % BUCKETS) as usize];
            self.waiting -= next.len();
            self.now.append(next);
            empty(next);
            self.now.sort_unstable();
        }
    }

    /// The first entry of the current bucket.
    fn next(&mut self) -> Option<Entry> {
        // The greatest entry is the first one.
        match (self.now.last(), self.late.peek()) {
            (Some(sorted), Some(late)) if sorted < late => self.late.pop(),
            (None, _) => self.late.pop(),
            _ => self.now.pop(),
        }
    }

    fn put(&mut self, entry: Entry) {
        let bucket = bucket(entry.0);
        if bucket <= self.at {
            self.late.push(entry);
        } else if bucket < self.end {
            self.later[(bucket % BUCKETS) as usize].push(entry);
            self.waiting += 1;
        } else {
            self.beyond.push(entry);
        }
    }

    fn move_to(&mut self, bucket: u64) {
        self.at = bucket;
        self.end = bucket + BUCKETS;
    }
}

fn empty(bucket: &mut Vec<Entry>) {
    bucket.clear();
    if bucket.capacity() > MOST_KEPT {
        *bucket = Vec::new();
    }
}

fn least(entry: u128) -> u64 {
    (entry >> (COST_BITS + u32::BITS)) as u64
}

fn bucket(entry: u128) -> u64 {
    least(entry) >> ALIKE
}

#[cfg(test)]
mod tests {
    use super::{ALIKE, BUCKETS, Queue};

    /// A large drawing once took hundreds of megabytes for the old contents of each bucket.
    #[test]
    fn old_entries_take_no_memory() {
        let mut queue = Queue::new();
        for bucket in 0..20_u64 {
            for state in 0..5_000 {
                queue.push(bucket << ALIKE, 0, state);
            }
            while bucket % 2 == 0 && queue.pop().is_some() {}
            queue.clear();
            let kept: usize = queue.later.iter().map(Vec::capacity).sum();
            assert!(kept <= 5_000, "{bucket}: {kept}");
        }
    }

    /// Costs near each other, far from each other, and below the last one.
    #[test]
    fn states_come_out_in_the_order_of_a_heap() {
        let mut seed = 7_u64;
        let mut next = |below: u64| {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (seed >> 33) % below
        };
        let mut queue = Queue::new();
        for far in [1, 300, 3 * (BUCKETS << 8)] {
            queue.clear();
            let mut all: Vec<(u64, u64, u32)> = Vec::new();
            let take = |all: &mut Vec<(u64, u64, u32)>, queue: &mut Queue| {
                let first = all.iter().copied().min();
                all.retain(|each| Some(*each) != first);
                let (cost, state) = first.map(|(least, rest, state)| (least - rest, state)).unzip();
                assert_eq!(queue.pop(), cost.zip(state), "{far}");
            };
            for turn in 0..4000_u32 {
                let rest = next(10);
                let cost = next(1000) * far;
                queue.push(cost, rest, turn);
                all.push((cost + rest, rest, turn));
                if turn % 3 == 0 {
                    take(&mut all, &mut queue);
                }
            }
            while !all.is_empty() {
                take(&mut all, &mut queue);
            }
            assert_eq!(queue.pop(), None);
        }
    }
}
