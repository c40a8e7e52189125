//! The clock of virtual time.
//!
//! It stands still within a step, but for what slow devices cost.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use afp_core::{Clock, Duration, Instant};

/// Tells the time to the scheduler.
///
/// A poll that uses a slow device is late by what the device takes. A platform gives clones of its clock away and
/// says with [`VirtualClock::free`] from when on a step can be made ([`afp_core::Platform::ready`]).
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

    /// Takes `cost` of computing time, from `now` or from when it is free.
    pub fn spend(&self, now: Instant, cost: Duration) {
        let end = self.free().max(now) + cost;
        self.free.store(end.as_nanos(), Ordering::Relaxed);
    }

    /// A clock that tells the same time and goes on by itself, for the copy of a platform: a clone is the same clock.
    pub fn split(&self) -> Self {
        VirtualClock { free: Arc::new(AtomicU64::new(self.free().as_nanos())) }
    }
}

impl Clock for VirtualClock {
    fn now(&self, step: Instant) -> Instant {
        step.max(self.free())
    }
}
