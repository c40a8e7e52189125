//! A bounded queue between the control thread of a real robot and its observers on another thread.
//!
//! The session has one observer, the [`QueueWriter`]. It copies records, samples and requests into the queue and returns.
//! The [`QueueReader`] on the other thread makes the lines and the hash of the trace and calls the observers. The
//! writer never waits: it drops an item for which the queue has no room, and counts it.

use std::fmt::Write;
use std::sync::{Arc, OnceLock};

use afp_core::devices::{DeviceRow, SignalId, SignalType, signals};
use afp_core::trace::{Line, Names, Record, TraceEntryId, TraceHash};
use afp_core::{Duration, Instant, Value};
use rtrb::{Consumer, Producer, RingBuffer};

use crate::observer::{Applied, NamedRecord, Observer, Sampling};
use crate::record::{OwnedRecord, is_clear};
use crate::request::{RequestError, RequestId};
use crate::sample::{FILM, OwnedSample, SampleRef};
use crate::sampling::{Samples, Turn};
use crate::session::grid::Stretch;
use crate::stimulus::Stimulus;

/// The smallest capacity: a second of a busy plan.
const CAPACITY: usize = 8192;
/// The free items required before a loss is reported, next to the values of all entries.
const ROOM: usize = 256;
/// The shortest time between two wake-ups of the reader.
const PAUSE: Duration = Duration::from_millis(50);

/// An item of the queue.
enum Item {
    Record(OwnedRecord),
    Sample(Instant, SignalId, OwnedSample),
    /// All samples of an instant were given.
    Sampled(Instant),
    Request(Box<OwnedRequest>),
    /// The value of an entry; a loss follows.
    Entry(TraceEntryId, Value),
    /// The number of items that are missing here.
    Lost(Instant, u64),
}

struct OwnedRequest {
    now: Instant,
    at: Instant,
    id: RequestId,
    what: Stimulus,
    refused: Option<RequestError>,
}

/// The data that a dropped writer leaves behind.
struct Rest {
    unreported: u64,
    entries: Box<[Value]>,
}

/// The writing end of the queue, the only observer of its session. The reader makes the trace.
///
/// Requests, pictures, outlines and texts longer than an entry can hold allocate; nothing else
/// does.
pub struct QueueWriter {
    queue: Producer<Item>,
    /// Dropped items that are not reported yet.
    unreported: u64,
    entries: Box<[Value]>,
    /// For each signal, whether the observers want it and when the next time.
    wanted: Box<[Wanted]>,
    sampling: Sampling,
    clear_polls: bool,
    wake: Box<dyn Fn() + Send>,
    /// The earliest time of the next wake-up.
    next_wake: Instant,
    rest: Arc<OnceLock<Rest>>,
}

#[derive(Clone, Copy)]
struct Wanted {
    from: Instant,
    is_picture: bool,
}

/// The reading end of the queue, for the thread of the observers.
pub struct QueueReader {
    items: Consumer<Item>,
    names: Box<dyn Names + Send>,
    devices: &'static [DeviceRow],
    entries: Box<[Value]>,
    trace: TraceHash,
    line: String,
    /// The last instant of samples.
    sampled: Option<Instant>,
    /// The time of the last item.
    last: Instant,
    lost: u64,
    rest: Arc<OnceLock<Rest>>,
}

