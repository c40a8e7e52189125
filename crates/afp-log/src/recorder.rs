//! The control side of a log: a trace sink and some robot channels with one bounded queue.
//!
//! Recording copies a few hundred bytes into the queue and returns. Another thread converts them to
//! messages and writes them.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicU8, AtomicU64, Ordering};
use std::thread::{self, JoinHandle};
use std::time::{Duration as Span, Instant as Wall};

use afp_core::trace::{Names, Record, Sink, TraceEntryId};
use afp_core::{Instant, Value, ValueRef};
use rtrb::{Consumer, Producer, PushError, RingBuffer};

use crate::channels::{FRAMES, Said, Signal};
use crate::encode::{Encoder, Item};
use crate::error::LogError;
use crate::messages::Messages;
use crate::robot::{Image, Level, Pose2, Ranging, Shape, Transform};
use crate::write::{About, LogFile};
use afp_session::{Datum, OwnedRecord, RunEvent};

/// The capacity of the queue: a second of a busy plan.
const CAPACITY: usize = 8192;
/// The free items required before a loss is reported: the repeated state must not be lost again.
const ROOM: usize = 256;
/// The flush interval, so that a crash loses little.
const FLUSH_EVERY: Span = Span::from_millis(250);
/// The number of items after which a recorder that may wait wakes its writer, so that both work at
/// the same time.
const BATCH: u32 = 1024;
/// The recorder's pause if the queue is full.
const REST: Span = Span::from_micros(125);

/// Behaviour if the writer is too slow.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WhenFull {
    /// Drop the item and count it: control must not wait for a disk.
    Drop,
    /// Wait for the writer: simulated time does not advance.
    Wait,
}

/// A closed log.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Written {
    /// Its path; empty if no file was written.
    pub path: PathBuf,
    /// Its size.
    pub bytes: u64,
    /// The number of items that were dropped because the writer was too slow.
    pub lost: u64,
}

/// Records a run into an MCAP file, or sends it to live clients.
///
/// The file is `NAME.part` until [`Recorder::finish`]. A recorder that is dropped without it closes
/// the file and keeps that name; if the plan has not started, it removes the file.
pub struct Recorder {
    queue: Producer<Item>,
    when_full: WhenFull,
    /// Items since the writer was woken for a batch.
    batch: u32,
    lost: u64,
    /// Dropped items that the log does not mention yet.
    unreported: u64,
    /// Whether a loss was reported since the last query.
    reported: bool,
    /// The values of all entries, by number; empty if nothing is dropped.
    entries: Vec<Value>,
    end: Arc<End>,
    thread: Option<JoinHandle<Outcome>>,
    started: bool,
    kept: Option<PathBuf>,
    pub(crate) is_live: bool,
}

type Outcome = Result<(PathBuf, u64), LogError>;

/// The writer's order at the end.
#[derive(Default)]
struct End {
    state: AtomicU8,
    unreported: AtomicU64,
}

const RUN: u8 = 0;
const CLOSE: u8 = 1;
const ABANDON: u8 = 2;
const DISCARD: u8 = 3;

impl Recorder {
    /// Creates the log and starts its writer. A session in virtual time waits for a slow disk; a
    /// real robot does not.
    ///
    /// # Errors
    /// [`LogError::Create`] if the file cannot be created.
    pub fn create(
        path: &Path,
        about: &About,
        names: Box<dyn Names + Send>,
        when_full: WhenFull,
    ) -> Result<Self, LogError> {
        let failed = |error: LogError| error.writing(path);
        let (file, kept) = LogFile::create(path, about).map_err(failed)?;
        let mut recorder =
            Recorder::begin(Box::new(file), names, when_full, path).map_err(failed)?;
        recorder.kept = kept;
        Ok(recorder)
    }

    /// Sends a run to a receiver of messages, on a separate thread. It drops items if the receiver
    /// is too slow, because a session never waits.
    ///
    /// # Errors
    /// The receiver rejects the first messages, or no thread can be created.
    pub fn stream(to: Box<dyn Messages>, names: Box<dyn Names + Send>) -> Result<Self, LogError> {
        let mut recorder = Recorder::begin(to, names, WhenFull::Drop, Path::new("live"))?;
        recorder.is_live = true;
        Ok(recorder)
    }

