//! What the crate of a real robot needs: its trait, and time that passes by itself.
//!
//! A robot that is there implements [`Hardware`] beside the traits that its templates ask for. `[robot.hardware]` of a
//! project names it; `afpc run --robot hardware` and the programs of `afpc build` then drive it.
//!
//! ```
//! use afp_core::{Environment, Instant, Platform};
//! use afp_hardware::RealTime;
//!
//! struct Board { time: RealTime, /* and its connection */ }
//!
//! impl Environment for Board {
//!     fn stop(&mut self, _: Instant) { /* tells the wheels to stand */ }
//!     fn emergency_stop(&mut self) { /* takes their power */ }
//! }
//!
//! impl Platform for Board {
//!     type Clock = RealTime;
//!     fn clock(&self) -> RealTime { self.time }
//!     fn now(&self) -> Instant { self.time.now() }
//!     fn advance(&mut self, to: Instant) { self.time.sleep_until(to) }
//! }
//! # let mut board = Board { time: RealTime::start() };
//! # let to = board.now() + afp_core::Duration::from_millis(2);
//! # board.advance(to);
//! # assert!(board.now() >= to);
//! ```
#![forbid(unsafe_code)]

use std::thread;
use std::time::{Duration as Span, Instant as Wall};

use afp_core::{Clock, Duration, Instant};

pub use afp_session::{Hardware, LastResort, Robot, SampleRef, Samples, Settings};

/// Time that passes by itself, from the moment at which it was made. It never goes back, whatever is done to the clock
/// on the wall.
#[derive(Clone, Copy, Debug)]
pub struct RealTime {
    began: Wall,
}

impl RealTime {
    /// Begins to count, from zero.
    pub fn start() -> Self {
        RealTime { began: Wall::now() }
    }

    /// How much has passed.
    pub fn now(&self) -> Instant {
        let nanos = self.began.elapsed().as_nanos();
        Instant::from_nanos(u64::try_from(nanos).unwrap_or(u64::MAX))
    }

    /// Sleeps up to an instant; not at all where it has passed. It wakes late, by what the system needs, never early.
    pub fn sleep_until(&self, to: Instant) {
        loop {
            let left = to.since(self.now());
            if left == Duration::ZERO {
                return;
            }
            thread::sleep(Span::from_nanos(left.as_nanos()));
        }
    }
}

impl Clock for RealTime {
    fn now(&self, step: Instant) -> Instant {
        RealTime::now(self).max(step)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nobody_wakes_early() {
        let time = RealTime::start();
        for millis in [1, 3, 2] {
            let to = Instant::ZERO + Duration::from_millis(millis);
            time.sleep_until(to);
            assert!(time.now() >= to);
        }
        let future = time.now() + Duration::from_secs(5);
        assert_eq!(Clock::now(&time, future), future, "a step is never before its clock");
    }
}
