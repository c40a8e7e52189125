//! Clocks that time polls.
//!
//! The time of a step comes from whoever drives the scheduler and stands still within the step.
//! A clock only tells how long polls took.

use afp_types::Instant;

/// Tells the time within a step.
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
    /// The time now, in a step that was called at `step`; never before it.
    fn now(&self, step: Instant) -> Instant;
}

/// A clock that stands still within a step: every poll takes no time.
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
