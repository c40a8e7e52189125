//! The instant from which a supervisor counts its time.

use afp_core::{Duration, Instant};

/// The start of the supervisor, or the last change of a value.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Since {
    start: Instant,
    value: Option<i64>,
}

impl Since {
    pub(crate) fn new(now: Instant) -> Since {
        Since { start: now, value: None }
    }

    /// The start after the value of this poll. The first value changes nothing.
    pub(crate) fn start(&mut self, value: i64, now: Instant) -> Instant {
        if self.value.replace(value).is_some_and(|before| before != value) {
            self.start = now;
        }
        self.start
    }

    /// Does not count the time of a suspension.
    pub(crate) fn shift(&mut self, away: Duration) {
        self.start += away;
    }
}
