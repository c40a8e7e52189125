//! The clock of virtual time.
//!
//! Within a step it only advances by the cost of slow devices.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use afp_core::{Clock, Duration, Instant};

/// A clock for the scheduler.
///
/// A poll that uses a slow device is late by the device's cost. A platform shares clones of its
/// clock, and [`VirtualClock::free`] is the earliest time of the next step
/// ([`afp_core::Platform::ready`]).
#[derive(Clone, Debug, Default)]
pub struct VirtualClock {
    /// Nanoseconds since the start.
    free: Arc<AtomicU64>,
}

impl VirtualClock {
    /// The end of the computations so far; in the past if nothing took time.
    pub fn free(&self) -> Instant {
        Instant::from_nanos(self.free.load(Ordering::Relaxed))
    }

    /// Spends `cost` of computing time, from `now` or from the end of earlier computations.
    pub fn spend(&self, now: Instant, cost: Duration) {
        let end = self.free().max(now) + cost;
        self.free.store(end.as_nanos(), Ordering::Relaxed);
    }

    /// An independent clock with the same time, for a copy of a platform; a clone is the same
    /// clock.
    pub fn split(&self) -> Self {
        VirtualClock { free: Arc::new(AtomicU64::new(self.free().as_nanos())) }
    }
}

impl Clock for VirtualClock {
    fn now(&self, step: Instant) -> Instant {
        step.max(self.free())
    }
}
