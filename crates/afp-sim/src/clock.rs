//! The clock of virtual time.
//!
//! It stands still within a step, but for what slow devices cost.

use afp_core::{Clock, Duration, Instant};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

/// Tells the time to the scheduler; [`crate::Simulation::clock`] makes one.
///
/// A poll that uses a slow device is late by what the device takes. Whoever drives the scheduler
/// makes no step before [`VirtualClock::free`].
#[derive(Clone, Debug, Default)]
pub struct VirtualClock {
    /// Nanoseconds since the start.
    free: Arc<AtomicU64>,
}

impl VirtualClock {
    /// When whoever computes will have finished; in the past if nothing took time.
    pub fn free(&self) -> Instant {
        Instant::from_nanos(self.free.load(Ordering::Relaxed))
    }

    /// A clock that tells the same time and goes on by itself: a clone is the same clock.
    pub(crate) fn split(&self) -> VirtualClock {
        VirtualClock { free: Arc::new(AtomicU64::new(self.free().as_nanos())) }
    }

    /// Takes `cost` of computing time, from `now` or from when it is free.
    pub fn spend(&self, now: Instant, cost: Duration) {
        let end = self.free().max(now) + cost;
        self.free.store(end.as_nanos(), Ordering::Relaxed);
    }
}

impl Clock for VirtualClock {
    fn now(&self, step: Instant) -> Instant {
        step.max(self.free())
    }
}