    fn begin(
        to: Box<dyn Messages>,
        names: Box<dyn Names + Send>,
        when_full: WhenFull,
        path: &Path,
    ) -> Result<Self, LogError> {
        let entries = match when_full {
            WhenFull::Drop => vec![Value::Unset; names.entries() as usize],
            WhenFull::Wait => Vec::new(),
        };
        let file = Encoder::new(to, names)?;
        let (queue, items) = RingBuffer::new(CAPACITY);
        let end = Arc::new(End::default());
        let seen = Arc::clone(&end);
        let thread = thread::Builder::new()
            .name("afp-log".into())
            .spawn({
                let path = path.to_owned();
                move || write_all(file, items, &seen).map_err(|error| error.writing(&path))
            })
            .map_err(|error| LogError::Create { path: path.to_owned(), error })?;
        Ok(Recorder {
            queue,
            when_full,
            batch: 0,
            lost: 0,
            unreported: 0,
            reported: false,
            entries,
            end,
            thread: Some(thread),
            started: false,
            kept: None,
            is_live: false,
        })
    }

    /// Writes the initial configuration.
    pub fn started(&mut self, at: Instant) {
        self.started = true;
        self.push(Item::Started(at), at);
    }

    /// Writes the robot's frames; only the first [`FRAMES`] of them.
    pub fn transforms(&mut self, at: Instant, transforms: &[Transform]) {
        let mut all = [None; FRAMES];
        all.iter_mut().zip(transforms).for_each(|(slot, transform)| *slot = Some(*transform));
        self.say(at, Said::Transforms(all));
    }

    /// Writes a pose of the robot.
    pub fn pose(&mut self, at: Instant, frame: &'static str, pose: Pose2) {
        self.say(at, Said::Pose { frame, pose });
    }

    /// Writes a range sensor's reading at this height, in metres.
    pub fn ranging(&mut self, at: Instant, device: &'static str, ranging: Ranging, height: f64) {
        self.say(at, Said::Ranging { device, ranging, height });
    }

    /// Writes a camera's picture; the writer converts it to a PNG.
    pub fn image(&mut self, at: Instant, device: &'static str, image: Image) {
        self.say(at, Said::Image { device, image });
    }

    /// Writes a device's sample; allocates for strings.
    pub fn sample(&mut self, at: Instant, signal: Signal, value: Datum) {
        self.say(at, Said::Sample { signal, value });
    }

    /// Writes an event that is not a trace record: an external input; allocates.
    pub fn event(&mut self, event: RunEvent) {
        let at = event.at;
        self.push(Item::Event(Box::new(event)), at);
    }

    /// Writes that items were dropped before they came here, and the values of all entries now.
    pub fn loss(&mut self, at: Instant, count: u64, entries: &[Value]) {
        self.lost += count;
        self.unreported += count;
        self.entries = entries.to_vec();
        self.tell_of_loss(at);
    }

    /// Writes the results as the metadata record `afp.end`.
    pub fn end(&mut self, at: Instant, facts: Vec<(String, String)>) {
        self.push(Item::End { at, facts }, at);
    }

    /// Writes the objects in the room. Allocates, so call it at the start.
    pub fn scene(&mut self, at: Instant, shapes: Vec<Shape>) {
        self.say(at, Said::Scene(shapes.into()));
    }

    /// Writes a line for users. Allocates, so do not call it within a step.
    pub fn text(&mut self, at: Instant, level: Level, name: &'static str, text: &str) {
        self.say(at, Said::Text { level, name, text: text.into() });
    }

    /// Stops dropping items after the end of the run.
    pub fn wait_when_full(&mut self) {
        self.when_full = WhenFull::Wait;
    }

    /// Whether the log has reported a loss since the last call. The caller must then repeat its
    /// state. Reports a pending loss if there is room.
    pub fn has_told_of_loss(&mut self, at: Instant) -> bool {
        self.tell_of_loss(at);
        std::mem::take(&mut self.reported)
    }

    /// The number of items that were dropped because the writer was too slow.
    pub fn lost(&self) -> u64 {
        self.lost
    }

