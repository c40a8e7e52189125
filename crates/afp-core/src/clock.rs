//! Clocks that time polls.
//!
//! The driver gives each step its time, which is constant within the step. A clock only measures
//! polls.

use afp_types::Instant;

/// Measures time within a step.
///
/// ```
/// use afp_core::{Clock, Instant};
/// use std::sync::atomic::{AtomicU64, Ordering};
///
/// /// The microseconds of a timer; its interrupt counts them.
/// static MICROS: AtomicU64 = AtomicU64::new(0);
///
/// struct Timer;
///
/// impl Clock for Timer {
///     fn now(&self, step: Instant) -> Instant {
///         Instant::from_nanos(MICROS.load(Ordering::Relaxed) * 1_000).max(step)
///     }
/// }
/// # MICROS.store(7, Ordering::Relaxed);
/// # assert_eq!(Timer.now(Instant::ZERO), Instant::from_nanos(7_000));
/// # assert_eq!(Timer.now(Instant::MAX), Instant::MAX);
/// ```
pub trait Clock {
    /// The current time, in a step called at `step`; never earlier than that.
    fn now(&self, step: Instant) -> Instant;
}

/// A clock that is constant within a step: polls take no time.
#[derive(Clone, Copy, Debug, Default)]
pub struct StillClock;

impl Clock for StillClock {
    #[inline]
    fn now(&self, step: Instant) -> Instant {
        step
    }
}

impl<C: Clock + ?Sized> Clock for &C {
    #[inline]
    fn now(&self, step: Instant) -> Instant {
        (**self).now(step)
    }
}
