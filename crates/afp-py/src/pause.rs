//! Checks for signals and stop requests while something runs for long.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use pyo3::prelude::*;

use crate::attach::attached;
use crate::component::Host;

/// How often signals are looked at.
const EVERY: Duration = Duration::from_millis(30);
/// The clock is read once for so many turns.
const TURNS: u32 = 8;

/// What can end a run from outside.
pub struct Pause {
    host: Option<Arc<Host>>,
    stop: Arc<AtomicBool>,
    next: Instant,
    turns: u32,
    /// Whether the last look took its time.
    pub is_long: bool,
}

/// Why a run does not go on.
pub enum Halt {
    /// Somebody asked for it.
    Asked,
    /// A component raised what ends everything; [`Host::aborted`] has it.
    Aborted,
    /// A handler of a signal raised this, `KeyboardInterrupt` as a rule.
    Raised(PyErr),
}

impl Pause {
    /// For what nobody can ask to stop.
    pub fn of_signals() -> Self {
        Pause::new(None, Arc::default())
    }

    /// For a plan: with its components, and what asks it to stop.
    pub fn new(host: Option<Arc<Host>>, stop: Arc<AtomicBool>) -> Self {
        Pause { host, stop, next: Instant::now() + EVERY, turns: 0, is_long: false }
    }

    /// Whether a component has ended everything.
    pub fn has_ended_all(&self) -> bool {
        self.host.as_ref().is_some_and(|host| host.has_ended_all())
    }

    /// Whether somebody asked for an end.
    #[inline]
    pub fn is_asked(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
            || self.host.as_ref().is_some_and(|host| host.is_aborted())
    }

    /// Looks whether somebody asked for an end, which is asked for once.
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

    /// Looks whether the run goes on; at signals from time to time.
    pub fn look(&mut self) -> Option<Halt> {
        if let Some(halt) = self.asked() {
            return Some(halt);
        }
        self.turns += 1;
        // Components take their time: then every turn counts.
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
