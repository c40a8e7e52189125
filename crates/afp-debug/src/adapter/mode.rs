//! How a run continues, its speed, and how it ends.

use std::time::Duration as Wall;

use afp_core::trace::ComponentId;
use afp_core::{Duration, Instant};

/// The instants computed between two checks for messages at unlimited speed.
pub(super) const BATCH: usize = 2_000;

/// The wall-clock time between two state messages.
pub(super) const STATES: Wall = Wall::from_millis(50);

/// The most bytes of state messages of a live run for a client in a second.
const BYTES: f64 = 16_000.0;

/// The pause after state messages of this size, in a live run.
pub(super) fn pause_after(bytes: usize) -> Wall {
    Wall::from_secs_f64(bytes as f64 / BYTES)
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Mode {
    /// Stopped.
    Held,
    /// Continue until something stops the run.
    On,
    /// Until the next transition of a plan, or its end.
    Next(ComponentId),
    /// Until the next transition of any plan.
    Into,
    /// Until the end of a sub-plan.
    Out(ComponentId),
    /// One step of the scheduler.
    One,
    /// Until an element is active, along forced edges.
    Goto(ComponentId),
    /// Up to an instant, without stops on the way.
    Seek {
        to: Instant,
        /// Whether the run then continues at its speed.
        goes_on: bool,
    },
    Over,
}

impl Mode {
    pub fn is_step(self) -> bool {
        matches!(self, Mode::Next(_) | Mode::Into | Mode::Out(_) | Mode::One | Mode::Goto(_))
    }
}

/// The reason why a run ended.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum By {
    Plan,
    /// The time limit.
    Until,
    Client(String),
}

/// The speed of a run.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pace {
    /// A multiple of real time; `None` means unlimited.
    pub factor: Option<f64>,
    /// The instants of run and wall clock when this speed began.
    since: (Instant, Wall),
}

impl Pace {
    pub fn new(factor: Option<f64>, at: Instant, now: Wall) -> Pace {
        Pace { factor, since: (at, now) }
    }

    /// Returns the instant of the run at a wall-clock time.
    pub fn limit(&self, now: Wall) -> Instant {
        let (at, wall) = self.since;
        match self.factor {
            None => Instant::MAX,
            Some(factor) => {
                let passed = now.saturating_sub(wall).as_secs_f64() * factor;
                at + Duration::from_secs_f64(passed)
            }
        }
    }
}
