//! The sample times: multiples of each requested period, or the first possible instant after them.

use afp_core::{Duration, Instant};

/// The sample times.
#[derive(Clone, Copy, Debug)]
pub(super) struct SampleGrid {
    /// A hash of the periods.
    key: u64,
    /// The last sample time; earlier grid points count as done.
    taken: Option<Instant>,
    /// The next sample time.
    pub(super) next: Instant,
}

/// The time since the last samples.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Stretch {
    /// The begin, excluded; `None` for the first samples.
    after: Option<Instant>,
    to: Instant,
}

impl SampleGrid {
    /// The grid without periods.
    pub(super) const NONE: Self = SampleGrid { key: 0, taken: None, next: Instant::MAX };

    /// Sets the periods. After a change they count from now on; before the start, now itself is a
    /// sample time.
    #[inline]
    pub(super) fn fit(
        &mut self,
        periods: impl Iterator<Item = Duration> + Clone,
        now: Instant,
        started: bool,
    ) {
        let folded = |key: u64, every: Duration| key.rotate_left(7).wrapping_add(every.as_nanos());
        let key = periods.clone().fold(0, folded);
        if key != self.key {
            *self = SampleGrid::of(key, periods, now, started);
        }
    }

    #[cold]
    fn of(
        key: u64,
        mut periods: impl Iterator<Item = Duration>,
        now: Instant,
        started: bool,
    ) -> Self {
        match started {
            true => SampleGrid { key, taken: Some(now), next: next(periods, now) },
            false => {
                let next = periods.next().map_or(Instant::MAX, |_| now);
                SampleGrid { key, taken: None, next }
            }
        }
    }

    /// Notes samples at this instant and returns the time since the last ones.
    pub(super) fn take(
        &mut self,
        periods: impl Iterator<Item = Duration>,
        now: Instant,
    ) -> Stretch {
        self.next = next(periods, now);
        Stretch::between(self.taken.replace(now), now)
    }
}

impl Stretch {
    /// From one instant (excluded) to another.
    pub(crate) fn between(after: Option<Instant>, to: Instant) -> Self {
        Stretch { after, to }
    }

    /// Whether it contains a multiple of a period.
    pub(crate) fn has_multiple_of(self, every: Duration) -> bool {
        let passed = |at: Instant| at.since(Instant::ZERO).periods(every);
        self.after.is_none_or(|after| passed(after) < passed(self.to))
    }
}

/// The first multiple of any of the periods after `now`.
fn next(periods: impl Iterator<Item = Duration>, now: Instant) -> Instant {
    let after = |every: Duration| {
        let every = every.max(Duration::from_nanos(1));
        Instant::ZERO + every * now.since(Instant::ZERO).periods(every).saturating_add(1)
    };
    periods.map(after).min().unwrap_or(Instant::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(ms: u64) -> Instant {
        Instant::from_nanos(ms * 1_000_000)
    }

    /// The sample times of each period, if time advances to the instants of `stop`.
    fn taken(periods: &[u64], until: u64, stop: impl Fn(Instant) -> Instant) -> Vec<Vec<u64>> {
        let durations = periods.iter().map(|ms| Duration::from_millis(*ms));
        let mut grid = SampleGrid::NONE;
        grid.fit(durations.clone(), Instant::ZERO, false);
        let mut all = vec![Vec::new(); periods.len()];
        while grid.next <= at(until) {
            let now = stop(grid.next);
            let stretch = grid.take(durations.clone(), now);
            for (times, every) in all.iter_mut().zip(durations.clone()) {
                if stretch.has_multiple_of(every) {
                    times.push(now.as_nanos() / 1_000_000);
                }
            }
        }
        all
    }

    #[test]
    fn each_period_has_its_own_multiples() {
        let [seven, twenty] = &taken(&[7, 20], 60, |next| next)[..] else { panic!("two periods") };
        assert_eq!(*seven, [0, 7, 14, 21, 28, 35, 42, 49, 56]);
        assert_eq!(*twenty, [0, 20, 40, 60]);
    }

    #[test]
    fn a_multiple_inside_a_step_is_taken_at_its_end() {
        let late = |next: Instant| next + Duration::from_nanos(300_000);
        assert_eq!(taken(&[20], 60, late), [[0, 20, 40, 60]]);
        // Two grid points at once make one sample.
        let very_late = |next: Instant| next + Duration::from_millis(25);
        assert_eq!(taken(&[20], 60, very_late), [[25, 65]]);
    }

    #[test]
    fn a_late_start_waits_for_the_next_multiple() {
        let [seven, twenty] = [7, 20].map(Duration::from_millis);
        let mut grid = SampleGrid::NONE;
        grid.fit([twenty].into_iter(), Instant::ZERO, false);
        grid.take([twenty].into_iter(), at(0));
        grid.fit([twenty, seven].into_iter(), at(50), true);
        assert_eq!(grid.next, at(56));
        let stretch = grid.take([twenty, seven].into_iter(), at(56));
        assert!(stretch.has_multiple_of(seven) && !stretch.has_multiple_of(twenty));
        grid.fit([].into_iter(), at(57), true);
        assert_eq!(grid.next, Instant::MAX);
    }
}
