//! Clocks that time polls.
//!
//! The time of a step comes from whoever drives the scheduler and stands still within the step.
//! A clock only tells how long polls took.

use afp_types::Instant;

/// Tells the time within a step.
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
