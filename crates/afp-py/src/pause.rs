//! Checks for signals and stop requests during long runs.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use pyo3::prelude::*;

use crate::attach::attached;
use crate::component::Host;

/// The interval of signal checks.
const EVERY: Duration = Duration::from_millis(30);
/// The turns between two readings of the clock.
const TURNS: u32 = 8;

/// The ways to end a run from outside.
pub struct Pause {
    host: Option<Arc<Host>>,
    stop: Arc<AtomicBool>,
    next: Instant,
    turns: u32,
    /// Whether the last turn took long.
    pub is_long: bool,
}

/// The reason why a run stops.
pub enum Halt {
    /// A stop request.
    Asked,
    /// An exception of a component that ends the run, stored in [`Host::aborted`].
    Aborted,
    /// The exception of a signal handler, usually `KeyboardInterrupt`.
    Raised(PyErr),
}

impl Pause {
    /// Checks only signals.
    pub fn of_signals() -> Self {
        Pause::new(None, Arc::default())
    }

    /// Checks a plan's components and stop requests, too.
    pub fn new(host: Option<Arc<Host>>, stop: Arc<AtomicBool>) -> Self {
        Pause { host, stop, next: Instant::now() + EVERY, turns: 0, is_long: false }
    }

    /// Whether a component has ended the run.
    pub fn has_ended_all(&self) -> bool {
        self.host.as_ref().is_some_and(|host| host.has_ended_all())
    }

    /// Whether a stop was requested.
    #[inline]
    pub fn is_asked(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
            || self.host.as_ref().is_some_and(|host| host.is_aborted())
    }

    /// Takes a stop request, if there is one.
    #[inline]
    pub fn asked(&mut self) -> Option<Halt> {
        self.is_long = false;
        if self.stop.load(Ordering::Relaxed) && self.stop.swap(false, Ordering::Relaxed) {
            return Some(Halt::Asked);
        }
        if self.host.as_ref().is_some_and(|host| host.is_aborted()) {
            return Some(Halt::Aborted);
        }
        None
    }

    /// Checks whether the run continues, with signals at intervals.
    pub fn look(&mut self) -> Option<Halt> {
        if let Some(halt) = self.asked() {
            return Some(halt);
        }
        self.turns += 1;
        // Components can be slow, so with them every turn counts.
        if self.turns < TURNS && self.host.is_none() {
            return None;
        }
        self.turns = 0;
        let now = Instant::now();
        if now < self.next {
            return None;
        }
        self.next = now + EVERY;
        self.is_long = true;
        attached(|py| py.check_signals()).err().map(Halt::Raised)
    }
}
