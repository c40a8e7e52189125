//! The control side of a log: a trace sink and a handful of robot channels, all behind one
//! bounded queue.
//!
//! Recording copies a few hundred bytes into the queue and returns. A thread of its own turns
//! them into messages and writes them.

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

/// Items that the queue holds: a second of a busy plan.
const CAPACITY: usize = 8192;
/// So many must be free before a loss is told of: what is said again after it shall not be lost at once.
const ROOM: usize = 256;
/// How often the file is brought up to date, so that a crash loses little.
const FLUSH_EVERY: Span = Span::from_millis(250);
/// How long the writer rests when there is nothing to do.
const REST: Span = Span::from_micros(500);

/// What to do when the writer cannot keep up.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WhenFull {
    /// Drop the item and count it: control must not wait for a disk.
    Drop,
    /// Wait for the writer: simulated time stands still meanwhile.
    Wait,
}

/// A log that was closed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Written {
    /// Where it is; empty where nothing was written to a file.
    pub path: PathBuf,
    /// Its size.
    pub bytes: u64,
    /// Items that were dropped because the writer could not keep up.
    pub lost: u64,
}

/// Records a run into an MCAP file, or sends it to whoever watches.
///
/// The file is `NAME.part` until [`Recorder::finish`]; dropped without it, the file is closed in
/// order but keeps that name, and goes where the plan has not started.
pub struct Recorder {
    queue: Producer<Item>,
    when_full: WhenFull,
    lost: u64,
    /// Of those, the ones that the log does not mention yet.
    unreported: u64,
    /// Whether a loss was told of since somebody asked.
    reported: bool,
    /// What all entries hold, by number; none where nothing is dropped.
    entries: Vec<Value>,
    end: Arc<End>,
    thread: Option<JoinHandle<Outcome>>,
    /// Whether the plan has started.
    started: bool,
    kept: Option<PathBuf>,
    /// Whether it is sent to those who watch, not into a file.
    pub(crate) is_live: bool,
}

type Outcome = Result<(PathBuf, u64), LogError>;

/// What the writer learns at the end.
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
    /// Creates the log and starts its writer. A session in virtual time waits where the disk is slow; a robot that is there
    /// must not.
    ///
    /// # Errors
    /// [`LogError::Create`] when the file cannot be made.
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

    /// Sends a run to whoever takes its messages, by a thread of its own; what it cannot keep up with is dropped, for a
    /// session never waits.
    ///
    /// # Errors
    /// The first messages are not taken, or there is no thread.
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

    /// Writes the configuration that the plan starts with.
    pub fn started(&mut self, at: Instant) {
        self.started = true;
        self.push(Item::Started(at), at);
    }

    /// Where the robot's frames stand; of more than [`FRAMES`] the first ones.
    pub fn transforms(&mut self, at: Instant, transforms: &[Transform]) {
        let mut all = [None; FRAMES];
        all.iter_mut().zip(transforms).for_each(|(slot, transform)| *slot = Some(*transform));
        self.say(at, Said::Transforms(all));
    }

    /// Where the robot is.
    pub fn pose(&mut self, at: Instant, frame: &'static str, pose: Pose2) {
        self.say(at, Said::Pose { frame, pose });
    }

    /// What a range sensor says that stands so high, metres.
    pub fn ranging(&mut self, at: Instant, device: &'static str, ranging: Ranging, height: f64) {
        self.say(at, Said::Ranging { device, ranging, height });
    }

    /// What a camera saw; the writer makes a PNG of it.
    pub fn image(&mut self, at: Instant, device: &'static str, image: Image) {
        self.say(at, Said::Image { device, image });
    }

    /// What a device says now; allocates for texts.
    pub fn sample(&mut self, at: Instant, signal: Signal, value: Datum) {
        self.say(at, Said::Sample { signal, value });
    }

    /// Something that no record says: what came from outside; allocates.
    pub fn event(&mut self, event: RunEvent) {
        let at = event.at;
        self.push(Item::Event(Box::new(event)), at);
    }

    /// What the run came to: the metadata record `afp.end`.
    pub fn end(&mut self, at: Instant, facts: Vec<(String, String)>) {
        self.push(Item::End { at, facts }, at);
    }

    /// What stands in the room; allocates, so meant for the start.
    pub fn scene(&mut self, at: Instant, shapes: Vec<Shape>) {
        self.say(at, Said::Scene(shapes.into()));
    }

    /// A line for people; allocates, so not for use within a step.
    pub fn text(&mut self, at: Instant, level: Level, name: &'static str, text: &str) {
        self.say(at, Said::Text { level, name, text: text.into() });
    }

    /// From now on nothing is dropped: the run is over, and nobody is kept waiting.
    pub fn wait_when_full(&mut self) {
        self.when_full = WhenFull::Wait;
    }

    /// Whether the log has been told of a loss since the last time, and so may lack what was said before: it is to be said
    /// again. Tells it of one that it can be told of now.
    pub fn has_told_of_loss(&mut self, at: Instant) -> bool {
        self.tell_of_loss(at);
        std::mem::take(&mut self.reported)
    }

    /// Items dropped so far because the writer could not keep up.
    pub fn lost(&self) -> u64 {
        self.lost
    }

    /// Where that is now which a run that was killed left of the same log.
    pub fn kept(&self) -> Option<&Path> {
        self.kept.as_deref()
    }

    /// Waits for the writer and gives the log its name.
    ///
    /// # Errors
    /// The first failure of the writer; what it wrote before stays in `NAME.part`.
    pub fn finish(mut self) -> Result<Written, LogError> {
        let (path, bytes) = self.close(CLOSE).unwrap_or(Err(LogError::Writer))?;
        Ok(Written { path, bytes, lost: self.lost })
    }

    fn say(&mut self, at: Instant, said: Said) {
        self.push(Item::Said { at, said }, at);
    }

    fn push(&mut self, item: Item, at: Instant) {
        self.tell_of_loss(at);
        self.put(item);
    }

    /// Tells the log of what got lost, as soon as there is room.
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
            thread::sleep(REST / 4);
        }
    }

    /// An entry holds something else from now on.
    fn set(&mut self, entry: TraceEntryId, value: ValueRef<'_>) {
        if let Some(kept) = self.entries.get_mut(entry.0 as usize) {
            *kept = value.to_value().unwrap_or_default();
        }
    }

    /// `None` when there is no writer any more.
    fn close(&mut self, how: u8) -> Option<Outcome> {
        let thread = self.thread.take()?;
        self.end.unreported.store(self.unreported, Ordering::Relaxed);
        self.end.state.store(how, Ordering::Release);
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
        // Nobody is left to tell of a failure; whoever wants to know calls `finish`.
        let _ = self.close(if self.started { ABANDON } else { DISCARD });
    }
}

/// The writer: the queue into the file until the recorder says that it is over.
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
            thread::sleep(REST);
        }
    }
}
