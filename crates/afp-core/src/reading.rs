//! A measured value with its time and its validity.

use afp_types::{Duration, Instant};

/// Why a reading has no value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Invalid {
    /// The sensor has not measured yet.
    NotYet,
    /// The sensor delivered NaN or an infinite value.
    NotFinite,
    /// The sensor delivered a value that it cannot measure.
    OutOfRange,
    /// The sensor does not answer.
    NoAnswer,
    /// The sensor says exactly the same over and over, which what it measures cannot do.
    Frozen,
    /// The controller that reads the sensor has restarted since the run began.
    Restarted,
}

/// What a sensor says: a value or why there is none, and when that was measured.
///
/// There is no way to read the value of an invalid reading.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reading<T> {
    /// When it was measured, not when it was read.
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
