//! Speed profiles with gentle start and end.

use afp_core::{Duration, Instant};

/// Metres a second squared.
pub(crate) const ACCELERATION: f64 = 0.5;
/// Radians a second squared.
pub(crate) const TURN_ACCELERATION: f64 = 3.0;

/// A speed that ramps up, holds, and ramps down before the end of a known distance.
///
/// Works for lengths and angles.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ramp {
    rate: f64,
    acceleration: f64,
    last: Instant,
}

/// Maximum rate near the end, as a share of the rest per second; prevents overshoot from the
/// motors' lag.
const APPROACH: f64 = 5.0;

/// Longest time that a gap between polls counts, so that a late poll does not jerk.
const LONGEST_GAP: Duration = Duration::from_millis(50);

impl Ramp {
    /// Starts from standstill.
    pub(crate) fn new(acceleration: f64, now: Instant) -> Self {
        Ramp { rate: 0.0, acceleration, last: now }
    }

    /// The rate for now with `rest` to go; never negative.
    pub(crate) fn rate(&mut self, rest: f64, cruise: f64, now: Instant) -> f64 {
        let gap = now.since(self.last).min(LONGEST_GAP).as_secs_f64();
        self.last = now;
        let rest = rest.max(0.0);
        let braking = libm::sqrt(2.0 * self.acceleration * rest);
        self.rate =
            (self.rate + self.acceleration * gap).min(cruise).min(braking).min(APPROACH * rest);
        self.rate
    }
}

/// Wraps `angle` to within half a turn of zero.
pub(crate) fn wrap(angle: f64) -> f64 {
    let turns = libm::round(angle / core::f64::consts::TAU);
    angle - turns * core::f64::consts::TAU
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ramp_drives_the_distance_and_stops_at_its_end() {
        let mut now = Instant::ZERO;
        let mut ramp = Ramp::new(0.5, now);
        let (mut driven, mut fastest, mut last) = (0.0, 0.0_f64, 0.0_f64);
        for _ in 0..600 {
            now += Duration::from_millis(10);
            let rate = ramp.rate(1.0 - driven, 0.2, now);
            assert!(rate - last <= 0.5 * 0.01 + 1e-12, "jerk at {now}");
            (fastest, last) = (fastest.max(rate), rate);
            driven += rate * 0.01;
        }
        assert_eq!(fastest, 0.2);
        assert!((driven - 1.0).abs() < 0.001, "{driven}");
    }

    #[test]
    fn wrapped_angles_are_within_half_a_turn() {
        assert!((wrap(4.0) - (4.0 - core::f64::consts::TAU)).abs() < 1e-12);
        assert_eq!(wrap(-3.0), -3.0);
    }
}
