//! How punctual the control loop of a real robot is, and how long its steps take.
//!
//! Both are histograms of a fixed size, so the control thread allocates nothing for them.

use std::fmt;

use afp_core::{Duration, Instant};

/// Buckets for each doubling, so that a quantile is at most an eighth too large.
const PARTS: u32 = 8;
/// Doublings of a microsecond; longer durations share the last bucket.
const DOUBLINGS: u32 = 24;

/// The times of a control loop.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct LoopTimes {
    /// How late the loop woke up.
    pub late: Histogram,
    /// How long the steps took.
    pub steps: Histogram,
}

/// Counts of durations.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Histogram {
    counts: [u64; (PARTS * DOUBLINGS) as usize],
    /// The longest duration.
    pub worst: Duration,
}

impl LoopTimes {
    /// Counts a wake-up, if the loop has slept from `before` to its target.
    pub(crate) fn woke(&mut self, target: Instant, before: Instant, now: Instant) {
        if before < target && target <= now {
            self.late.note(now.since(target));
        }
    }
}

impl Default for Histogram {
    fn default() -> Self {
        Histogram { counts: [0; _], worst: Duration::ZERO }
    }
}

impl Histogram {
    /// Counts a duration.
    pub fn note(&mut self, duration: Duration) {
        self.worst = self.worst.max(duration);
        if let Some(count) = self.counts.get_mut(bucket(duration.as_nanos())) {
            *count += 1;
        }
    }

    /// The number of durations.
    pub fn count(&self) -> u64 {
        self.counts.iter().sum()
    }

    /// The end of the bucket below which this share of the durations lies, at most the longest.
    pub fn quantile(&self, share: f64) -> Duration {
        let wanted = (share * self.count() as f64).ceil() as u64;
        let mut seen = 0;
        let full = self.counts.iter().position(|count| {
            seen += count;
            seen >= wanted
        });
        full.map_or(self.worst, |full| Duration::from_nanos(end(full)).min(self.worst))
    }
}

impl fmt::Display for Histogram {
    /// `1203, p50 12 us, p99 85 us, worst 310 us`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [half, most, worst] = [self.quantile(0.5), self.quantile(0.99), self.worst]
            .map(|duration| (duration.as_nanos() as f64 / 1e3).round());
        write!(f, "{}, p50 {half} us, p99 {most} us, worst {worst} us", self.count())
    }
}

/// The bucket of a duration: its doublings of a microsecond, and the eighth after the last one.
fn bucket(nanos: u64) -> usize {
    let units = (nanos / (1000 / u64::from(PARTS))).max(u64::from(PARTS));
    let doublings = units.ilog2() - PARTS.ilog2();
    let part = (units >> doublings) as u32 - PARTS;
    (doublings.min(DOUBLINGS - 1) * PARTS + part) as usize
}

/// The end of a bucket in nanoseconds.
fn end(bucket: usize) -> u64 {
    let (doublings, part) = (bucket as u32 / PARTS, bucket as u32 % PARTS);
    (u64::from(PARTS + part + 1) * (1000 / u64::from(PARTS))) << doublings
}

#[cfg(test)]
mod tests {
    use super::{Duration, Histogram};

    #[test]
    fn quantiles_are_at_most_an_eighth_too_large() {
        let mut times = Histogram::default();
        (1..=1000).for_each(|us| times.note(Duration::from_micros(us)));
        for (share, micros) in [(0.5, 500.0), (0.9, 900.0), (0.99, 990.0)] {
            let found = times.quantile(share).as_nanos() as f64 / 1e3;
            assert!((micros..=micros * 1.125).contains(&found), "{share}: {found}");
        }
        assert_eq!(times.quantile(1.0), Duration::from_micros(1000));
        assert_eq!(times.to_string(), "1000, p50 512 us, p99 1000 us, worst 1000 us");
    }

    #[test]
    fn the_shortest_and_the_longest_durations_are_counted() {
        let mut times = Histogram::default();
        times.note(Duration::ZERO);
        times.note(Duration::from_secs(100_000));
        assert_eq!((times.count(), times.worst), (2, Duration::from_secs(100_000)));
        assert_eq!(times.quantile(0.5), Duration::from_nanos(1125));
    }
}
