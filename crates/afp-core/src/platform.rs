//! Platforms (simulator, robot computer, microcontroller) and how time passes on them.

use afp_types::Instant;

use crate::clock::Clock;
use crate::component::Environment;

/// An environment with time.
///
/// ```
/// use afp_core::{Environment, Instant, Platform, StillClock};
///
/// struct Toy { now: Instant, moves: bool }
///
/// impl Environment for Toy {
///     fn stop(&mut self, _: Instant) { self.moves = false }
///     fn emergency_stop(&mut self) { self.moves = false }
/// }
///
/// impl Platform for Toy {
///     type Clock = StillClock;
///     fn clock(&self) -> StillClock { StillClock }
///     fn now(&self) -> Instant { self.now }
///     fn advance(&mut self, to: Instant) { self.now = self.now.max(to) }
/// }
/// ```
pub trait Platform: Environment {
    /// Times polls. It is separate from the platform, which a step borrows.
    type Clock: Clock;

    /// Returns the clock.
    fn clock(&self) -> Self::Clock;

    /// The current instant; a run begins here.
    fn now(&self) -> Instant;

    /// Advances to an instant: a simulator computes, a computer sleeps, a microcontroller waits for
    /// an interrupt. Time never goes back.
    fn advance(&mut self, to: Instant);

    /// Earliest instant of the next step: slow devices take computing time.
    fn ready(&self) -> Instant {
        Instant::ZERO
    }
}