/// Makes a queue for a plan with these names, a robot with these devices, and these observers.
///
/// The observers get samples at the shortest of their periods; [`Observer::after_step`] is not called. `wake` is called
/// on the control thread if there is something to read, at most 20 times a second; it must not block.
pub fn queue(
    names: Box<dyn Names + Send>,
    devices: &'static [DeviceRow],
    to: &[&mut (dyn Observer + Send + '_)],
) -> (QueueWriter, QueueReader) {
    let entries = vec![Value::Unset; names.entries() as usize].into_boxed_slice();
    let (queue, items) = RingBuffer::new(CAPACITY.max(4 * (entries.len() + ROOM)));
    let rest: Arc<OnceLock<Rest>> = Arc::default();
    let period = to.iter().filter_map(|each| each.sampling().grid()).min();
    let wanted = signals(devices).map(|(id, _, row)| {
        let is_picture = row.ty == SignalType::Image;
        let is_wanted = to
            .iter()
            .any(|each| each.sampling() != Sampling::Never && each.wants(Instant::ZERO, id));
        Wanted { from: if is_wanted { Instant::ZERO } else { Instant::MAX }, is_picture }
    });
    let writer = QueueWriter {
        queue,
        unreported: 0,
        entries: entries.clone(),
        wanted: wanted.collect(),
        sampling: period.map_or(Sampling::Never, Sampling::Every),
        clear_polls: to.iter().any(|each| each.wants_clear_polls()),
        wake: Box::new(|| ()),
        next_wake: Instant::ZERO,
        rest: rest.clone(),
    };
    let (trace, line, sampled) = (TraceHash::default(), String::new(), None);
    let (last, lost) = (Instant::ZERO, 0);
    let reader =
        QueueReader { items, names, devices, entries, trace, line, sampled, last, lost, rest };
    (writer, reader)
}

impl QueueWriter {
    /// Sets the function that wakes the reader.
    pub fn set_wake(&mut self, wake: Box<dyn Fn() + Send>) {
        self.wake = wake;
    }

    fn push(&mut self, at: Instant, item: Item) {
        let needed = self.entries.len() + ROOM;
        if self.unreported > 0 && self.queue.slots() > needed {
            for (id, value) in (0..).map(TraceEntryId).zip(&self.entries) {
                // The queue has room for all of them.
                let _ = self.queue.push(Item::Entry(id, value.clone()));
            }
            let _ = self.queue.push(Item::Lost(at, std::mem::take(&mut self.unreported)));
        }
        let is_urgent = match &item {
            Item::Record(record) => !is_clear(&record.get()),
            Item::Request(_) => true,
            _ => false,
        };
        if self.queue.push(item).is_err() {
            self.unreported += 1;
        }
        // For other items, the reader looks at the queue from time to time.
        if is_urgent || self.queue.slots() < self.queue.buffer().capacity() / 2 {
            self.wake(at);
        }
    }

    fn wake(&mut self, at: Instant) {
        if at >= self.next_wake {
            self.next_wake = at + PAUSE;
            (self.wake)();
        }
    }
}

impl Observer for QueueWriter {
    fn makes_trace(&self) -> bool {
        true
    }

    fn wants_clear_polls(&self) -> bool {
        self.clear_polls
    }

    fn on_record(&mut self, named: &NamedRecord<'_>) {
        if let Record::Committed { entry, new, .. } = *named.record
            && let Some(kept) = self.entries.get_mut(entry.0 as usize)
        {
            *kept = new.to_value().unwrap_or_default();
        }
        self.push(named.at, Item::Record(OwnedRecord::new(named.at, named.record)));
    }

    fn sampling(&self) -> Sampling {
        self.sampling
    }

    fn wants(&self, at: Instant, signal: SignalId) -> bool {
        self.wanted.get(usize::from(signal.0)).is_some_and(|wanted| at >= wanted.from)
    }

    fn on_sample(&mut self, at: Instant, signal: SignalId, value: SampleRef<'_>) {
        if let Some(wanted) = self.wanted.get_mut(usize::from(signal.0))
            && wanted.is_picture
        {
            wanted.from = at + FILM;
        }
        self.push(at, Item::Sample(at, signal, OwnedSample::new(value)));
    }

    fn after_samples(&mut self, at: Instant) {
        self.push(at, Item::Sampled(at));
    }

    fn on_request(&mut self, applied: &Applied<'_>) {
        let Applied { now, at, id, what, refused } = *applied;
        let (what, refused) = (what.clone(), refused.cloned());
        self.push(now, Item::Request(Box::new(OwnedRequest { now, at, id, what, refused })));
    }
}

impl Drop for QueueWriter {
    fn drop(&mut self) {
        let entries = std::mem::take(&mut self.entries);
        // It is set only here.
        let _ = self.rest.set(Rest { unreported: self.unreported, entries });
        (self.wake)();
    }
}

impl QueueReader {
    /// Reports the items of the queue to the observers. Returns whether more may come.
    pub fn read(&mut self, to: &mut [&mut dyn Observer]) -> bool {
        // Read before the queue, which gets no items after it is set.
        let shared = self.rest.clone();
        let rest = shared.get();
        while let Ok(item) = self.items.pop() {
            self.report(item, to);
        }
        if let Some(Rest { unreported, entries }) = rest
            && *unreported > 0
        {
            self.entries.clone_from(entries);
            self.report(Item::Lost(self.last, *unreported), to);
        }
        rest.is_none()
    }

    /// Returns the hash of the trace so far and the number of dropped items.
    pub fn finish(self) -> (TraceHash, u64) {
        (self.trace, self.lost)
    }

    fn report(&mut self, item: Item, to: &mut [&mut dyn Observer]) {
        match item {
            Item::Record(owned) => self.record(&owned, to),
            Item::Sample(at, signal, value) => {
                self.samples(at, to).put(signal, value.get());
            }
            Item::Sampled(at) => {
                self.samples(at, to).finish();
                self.sampled = Some(at);
            }
            Item::Request(request) => {
                let OwnedRequest { now, at, id, what, refused } = &*request;
                let (now, at, id, refused) = (*now, *at, *id, refused.as_ref());
                self.last = now;
                let applied = Applied { now, at, id, what, refused };
                to.iter_mut().for_each(|each| each.on_request(&applied));
            }
            Item::Entry(id, value) => {
                if let Some(kept) = self.entries.get_mut(id.0 as usize) {
                    *kept = value;
                }
            }
            Item::Lost(at, count) => {
                self.lost += count;
                to.iter_mut().for_each(|each| each.on_loss(at, count, &self.entries));
            }
        }
    }

    fn record(&mut self, owned: &OwnedRecord, to: &mut [&mut dyn Observer]) {
        let (at, record, names) = (owned.at, owned.get(), &*self.names);
        self.last = at;
        self.line.clear();
        let clear = is_clear(&record);
        if !clear {
            // Writing to a `String` cannot fail.
            let _ = write!(self.line, "{}", Line { at, record: &record, names });
            self.trace.line(&self.line);
        }
        let named = NamedRecord { at, record: &record, names, line: &self.line };
        for observer in to.iter_mut().filter(|each| !clear || each.wants_clear_polls()) {
            observer.on_record(&named);
        }
    }

    fn samples<'a, 'o>(&self, at: Instant, to: &'a mut [&'o mut dyn Observer]) -> Samples<'a, 'o> {
        let stretch = Stretch::between(self.sampled, at);
        Samples::of_turn(at, self.devices, to, Turn::Grid { before_step: false, stretch })
    }
}
