//! Platforms: a simulator, a computer on a robot or a microcontroller, with its own way to let time pass.

use afp_types::Instant;

use crate::clock::Clock;
use crate::component::Environment;

/// An environment in which time passes.
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
    /// What times polls. It stands apart from the platform, which a step borrows.
    type Clock: Clock;

    /// The clock of this platform.
    fn clock(&self) -> Self::Clock;

    /// The instant up to which time has passed; a run begins here.
    fn now(&self) -> Instant;

    /// Lets time pass up to an instant: a simulator computes, a computer sleeps, a microcontroller waits for an
    /// interrupt. Time never goes back.
    fn advance(&mut self, to: Instant);

    /// No step is made before this instant: slow devices take computing time.
    fn ready(&self) -> Instant {
        Instant::ZERO
    }
}
