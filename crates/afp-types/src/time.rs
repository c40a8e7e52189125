//! Instants and durations in whole nanoseconds.
//!
//! Plans count time from the start of their run. All arithmetic saturates, at zero and at the
//! maximum, so no step can panic; a deadline at the maximum never comes.
//!
//! ```
//! use afp_types::{Duration, Instant};
//!
//! let mut at = Instant::ZERO + Duration::from_millis(20) * 3;
//! at += Duration::from_secs(1);
//! assert_eq!((at - Instant::ZERO).as_millis(), 1_060);
//! assert_eq!(at - Duration::from_secs(2), Instant::ZERO);
//! assert_eq!(Duration::from_secs(1).periods(Duration::from_millis(300)), 3);
//! assert_eq!(Duration::from(core::time::Duration::MAX), Duration::MAX);
//! ```

use core::fmt;
use core::ops::{Add, AddAssign, Mul, Sub, SubAssign};

/// A point in time, in nanoseconds since the clock's zero.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Instant(u64);

/// A duration in nanoseconds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Duration(u64);

impl Instant {
    /// The clock's zero.
    pub const ZERO: Instant = Instant(0);
    /// The last instant; nothing is ever due after it.
    pub const MAX: Instant = Instant(u64::MAX);

    /// The instant `nanos` nanoseconds after zero.
    pub const fn from_nanos(nanos: u64) -> Self {
        Instant(nanos)
    }

    /// Nanoseconds since zero.
    pub const fn as_nanos(self) -> u64 {
        self.0
    }

    /// Seconds since zero.
    pub fn as_secs_f64(self) -> f64 {
        Duration(self.0).as_secs_f64()
    }

    /// Time since `earlier`, zero if that is later.
    pub const fn since(self, earlier: Instant) -> Duration {
        Duration(self.0.saturating_sub(earlier.0))
    }
}

impl Duration {
    /// No time.
    pub const ZERO: Duration = Duration(0);
    /// The longest duration.
    pub const MAX: Duration = Duration(u64::MAX);

    /// A duration in nanoseconds.
    pub const fn from_nanos(nanos: u64) -> Self {
        Duration(nanos)
    }

    /// A duration in microseconds.
    pub const fn from_micros(micros: u64) -> Self {
        Duration(micros.saturating_mul(1_000))
    }

    /// A duration in milliseconds.
    pub const fn from_millis(millis: u64) -> Self {
        Duration(millis.saturating_mul(1_000_000))
    }

    /// A duration in seconds.
    pub const fn from_secs(secs: u64) -> Self {
        Duration(secs.saturating_mul(1_000_000_000))
    }

    /// A duration in seconds, to the nearest nanosecond; negative and NaN count as zero.
    ///
    /// All conversions of seconds to nanoseconds use this function.
    pub fn from_secs_f64(secs: f64) -> Self {
        let nanos = secs * 1e9;
        // A float cast saturates and converts NaN to zero.
        let below = nanos as u64;
        Duration(below.saturating_add(u64::from(nanos - below as f64 >= 0.5)))
    }

    /// Nanoseconds.
    pub const fn as_nanos(self) -> u64 {
        self.0
    }

    /// Whole milliseconds.
    pub const fn as_millis(self) -> u64 {
        self.0 / 1_000_000
    }

    /// Number of whole periods in the duration; a period of zero counts as one nanosecond.
    pub const fn periods(self, period: Duration) -> u64 {
        match self.0.checked_div(period.0) {
            Some(periods) => periods,
            None => self.0,
        }
    }

    /// Seconds.
    pub fn as_secs_f64(self) -> f64 {
        self.0 as f64 / 1e9
    }
}

impl Add<Duration> for Instant {
    type Output = Instant;
    fn add(self, span: Duration) -> Instant {
        Instant(self.0.saturating_add(span.0))
    }
}

impl AddAssign<Duration> for Instant {
    fn add_assign(&mut self, span: Duration) {
        *self = *self + span;
    }
}

impl Sub<Duration> for Instant {
    type Output = Instant;
    fn sub(self, span: Duration) -> Instant {
        Instant(self.0.saturating_sub(span.0))
    }
}

impl Sub<Instant> for Instant {
    type Output = Duration;
    fn sub(self, earlier: Instant) -> Duration {
        self.since(earlier)
    }
}

impl From<Duration> for core::time::Duration {
    fn from(duration: Duration) -> Self {
        core::time::Duration::from_nanos(duration.0)
    }
}

impl From<core::time::Duration> for Duration {
    /// Longer durations become [`Duration::MAX`].
    fn from(duration: core::time::Duration) -> Self {
        Duration(u64::try_from(duration.as_nanos()).unwrap_or(u64::MAX))
    }
}

impl Add for Duration {
    type Output = Duration;
    fn add(self, other: Duration) -> Duration {
        Duration(self.0.saturating_add(other.0))
    }
}

impl AddAssign for Duration {
    fn add_assign(&mut self, other: Duration) {
        *self = *self + other;
    }
}

impl Sub for Duration {
    type Output = Duration;
    fn sub(self, other: Duration) -> Duration {
        Duration(self.0.saturating_sub(other.0))
    }
}

impl SubAssign for Duration {
    fn sub_assign(&mut self, other: Duration) {
        *self = *self - other;
    }
}

impl Mul<u64> for Duration {
    type Output = Duration;
    fn mul(self, times: u64) -> Duration {
        Duration(self.0.saturating_mul(times))
    }
}

impl fmt::Display for Instant {
    /// Seconds with at least six decimals, and nine if needed: `1.250000`, `0.000000125`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(&Duration(self.0), f)
    }
}

impl fmt::Display for Duration {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (secs, nanos) = (self.0 / 1_000_000_000, self.0 % 1_000_000_000);
        match nanos % 1_000 {
            0 => write!(f, "{secs}.{:06}", nanos / 1_000),
            _ => write!(f, "{secs}.{nanos:09}"),
        }
    }
}