    /// The new path of an earlier, killed run's unfinished log.
    pub fn kept(&self) -> Option<&Path> {
        self.kept.as_deref()
    }

    /// Waits for the writer and gives the log its name.
    ///
    /// # Errors
    /// The first failure of the writer; the data before it is in `NAME.part`.
    pub fn finish(mut self) -> Result<Written, LogError> {
        let (path, bytes) = self.close(CLOSE).unwrap_or(Err(LogError::Writer))?;
        Ok(Written { path, bytes, lost: self.lost })
    }

    /// Wakes the writer, which otherwise looks for items every 250 ms.
    pub(crate) fn wake(&self) {
        if let Some(thread) = &self.thread {
            thread.thread().unpark();
        }
    }

    fn say(&mut self, at: Instant, said: Said) {
        self.push(Item::Said { at, said }, at);
    }

    fn push(&mut self, item: Item, at: Instant) {
        self.tell_of_loss(at);
        self.put(item);
    }

    /// Reports a loss when there is room.
    fn tell_of_loss(&mut self, at: Instant) {
        let has_room = self.when_full == WhenFull::Wait || self.queue.slots() > ROOM;
        if self.unreported > 0 && has_room {
            let count = std::mem::take(&mut self.unreported);
            self.reported = true;
            self.put(Item::Lost { at, count, entries: self.entries.as_slice().into() });
        }
    }

    fn put(&mut self, item: Item) {
        let mut item = item;
        while let Err(PushError::Full(back)) = self.queue.push(item) {
            if self.when_full == WhenFull::Drop || self.queue.is_abandoned() {
                self.lost += 1;
                self.unreported += 1;
                return;
            }
            item = back;
            self.wake();
            thread::sleep(REST);
        }
        if self.when_full == WhenFull::Wait {
            self.batch = (self.batch + 1) % BATCH;
            if self.batch == 0 {
                self.wake();
            }
        }
    }

    fn set(&mut self, entry: TraceEntryId, value: ValueRef<'_>) {
        if let Some(kept) = self.entries.get_mut(entry.0 as usize) {
            *kept = value.to_value().unwrap_or_default();
        }
    }

    /// `None` if the writer has already ended.
    fn close(&mut self, how: u8) -> Option<Outcome> {
        let thread = self.thread.take()?;
        self.end.unreported.store(self.unreported, Ordering::Relaxed);
        self.end.state.store(how, Ordering::Release);
        thread.thread().unpark();
        Some(thread.join().unwrap_or(Err(LogError::Writer)))
    }
}

impl Sink for Recorder {
    fn record(&mut self, at: Instant, record: &Record<'_>) {
        self.push(Item::Record(OwnedRecord::new(at, record)), at);
        if let Record::Committed { entry, new, .. } = *record {
            self.set(entry, new);
        }
    }
}

impl Drop for Recorder {
    fn drop(&mut self) {
        // A drop has no receiver for errors; use `finish` for them.
        let _ = self.close(if self.started { ABANDON } else { DISCARD });
    }
}

/// The writer: moves the queue into the file until the recorder ends.
fn write_all(mut file: Encoder, mut items: Consumer<Item>, end: &End) -> Outcome {
    let mut flushed = Wall::now();
    let mut last = Instant::ZERO;
    let mut failure = None;
    loop {
        let state = end.state.load(Ordering::Acquire);
        let mut idle = true;
        while let Ok(item) = items.pop() {
            idle = false;
            last = item.at().unwrap_or(last);
            if failure.is_none() {
                failure = file.write(item).err();
            }
        }
        if failure.is_none() && flushed.elapsed() >= FLUSH_EVERY {
            failure = file.flush().err();
            flushed = Wall::now();
        }
        if idle && state != RUN {
            return match failure {
                Some(failure) => Err(failure),
                None if state == DISCARD => {
                    file.discard();
                    Ok((PathBuf::new(), 0))
                }
                None => file.finish(state == CLOSE, last, end.unreported.load(Ordering::Relaxed)),
            };
        }
        if idle {
            thread::park_timeout(FLUSH_EVERY);
        }
    }
}
