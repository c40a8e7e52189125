//! The conversation with a client, over any transport.

use std::io::{Read, Write};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::thread;
use std::time::{Duration, Instant};

use afp_debug::{Adapter, Outgoing};
use afp_output::frames::{Frames, WireError, frame};

pub use crate::commands::stream::read;

/// The next thing to handle.
pub enum Arrived {
    /// Messages of the client; an empty list if no message is complete yet.
    Messages(Vec<String>),
    /// Time has passed.
    Nothing,
    /// The client is gone.
    End,
}

/// The maximum delay of the run while clients send messages.
const LATE: Duration = Duration::from_millis(10);

/// The run's clock, independent of the clients' messages.
pub(super) struct Clock {
    begin: Instant,
    /// The time of the last step, or of the start.
    ticked: Instant,
    /// Whether the run waits for clients.
    held: bool,
}

impl Clock {
    pub(super) fn new() -> Clock {
        let begin = Instant::now();
        Clock { begin, ticked: begin, held: true }
    }

    /// The adapter's current time.
    pub(super) fn now(&self) -> Duration {
        self.begin.elapsed()
    }

    /// The time to wait for clients; `None` if the run itself waits for them.
    pub(super) fn rest(&mut self, adapter: &Adapter<'_>) -> Option<Duration> {
        let due = adapter.due();
        self.held = due.is_none();
        due.map(|due| due.saturating_sub(self.ticked.elapsed()))
    }

    /// Continues the run if its time has come. After an arrival, the run continues only if it is
    /// late. Messages are handled first, but a busy client cannot hold the run.
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

/// Talks with a client until it disconnects; then the robot has stopped.
///
/// `next` waits for the client for at most the given time. `send` returns whether the client still
/// listens.
///
/// # Errors
/// The errors of `next`.
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
        // This is the only client.
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
/// The input is not a sequence of messages.
pub(super) fn serve(
    adapter: Adapter<'_>,
    from: impl Read + Send + 'static,
    mut to: impl Write + Send + 'static,
) -> Result<(), WireError> {
    let (sender, arrived) = channel();
    // The thread ends with the stream or with the program.
    thread::spawn(move || read(from, |bytes| sender.send(bytes).is_ok()));
    let mut frames = Frames::default();
    #[cfg(unix)]
    let mut elsewhere = super::elsewhere::Elsewhere::default();
    let next = |due: Option<Duration>| match wait(&arrived, due) {
        Ok(bytes) => {
            frames.push(&bytes);
            let mut messages = Vec::new();
            while let Some(message) = frames.next_message()? {
                #[cfg(unix)]
                if elsewhere.takes(&message) {
                    return Ok(Arrived::End);
                }
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
    converse(adapter, next, send)?;
    #[cfg(unix)]
    elsewhere.go_on(frames, &arrived, to)?;
    Ok(())
}

/// Waits for an arrival until the next step of the run.
pub fn wait<T>(arrived: &Receiver<T>, due: Option<Duration>) -> Result<T, RecvTimeoutError> {
    match due {
        None => arrived.recv().map_err(|_| RecvTimeoutError::Disconnected),
        Some(due) => arrived.recv_timeout(due),
    }
}
