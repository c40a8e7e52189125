//! The monotonic clock of a real robot.

use std::thread;
use std::time::Instant as Wall;

use afp_core::{Clock, Duration, Instant};

/// Monotonic time since its creation, independent of changes to the system's clock.
#[derive(Clone, Copy, Debug)]
pub struct RealTime {
    began: Wall,
}

impl RealTime {
    /// Starts at zero.
    pub fn start() -> Self {
        RealTime { began: Wall::now() }
    }

    /// The time since the start.
    pub fn now(&self) -> Instant {
        Instant::ZERO + self.began.elapsed().into()
    }

    /// Sleeps until an instant; returns at once if it has passed. It may wake late, never early.
    pub fn sleep_until(&self, to: Instant) {
        loop {
            let left = to.since(self.now());
            if left == Duration::ZERO {
                return;
            }
            thread::sleep(left.into());
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
