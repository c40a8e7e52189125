//! Driving towards a target that a sensor sees.

use crate::devices::{Navigator, Odometry, Reading};
use crate::helpers::guard::{Guard, NO_ODOMETRY, PATIENCE};
use crate::helpers::history::{History, Pose};
use crate::helpers::motion::wrap;
use crate::helpers::tracking::Tracking;
use afp_core::quantity::Speed;
use afp_core::{Duration, Fault, Instant};

/// The target is reached when the distance left is below this, metres.
const CLOSE: f64 = 0.005;
/// Turn rate per radian of error.
const STEER: f64 = 1.5;
/// Weight of a new reading in the smoothed target.
const NEWS: f64 = 0.4;

/// Steers by smoothed direction and distance, and stops when no distance is left.
///
/// A reading applies to the position at which it was measured; the odometry carries it on.
#[derive(Clone, Debug)]
pub(crate) struct Approaching {
    speed: f64,
    tracking: Tracking,
    sensor: Guard,
    odometry: Guard,
    history: History,
    /// Time of the latest reading.
    last_look: Instant,
    /// Time of the last sight; initially the start.
    seen: Instant,
    /// Smoothed; `None` before the first sight.
    target: Option<Target>,
    /// The outcome, reported when the robot has stopped.
    ending: Option<Approached>,
}

/// A sensor's view of the target: bearing in radians against the heading, distance left in metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Sight {
    pub(crate) bearing: f64,
    pub(crate) distance: f64,
}

/// The outcome; the robot has stopped.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Approached {
    /// No distance is left.
    Reached,
    /// Out of sight for [`PATIENCE`].
    Lost,
}

/// The smoothed target: heading towards it in radians, distance left from a place in metres.
#[derive(Clone, Copy, Debug)]
struct Target {
    heading: f64,
    distance: f64,
    from: Pose,
}

impl Approaching {
    /// `silent` is the fault of a sensor without usable readings.
    pub(crate) fn new<E>(speed: Speed, silent: Fault, env: &mut E, now: Instant) -> Self
    where
        E: Navigator + Odometry + ?Sized,
    {
        env.halt(now);
        let mut history = History::new();
        history.note(env.motion());
        Approaching {
            speed: speed.si(),
            tracking: Tracking::new(now),
            sensor: Guard::new(silent, now),
            odometry: Guard::new(NO_ODOMETRY, now),
            history,
            last_look: now,
            seen: now,
            target: None,
            ending: None,
        }
    }

    /// Continues after a suspension `away` ago. The target stays in place.
    pub(crate) fn resume(&mut self, now: Instant, away: Duration) {
        self.tracking = Tracking::new(now);
        self.sensor.restart(now);
        self.odometry.restart(now);
        self.last_look += away;
        self.seen += away;
    }

    /// Steers by the sensor's current reading; `None` in a reading means that nothing is in sight.
    ///
    /// # Errors
    /// The sensor or the odometry is silent for too long, or the drive does not follow its
    /// commands.
    pub(crate) fn poll<E>(
        &mut self,
        sight: Reading<Option<Sight>>,
        env: &mut E,
        now: Instant,
    ) -> Result<Option<Approached>, Fault>
    where
        E: Navigator + Odometry + ?Sized,
    {
        let counted = env.motion();
        self.history.note(counted);
        let motion = self.odometry.current(counted, now)?;
        self.look(sight, now)?;
        let target = self.target.zip(motion).map(|(target, motion)| (target, Pose::from(motion)));
        self.ending = self.ending.or_else(|| self.end(target));
        if self.ending.is_some() {
            self.tracking.halt(env, now);
            return Ok(self.ending.filter(|_| motion.is_some_and(|motion| motion.stands())));
        }
        // The robot waits while the target is out of sight.
        let in_sight = self.seen == self.last_look && !self.sensor.is_late(now);
        let sighted = target.filter(|_| in_sight).zip(motion);
        let Some(((target, here), motion)) = sighted else {
            self.tracking.halt(env, now);
            return Ok(None);
        };
        let bearing = wrap(target.heading - here.heading);
        let cruise = self.speed * libm::cos(bearing).max(0.0);
        let speed = self.tracking.speed(target.distance_from(here), cruise, now);
        self.tracking.drive(env, &motion, (speed, STEER * bearing), now)?;
        Ok(None)
    }

    /// Uses a reading of the sensor if it is new.
    fn look(&mut self, sight: Reading<Option<Sight>>, now: Instant) -> Result<(), Fault> {
        let reading = self.history.placed(sight);
        let Some((sight, then)) = self.sensor.next(reading, self.last_look, now)? else {
            return Ok(());
        };
        self.last_look = reading.time;
        let Some(Sight { bearing, distance }) = sight else { return Ok(()) };
        self.seen = reading.time;
        let new = Target { heading: then.heading + bearing, distance, from: then };
        self.target = Some(self.target.map_or(new, |old| old.mixed(new)));
        Ok(())
    }

    /// The outcome, if the approach ends now.
    fn end(&self, target: Option<(Target, Pose)>) -> Option<Approached> {
        if target.is_some_and(|(target, here)| target.distance_from(here) < CLOSE) {
            return Some(Approached::Reached);
        }
        (self.last_look.since(self.seen) > PATIENCE).then_some(Approached::Lost)
    }
}

impl Target {
    /// The distance left from `place`.
    fn distance_from(&self, place: Pose) -> f64 {
        let (sin, cos) = libm::sincos(self.heading);
        self.distance - (place.x - self.from.x) * cos - (place.y - self.from.y) * sin
    }

    /// Mixes in a new target by its weight.
    fn mixed(&self, new: Target) -> Target {
        let distance = self.distance_from(new.from);
        Target {
            heading: self.heading + NEWS * wrap(new.heading - self.heading),
            distance: distance + NEWS * (new.distance - distance),
            from: new.from,
        }
    }
}
