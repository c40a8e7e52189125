//! How punctual the control loop of a real robot is, and how long its calls and reactions take.
//!
//! All are histograms of a fixed size, so the control thread allocates nothing for them.

use std::collections::BTreeMap;
use std::fmt::{self, Write};

use afp_core::trace::{ComponentId, Names};
use afp_core::{Duration, Instant};

/// Buckets for each doubling, so that a quantile is at most an eighth too large.
const PARTS: u32 = 8;
/// Doublings of a microsecond; longer durations share the last bucket.
const DOUBLINGS: u32 = 24;

/// The times of a control loop.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct LoopTimes {
    /// How late the loop woke up.
    pub late: Histogram,
    /// How long the steps took.
    pub steps: Histogram,
    /// How long the calls of each component took: start, poll, interruption. With the scheduler's
    /// work up to the next call.
    pub calls: Box<[Histogram]>,
    /// The time from an event of each supervisor to the end of the step that reacts to it. The event
    /// is counted from the poll before, which did not find it, so no event waited longer.
    pub reactions: Box<[Histogram]>,
}

/// Counts of durations.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Histogram {
    counts: [u64; (PARTS * DOUBLINGS) as usize],
    /// The longest duration.
    pub worst: Duration,
}

/// The prefixes of the facts of a log with histograms.
const LATE: &str = "times.late";
const STEPS: &str = "times.steps";
const CALLS: &str = "times.calls.";
const REACTIONS: &str = "times.reactions.";

impl LoopTimes {
    /// Times of zero for so many components.
    pub(crate) fn new(components: u32) -> Self {
        let all = || vec![Histogram::default(); components as usize].into_boxed_slice();
        LoopTimes { calls: all(), reactions: all(), ..LoopTimes::default() }
    }

    /// The histograms that are not empty, as facts of a log.
    pub fn facts(&self, names: &dyn Names) -> Vec<(String, String)> {
        let path = |id| names.component(id).path.to_owned();
        let mut all = vec![(LATE.to_owned(), &self.late), (STEPS.to_owned(), &self.steps)];
        for (prefix, histograms) in [(CALLS, &self.calls), (REACTIONS, &self.reactions)] {
            let named = (0..).map(ComponentId).zip(histograms);
            all.extend(named.map(|(id, times)| (format!("{prefix}{}", path(id)), times)));
        }
        let told = all.into_iter().filter(|(_, times)| times.count() > 0);
        told.map(|(name, times)| (name, times.text())).collect()
    }

    /// The times of the facts of a log; `None` if they are not in it.
    pub fn of_facts(facts: &BTreeMap<String, String>, names: &dyn Names) -> Option<Self> {
        let read = |name: &str| facts.get(name).map(|text| Histogram::of_text(text));
        let mut times = LoopTimes::new(names.components());
        times.late = read(LATE)?;
        times.steps = read(STEPS).unwrap_or_default();
        for (prefix, histograms) in [(CALLS, &mut times.calls), (REACTIONS, &mut times.reactions)] {
            for (id, times) in (0..).map(ComponentId).zip(histograms) {
                *times = read(&format!("{prefix}{}", names.component(id).path)).unwrap_or_default();
            }
        }
        Some(times)
    }

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

    /// The ends of the buckets that are not empty, and their counts.
    pub fn buckets(&self) -> impl Iterator<Item = (Duration, u64)> {
        let all = self.counts.iter().enumerate().filter(|(_, count)| **count > 0);
        all.map(|(bucket, count)| (Duration::from_nanos(end(bucket)), *count))
    }

    /// Adds the durations of another histogram.
    pub fn add(&mut self, other: &Histogram) {
        self.worst = self.worst.max(other.worst);
        self.counts.iter_mut().zip(&other.counts).for_each(|(count, more)| *count += more);
    }

    /// The longest duration, then the end of each bucket with its count, in nanoseconds:
    /// `1234567 1125:20 1250:31`.
    fn text(&self) -> String {
        let mut text = self.worst.as_nanos().to_string();
        for (end, count) in self.buckets() {
            // Writing to a `String` cannot fail.
            let _ = write!(text, " {}:{count}", end.as_nanos());
        }
        text
    }

    /// Reads such a text; parts that are damaged do not count.
    fn of_text(text: &str) -> Self {
        let (worst, buckets) = text.split_once(' ').unwrap_or((text, ""));
        let worst = Duration::from_nanos(worst.parse().unwrap_or_default());
        let mut read = Histogram { worst, ..Histogram::default() };
        let pairs = buckets.split(' ').filter_map(|pair| pair.split_once(':'));
        for (end, count) in
            pairs.filter_map(|(end, count)| end.parse::<u64>().ok().zip(count.parse().ok()))
        {
            if let Some(known) = read.counts.get_mut(bucket(end.saturating_sub(1))) {
                *known = count;
            }
        }
        read
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
    fn a_histogram_is_read_back_from_its_text() {
        let mut times = Histogram::default();
        (0..5000).for_each(|n| times.note(Duration::from_nanos(n * n * 37)));
        assert_eq!(Histogram::of_text(&times.text()), times);
        assert_eq!(Histogram::of_text("x 1:y :"), Histogram::default());
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
