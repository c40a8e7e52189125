//! The robot's recent poses.
//!
//! A reading may arrive late, but it applies to the pose at its measurement. The odometry provides
//! that pose here.

use crate::devices::{Invalid, Motion, Reading};
use afp_core::{Duration, Instant};

/// Number of poses. They are at least `APART` apart except for the last two, so they cover 620 ms
/// and more, longer than a template waits for a reading.
const KEPT: usize = 32;
const APART: Duration = Duration::from_millis(20);
/// Motion is extrapolated for at most this long, the maximum age of current odometry.
const GUESSED: Duration = Duration::from_millis(100);

/// Position and heading in the odometry frame, metres and radians.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// Metres along the initial heading.
    pub x: f64,
    /// Metres to the left of the initial heading.
    pub y: f64,
    /// Radians.
    pub heading: f64,
}

impl From<Motion> for Pose {
    fn from(motion: Motion) -> Self {
        Pose { x: motion.x.si(), y: motion.y.si(), heading: motion.heading.si() }
    }
}

/// The latest poses of the odometry.
#[derive(Clone, Copy, Debug)]
pub struct History {
    /// The oldest pose is at `next`.
    poses: [Option<(Instant, Pose)>; KEPT],
    next: usize,
}

impl Default for History {
    fn default() -> Self {
        History::new()
    }
}

impl History {
    /// An empty history.
    pub const fn new() -> Self {
        History { poses: [None; KEPT], next: 0 }
    }

    /// Stores a reading of the odometry if it is valid and new. Call this at every poll.
    pub fn note(&mut self, reading: Reading<Motion>) {
        let Ok(motion) = reading.value else { return };
        let last = self.latest(1).map(|(time, _)| time);
        if last.is_some_and(|last| last >= reading.time) {
            return;
        }
        // A pose soon after its predecessor is replaced.
        let before = self.latest(2).map(|(time, _)| time);
        if last.zip(before).is_some_and(|(last, before)| last.since(before) < APART) {
            self.next = self.slot(1);
        }
        self.poses[self.next] = Some((reading.time, motion.into()));
        self.next = (self.next + 1) % KEPT;
    }

    /// The pose at an instant, interpolated between known poses.
    pub fn at(&self, when: Instant) -> Option<Pose> {
        let (mut before, mut after) = (None, None);
        for ago in 1..=KEPT {
            let Some((time, pose)) = self.latest(ago) else { break };
            if time <= when {
                before = Some((time, pose));
                break;
            }
            after = Some((time, pose));
        }
        let (time, from) = before?;
        let since = when.since(time);
        let Some((later, to)) = after else { return self.guessed(since) };
        let share = since.as_secs_f64() / later.since(time).as_secs_f64();
        let mix = |from: f64, to: f64| from + (to - from) * share;
        Some(Pose {
            x: mix(from.x, to.x),
            y: mix(from.y, to.y),
            heading: mix(from.heading, to.heading),
        })
    }

    /// The extrapolated pose at this time after the latest known pose.
    fn guessed(&self, since: Duration) -> Option<Pose> {
        let (time, to) = self.latest(1).filter(|_| since <= GUESSED)?;
        let Some((before, from)) = self.latest(2) else { return Some(to) };
        let share = since.as_secs_f64() / time.since(before).as_secs_f64();
        let on = |from: f64, to: f64| to + (to - from) * share;
        Some(Pose {
            x: on(from.x, to.x),
            y: on(from.y, to.y),
            heading: on(from.heading, to.heading),
        })
    }

    /// Adds the pose at the time of measurement to a reading; invalid if the pose is unknown.
    pub fn placed<T: Copy>(&self, reading: Reading<T>) -> Reading<(T, Pose)> {
        let pose = self.at(reading.time).ok_or(Invalid::NoAnswer);
        let value = reading.value.and_then(|value| pose.map(|pose| (value, pose)));
        Reading { time: reading.time, value }
    }

    /// The `ago`-th latest pose, counted from 1.
    fn latest(&self, ago: usize) -> Option<(Instant, Pose)> {
        self.poses.get(self.slot(ago)).copied().flatten()
    }

    fn slot(&self, ago: usize) -> usize {
        (self.next + KEPT - ago) % KEPT
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use afp_core::quantity::Angle;

    fn at(millis: u64) -> Instant {
        Instant::ZERO + Duration::from_millis(millis)
    }

    /// A robot that turns at a radian a second, noted every `every` milliseconds for two seconds.
    fn turning(every: u64) -> History {
        let mut history = History::new();
        for millis in (0..=2000).step_by(every as usize) {
            let heading = Angle::from_si(millis as f64 / 1000.0);
            history.note(Reading::valid(Motion { heading, ..Motion::default() }, at(millis)));
        }
        history
    }

    #[test]
    fn the_heading_history_covers_the_patience_for_readings() {
        for every in [2, 5, 10, 20, 40, 50] {
            let history = turning(every);
            for millis in 1490..=2000 {
                let pose = history.at(at(millis)).unwrap_or_else(|| panic!("{every} {millis}"));
                assert!((pose.heading - millis as f64 / 1000.0).abs() < 1e-9, "{every} {millis}");
            }
        }
    }

    #[test]
    fn an_unknown_pose_is_not_guessed() {
        assert_eq!(History::new().at(at(0)), None);
        let history = turning(5);
        assert_eq!(history.at(at(1000)), None, "forgotten");
        let guessed = history.at(at(2100)).expect("it goes on");
        assert!((guessed.heading - 2.1).abs() < 1e-9, "{guessed:?}");
        assert_eq!(history.at(at(2101)), None, "to come");
        let reading = Reading::valid(7, at(1000));
        assert_eq!(history.placed(reading).value, Err(Invalid::NoAnswer));
    }

    #[test]
    fn old_and_invalid_readings_are_not_stored() {
        let mut history = turning(5);
        let elsewhere = Motion { heading: Angle::from_si(9.0), ..Motion::default() };
        history.note(Reading::valid(elsewhere, at(2000)));
        history.note(Reading::invalid(Invalid::NoAnswer, at(2010)));
        let guessed = history.at(at(2020)).expect("it goes on");
        assert!((guessed.heading - 2.02).abs() < 1e-9, "{guessed:?}");
    }
}
