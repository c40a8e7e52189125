//! Detects frozen sensors, which repeat a reading while the robot moves.
//!
//! Noise prevents exact repetition in a working sensor.

use crate::devices::{Echo, Motion, Reading};
use crate::helpers::guard::FROZEN_RANGE;
use crate::helpers::history::Pose;
use afp_core::quantity::Length;
use afp_core::{Fault, Instant};

/// Distance driven with identical readings, metres.
const WAY: f64 = 0.2;
/// Weight of a turn by a radian, metres: the sensor's view also changes with the heading.
const TURN: f64 = 0.2;
/// Fewest identical readings: a fast robot drives far between two readings.
const READINGS: u32 = 10;

/// Compares each new reading of a sensor with its predecessor.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Repeats<T> {
    fault: Fault,
    time: Instant,
    /// The repeated value; `None` without a measurement.
    same: Option<T>,
    /// Number of repetitions, and the distance driven meanwhile, metres.
    times: u32,
    way: f64,
    /// Pose at the last reading.
    last: Option<Pose>,
}

impl<T: Copy + PartialEq> Repeats<T> {
    /// `fault` is the fault of a frozen sensor.
    pub(crate) fn new(fault: Fault, now: Instant) -> Self {
        Repeats { fault, time: now, same: None, times: 0, way: 0.0, last: None }
    }

    /// Continues after a suspension, whose distance is not counted.
    pub(crate) fn resume(&mut self) {
        self.last = None;
    }

    /// Checks a sensor's reading against the odometry. `None`, silence or darkness, may repeat.
    /// Distance without odometry is not counted.
    ///
    /// # Errors
    /// The reading stayed identical while the robot moved.
    pub(crate) fn check(
        &mut self,
        reading: Reading<Option<T>>,
        counted: Reading<Motion>,
    ) -> Result<(), Fault> {
        let Ok(value) = reading.value else { return Ok(()) };
        if reading.time <= self.time {
            return Ok(());
        }
        self.time = reading.time;
        let Ok(motion) = counted.value else {
            self.last = None;
            return Ok(());
        };
        let (here, turn) = (Pose::from(motion), Length::from_si(TURN));
        let step = self.last.replace(here).map_or(0.0, |last| last.distance_to(&here, turn));
        if value.is_none() || value != self.same {
            (self.same, self.times, self.way) = (value, 0, 0.0);
            return Ok(());
        }
        self.times += 1;
        self.way += step;
        if self.times >= READINGS && self.way > WAY { Err(self.fault) } else { Ok(()) }
    }
}

impl Repeats<Length> {
    /// For the range sensor.
    pub(crate) fn of_echoes(now: Instant) -> Self {
        Repeats::new(FROZEN_RANGE, now)
    }

    /// [`Repeats::check`] for an echo's distance.
    ///
    /// # Errors
    /// [`FROZEN_RANGE`].
    pub(crate) fn check_echo(
        &mut self,
        Reading { time, value }: Reading<Echo>,
        counted: Reading<Motion>,
    ) -> Result<(), Fault> {
        self.check(Reading { time, value: value.map(|echo| echo.distance) }, counted)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::devices::Invalid;
    use afp_core::Duration;

    /// Checks `readings` readings, `step` metres apart; returns the index of the faulty reading.
    fn checked(readings: u32, step: f64, value: impl Fn(u32) -> Option<f64>) -> Option<u32> {
        let mut repeats = Repeats::new(FROZEN_RANGE, Instant::ZERO);
        (1..=readings).find(|n| {
            let at = Instant::ZERO + Duration::from_millis(50 * u64::from(*n));
            let x = Length::from_si(step * f64::from(*n));
            let counted = Reading::valid(Motion { x, ..Motion::default() }, at);
            let reading = Reading::valid(value(*n), at);
            let once = repeats.check(reading, counted);
            // Reading the same measurement twice is not a repetition.
            assert!(once.is_err() || repeats.check(reading, counted).is_ok());
            once.is_err()
        })
    }

    #[test]
    fn a_sensor_is_frozen_after_ten_equal_readings_in_twenty_centimetres() {
        assert_eq!(checked(100, 0.0101, |_| Some(1.0)), Some(21));
        assert_eq!(checked(100, -0.0101, |_| Some(1.0)), Some(21));
        assert_eq!(checked(100, 0.5, |_| Some(1.0)), Some(11));
    }

    #[test]
    fn silence_and_readings_of_a_stationary_robot_may_repeat() {
        assert_eq!(checked(100, 0.01, |_| None), None);
        assert_eq!(checked(100, 0.0, |_| Some(1.0)), None);
        assert_eq!(checked(100, 0.01, |n| Some(f64::from(n / 15))), None);
    }

    #[test]
    fn a_silent_odometry_counts_no_distance() {
        let mut repeats = Repeats::new(FROZEN_RANGE, Instant::ZERO);
        for n in 1..100 {
            let at = Instant::ZERO + Duration::from_millis(50 * n);
            let silent = Reading::invalid(Invalid::NoAnswer, at);
            assert_eq!(repeats.check(Reading::valid(Some(1.0), at), silent), Ok(()));
        }
    }
}
