//! The conversation with a client, over any transport.

use std::io::{Read, Write};
#[cfg(unix)]
use std::sync::Arc;
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use afp_debug::{Adapter, Outgoing};
use afp_output::frames::{WireError, frame};

use super::incoming::{Arrived, Incoming};

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
    to: impl Write + Send + 'static,
) -> Result<(), WireError> {
    let mut incoming = Incoming::new(from);
    #[cfg(unix)]
    let mut elsewhere = super::elsewhere::Elsewhere::default();
    let next = |due: Option<Duration>| {
        let arrived = incoming.next(due)?;
        #[cfg(unix)]
        let arrived = elsewhere.look(arrived);
        Ok(arrived)
    };
    let to = Mutex::new(to);
    let write = move |bytes: &[u8]| {
        let mut to = to.lock().unwrap_or_else(PoisonError::into_inner);
        to.write_all(bytes).and_then(|()| to.flush()).is_ok()
    };
    let send =
        |out: &[String]| write(&out.iter().flat_map(|message| frame(message)).collect::<Vec<_>>());
    converse(adapter, next, send)?;
    #[cfg(unix)]
    {
        let tell: super::Tell = Arc::new(move |message| write(&frame(message)));
        elsewhere.go_on(|due| incoming.next(due), &tell)?;
    }
    Ok(())
}
