//! The conversation with a client, whatever carries it.

use std::io::{Read, Write};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::thread;
use std::time::{Duration, Instant};

use afp_debug::{Adapter, Outgoing};
use afp_output::frames::{Frames, WireError, frame};

pub use crate::commands::stream::read;

/// What there is to do next.
pub enum Arrived {
    /// Messages of the client are there, perhaps none that is whole.
    Messages(Vec<String>),
    /// Time has passed.
    Nothing,
    /// The client is gone.
    End,
}

/// How long clients may be listened to beyond the time at which the run goes on.
const LATE: Duration = Duration::from_millis(10);

/// When a run goes on, whatever clients say meanwhile.
pub(super) struct Clock {
    begin: Instant,
    /// When it went on last, or began to.
    ticked: Instant,
    /// Whether it waits for clients.
    held: bool,
}

impl Clock {
    pub(super) fn new() -> Clock {
        let begin = Instant::now();
        Clock { begin, ticked: begin, held: true }
    }

    /// The time that the adapter is told.
    pub(super) fn now(&self) -> Duration {
        self.begin.elapsed()
    }

    /// How long clients can be waited for; none where the run waits for them.
    pub(super) fn rest(&mut self, adapter: &Adapter<'_>) -> Option<Duration> {
        let due = adapter.due();
        self.held = due.is_none();
        due.map(|due| due.saturating_sub(self.ticked.elapsed()))
    }

    /// Lets the run go on if it is time, after something has `arrived` only where it is late: what has been said is heard first,
    /// but nobody who says much holds the run.
    pub(super) fn tick(&mut self, adapter: &mut Adapter<'_>, arrived: bool) -> Vec<Outgoing> {
        if std::mem::take(&mut self.held) {
            self.ticked = Instant::now();
        }
        let may_be_late = if arrived { LATE } else { Duration::ZERO };
        let passed = self.ticked.elapsed();
        if adapter.due().is_none_or(|due| passed < due + may_be_late) {
            return Vec::new();
        }
        let outgoing = adapter.tick(self.now());
        self.ticked = Instant::now();
        outgoing
    }
}

/// Talks with a client until it says goodbye or goes away; then the robot has stopped. `next` waits for the client, at
/// most as long as it is told; `send` says whether somebody still listens.
///
/// # Errors
/// Those of `next`.
pub fn converse(
    mut adapter: Adapter<'_>,
    mut next: impl FnMut(Option<Duration>) -> Result<Arrived, WireError>,
    mut send: impl FnMut(&[String]) -> bool,
) -> Result<(), WireError> {
    let mut clock = Clock::new();
    let client = adapter.join();
    while !adapter.is_over(client) {
        let (mut out, mut arrived) = (Vec::new(), false);
        match next(clock.rest(&adapter))? {
            Arrived::Messages(messages) => {
                for message in &messages {
                    out.extend(adapter.handle(client, message, clock.now()));
                }
                arrived = true;
            }
            Arrived::Nothing => {}
            Arrived::End => return Ok(()),
        }
        out.extend(clock.tick(&mut adapter, arrived));
        // There is no other client.
        let out: Vec<_> = out.into_iter().map(|told| told.message).collect();
        if !out.is_empty() && !send(&out) {
            return Ok(());
        }
    }
    Ok(())
}

/// Talks with a client over a stream of bytes.
///
/// # Errors
/// What arrives are no messages.
pub(super) fn serve(
    adapter: Adapter<'_>,
    from: impl Read + Send + 'static,
    mut to: impl Write,
) -> Result<(), WireError> {
    let (sender, arrived) = channel();
    // It ends with the stream, or with the program.
    thread::spawn(move || read(from, |bytes| sender.send(bytes).is_ok()));
    let mut frames = Frames::default();
    let next = |due: Option<Duration>| match wait(&arrived, due) {
        Ok(bytes) => {
            frames.push(&bytes);
            let mut messages = Vec::new();
            while let Some(message) = frames.next_message()? {
                messages.push(message);
            }
            Ok(Arrived::Messages(messages))
        }
        Err(RecvTimeoutError::Timeout) => Ok(Arrived::Nothing),
        Err(RecvTimeoutError::Disconnected) => {
            std::mem::take(&mut frames).finish().map(|()| Arrived::End)
        }
    };
    let send = |out: &[String]| {
        let bytes: Vec<u8> = out.iter().flat_map(|message| frame(message)).collect();
        to.write_all(&bytes).and_then(|()| to.flush()).is_ok()
    };
    converse(adapter, next, send)
}

/// Waits, at most as long as the run can.
pub fn wait<T>(arrived: &Receiver<T>, due: Option<Duration>) -> Result<T, RecvTimeoutError> {
    match due {
        None => arrived.recv().map_err(|_| RecvTimeoutError::Disconnected),
        Some(due) => arrived.recv_timeout(due),
    }
}
