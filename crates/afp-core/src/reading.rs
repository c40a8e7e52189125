//! Measured values with time and validity.

use afp_types::{Duration, Instant};

/// Reason why a reading has no value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Invalid {
    /// The sensor has not measured yet.
    NotYet,
    /// The sensor delivered NaN or an infinite value.
    NotFinite,
    /// The sensor delivered a value outside its range.
    OutOfRange,
    /// The sensor does not answer.
    NoAnswer,
    /// The sensor repeats exactly the same value, which noise excludes for a working sensor.
    Frozen,
    /// The sensor's controller has restarted since the run began.
    Restarted,
}

/// A sensor reading: a value, or the reason why there is none, and the time of the measurement.
///
/// The value of an invalid reading cannot be accessed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reading<T> {
    /// Time of the measurement, not of the access.
    pub time: Instant,
    /// The value, if it is valid.
    pub value: Result<T, Invalid>,
}

impl<T: Copy> Reading<T> {
    /// A valid reading.
    pub const fn valid(value: T, time: Instant) -> Self {
        Reading { time, value: Ok(value) }
    }

    /// A reading without a value.
    pub const fn invalid(reason: Invalid, time: Instant) -> Self {
        Reading { time, value: Err(reason) }
    }

    /// The value, unless it is invalid or older than `max_age`.
    pub fn fresh(&self, now: Instant, max_age: Duration) -> Option<T> {
        self.value.ok().filter(|_| now.since(self.time) <= max_age)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_old_or_invalid_reading_has_no_fresh_value() {
        let age = Duration::from_millis(10);
        let (then, now) = (Instant::from_nanos(0), Instant::from_nanos(10_000_000));
        assert_eq!(Reading::valid(7, then).fresh(now, age), Some(7));
        assert_eq!(Reading::valid(7, then).fresh(now + Duration::from_nanos(1), age), None);
        assert_eq!(Reading::<u8>::invalid(Invalid::NoAnswer, now).fresh(now, age), None);
    }
}
