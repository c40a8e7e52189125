//! The progress of a long run, on one line of a terminal.

use std::io::{self, IsTerminal, Write};
use std::time::{Duration as Span, Instant as Wall};

use afp_core::Instant;

/// A run shorter than this shows no progress.
const FIRST: Span = Span::from_millis(700);
const EVERY: Span = Span::from_millis(200);

/// A line on standard error that is overwritten with each update.
pub(crate) struct Progress {
    end: Instant,
    begun: Wall,
    next: Wall,
    shows: bool,
    terminal: bool,
}

impl Progress {
    /// Shows nothing unless `shown`: a blocked terminal would block the run.
    pub(crate) fn new(end: Instant, shown: bool) -> Self {
        let begun = Wall::now();
        let terminal = shown && io::stderr().is_terminal();
        Progress { end, begun, next: begun + FIRST, shows: false, terminal }
    }

    /// Updates the line from time to time; returns whether it did.
    pub(crate) fn pass(&mut self, now: Instant) -> bool {
        let wall = Wall::now();
        if wall < self.next {
            return false;
        }
        self.next = wall + EVERY;
        if self.terminal {
            let (secs, spent) = (now.as_secs_f64(), (wall - self.begun).as_secs_f64());
            let of = match self.end {
                Instant::MAX => String::new(),
                end => format!(" of {:.0} s", end.as_secs_f64()),
            };
            let speed = secs / spent;
            let _ = write!(io::stderr(), "\r\x1b[K{secs:.1} s{of}, {speed:.0} x real time");
            let _ = io::stderr().flush();
            self.shows = true;
        }
        true
    }

    /// Removes the line.
    pub(crate) fn clear(&mut self) {
        if self.shows {
            let _ = write!(io::stderr(), "\r\x1b[K");
            let _ = io::stderr().flush();
            self.shows = false;
        }
    }
}
