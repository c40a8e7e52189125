//! The clock of a real robot.

use std::thread;
use std::time::Duration as Span;
#[cfg(not(target_os = "linux"))]
use std::time::Instant as Wall;

use afp_core::{Clock, Duration, Instant};

/// Real time since the start of this clock. Changes of the system time do not affect it. On Linux it
/// also counts while the computer is suspended, so that a run notices the suspension.
#[derive(Clone, Copy, Debug)]
pub struct RealTime {
    /// The start, as time since the boot.
    #[cfg(target_os = "linux")]
    began: Span,
    #[cfg(not(target_os = "linux"))]
    began: Wall,
}

#[cfg(target_os = "linux")]
impl RealTime {
    /// Starts the clock at zero.
    pub fn start() -> Self {
        RealTime { began: boot_time() }
    }

    /// The time since the start.
    pub fn now(&self) -> Instant {
        Instant::ZERO + boot_time().saturating_sub(self.began).into()
    }

    /// Sleeps until an instant. The deadline is absolute, so a delay before the sleep does not add to
    /// it.
    fn sleep(&self, to: Instant) {
        use rustix::io::Errno;
        use rustix::thread::{ClockId, clock_nanosleep_absolute};

        let until = self.began.saturating_add(to.since(Instant::ZERO).into());
        let slept =
            until.try_into().map(|until| clock_nanosleep_absolute(ClockId::Boottime, &until));
        // A signal ends the sleep; the caller repeats it.
        if !matches!(slept, Ok(Ok(()) | Err(Errno::INTR))) {
            thread::sleep(to.since(self.now()).into());
        }
    }
}

/// The time since the boot, including suspensions.
#[cfg(target_os = "linux")]
fn boot_time() -> Span {
    use rustix::time::{ClockId, clock_gettime};

    let time = clock_gettime(ClockId::Boottime);
    time.try_into().unwrap_or_default()
}

#[cfg(not(target_os = "linux"))]
impl RealTime {
    /// Starts the clock at zero.
    pub fn start() -> Self {
        RealTime { began: Wall::now() }
    }

    /// The time since the start.
    pub fn now(&self) -> Instant {
        Instant::ZERO + self.began.elapsed().into()
    }

    fn sleep(&self, to: Instant) {
        thread::sleep(to.since(self.now()).into());
    }
}

impl RealTime {
    /// Sleeps until an instant, at least; returns at once if it has passed.
    pub fn sleep_until(&self, to: Instant) {
        while to.since(self.now()) > Duration::ZERO {
            self.sleep(to);
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
    fn no_sleep_ends_early() {
        let time = RealTime::start();
        for millis in [1, 3, 2] {
            let to = Instant::ZERO + Duration::from_millis(millis);
            time.sleep_until(to);
            assert!(time.now() >= to);
        }
        let future = time.now() + Duration::from_secs(5);
        assert_eq!(Clock::now(&time, future), future, "a step is never before its clock");
    }

    #[test]
    fn it_runs_as_fast_as_the_clock_of_the_standard_library() {
        let before = std::time::Instant::now();
        let time = RealTime::start();
        let after = std::time::Instant::now();
        thread::sleep(Span::from_millis(20));
        let at_least = after.elapsed();
        let passed: Span = time.now().since(Instant::ZERO).into();
        assert!((at_least..=before.elapsed()).contains(&passed), "{passed:?}, {at_least:?}");
    }
}
