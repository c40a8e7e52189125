//! How far a long run has come, on one line of a terminal.

use std::io::{self, IsTerminal, Write};
use std::time::{Duration as Span, Instant as Wall};

use afp_core::Instant;

/// Short runs need no progress.
const FIRST: Span = Span::from_millis(700);
const EVERY: Span = Span::from_millis(200);

/// A line on standard error that is written over again and again.
pub(crate) struct Progress {
    end: Instant,
    begun: Wall,
    next: Wall,
    shows: bool,
    terminal: bool,
}

impl Progress {
    /// Without `shown` there is no line: a terminal that does not take it would hold up whoever writes.
    pub(crate) fn new(end: Instant, shown: bool) -> Self {
        let begun = Wall::now();
        let terminal = shown && io::stderr().is_terminal();
        Progress { end, begun, next: begun + FIRST, shows: false, terminal }
    }

    /// Shows where the run is, now and then; whether it was time to.
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

    /// Takes the line away.
    pub(crate) fn clear(&mut self) {
        if self.shows {
            let _ = write!(io::stderr(), "\r\x1b[K");
            let _ = io::stderr().flush();
            self.shows = false;
        }
    }
}
