//! The wall clock during a run on a real robot.
//!
//! The times of a log come from the steady clock, which nobody sets. Other programs use the wall
//! clock, which a time server or a user may set during the run.

use std::time::{Duration, Instant, SystemTime};

/// The time between two looks at the clocks.
const EVERY: Duration = Duration::from_secs(1);
/// A smaller change is a correction of the clock's rate, seconds.
const JUMP: f64 = 0.05;

/// Both clocks at one moment.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Clocks {
    wall: SystemTime,
    steady: Instant,
}

impl Clocks {
    pub(crate) fn now() -> Self {
        Clocks { wall: SystemTime::now(), steady: Instant::now() }
    }

    /// The next look at the clocks, if it is due.
    pub(crate) fn next(&self) -> Option<Self> {
        (self.steady.elapsed() >= EVERY).then(Clocks::now)
    }

    /// The jump of the wall clock since an earlier moment, in seconds; forwards is positive.
    pub(crate) fn jump_since(&self, before: &Clocks) -> Option<f64> {
        let wall = match self.wall.duration_since(before.wall) {
            Ok(forwards) => forwards.as_secs_f64(),
            Err(backwards) => -backwards.duration().as_secs_f64(),
        };
        let jump = wall - self.steady.duration_since(before.steady).as_secs_f64();
        (jump.abs() >= JUMP).then_some(jump)
    }
}

#[cfg(test)]
mod tests {
    use super::{Clocks, Duration};

    #[test]
    fn only_a_step_of_the_wall_clock_is_a_jump() {
        let before = Clocks::now();
        let second = Duration::from_secs(1);
        let later = |wall| Clocks { wall, steady: before.steady + second };
        let jump = |wall| later(wall).jump_since(&before).map(|jump| jump.round());
        assert_eq!(jump(before.wall + second), None);
        assert_eq!(jump(before.wall + second + Duration::from_millis(20)), None);
        assert_eq!(jump(before.wall + Duration::from_secs(3601)), Some(3600.0));
        assert_eq!(jump(before.wall - Duration::from_secs(59)), Some(-60.0));
    }
}
