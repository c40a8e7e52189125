//! How a run goes on, how fast its time passes, and what ends it.

use std::time::Duration as Wall;

use afp_core::trace::ComponentId;
use afp_core::{Duration, Instant};

/// How a run goes on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Mode {
    /// It stands still.
    Held,
    /// Until something holds it.
    On,
    /// Until the next transition of a plan, or the end of that plan.
    Next(ComponentId),
    /// Until the next transition of any plan.
    Into,
    /// Until a sub-plan has ended.
    Out(ComponentId),
    /// One step of the scheduler.
    One,
    /// Until an element is active, along edges that are brought about.
    Goto(ComponentId),
    /// Up to an instant, whatever happens.
    Seek(Instant),
    Over,
}

impl Mode {
    /// Whether it is a step of a client.
    pub fn is_step(self) -> bool {
        matches!(self, Mode::Next(_) | Mode::Into | Mode::Out(_) | Mode::One | Mode::Goto(_))
    }
}

/// Who or what ended a run.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum By {
    Plan,
    /// The time that it was given.
    Until,
    /// A client, by its name.
    Client(String),
}

/// How fast time passes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pace {
    /// A multiple of time on the wall; none is as fast as it can be computed.
    pub factor: Option<f64>,
    /// The two times when it began to pass.
    since: (Instant, Wall),
}

impl Pace {
    pub fn new(factor: Option<f64>, at: Instant, now: Wall) -> Pace {
        Pace { factor, since: (at, now) }
    }

    /// The instant that is now.
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
