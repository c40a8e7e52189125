//! Driving towards what a sensor sees.

use crate::devices::{Navigator, Odometry, Reading};
use crate::helpers::guard::{Guard, NO_ODOMETRY, PATIENCE};
use crate::helpers::history::{History, Pose};
use crate::helpers::motion::wrap;
use crate::helpers::tracking::Tracking;
use afp_core::quantity::Speed;
use afp_core::{Fault, Instant};

/// It counts as reached when the distance left is less than this, metres.
const CLOSE: f64 = 0.005;
/// How sharply to steer: turn rate per radian off.
const STEER: f64 = 1.5;
/// The share of a new reading in what is steered by.
const NEWS: f64 = 0.4;

/// Steers by direction and distance left, smoothed, and stops where no distance is left.
///
/// What a reading says holds for where the robot was when it was measured; from there the odometry goes on.
#[derive(Clone, Debug)]
pub(crate) struct Approaching {
    speed: f64,
    tracking: Tracking,
    sensor: Guard,
    odometry: Guard,
    history: History,
    /// When the latest reading was measured.
    last_look: Instant,
    /// When it was seen last; the beginning counts as seen.
    seen: Instant,
    /// Smoothed; none before the first sight of it.
    target: Option<Target>,
    /// What the robot comes to a standstill for.
    ending: Option<Approached>,
}

/// What a sensor sees: where, radians against the heading, and the distance left to it, metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Sight {
    pub(crate) bearing: f64,
    pub(crate) distance: f64,
}

/// How it ended; the robot stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Approached {
    /// No distance is left.
    Reached,
    /// It has not been seen for [`PATIENCE`].
    Lost,
}

/// What is steered by: the heading towards it, radians, and the distance left from a place, metres.
#[derive(Clone, Copy, Debug)]
struct Target {
    heading: f64,
    distance: f64,
    from: Pose,
}

impl Approaching {
    /// `silent` is the fault of a sensor that says nothing usable.
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

    /// Goes on with what the sensor says now; none where it sees nothing.
    ///
    /// # Errors
    /// The sensor or the odometry is silent for too long, or the drive does not do what it is told.
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
        // Out of sight of it the robot waits: what was ahead may have gone anywhere.
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

    /// Takes in a new reading of the sensor, if it is one.
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

    /// What ends the approach, if something does.
    fn end(&self, target: Option<(Target, Pose)>) -> Option<Approached> {
        if target.is_some_and(|(target, here)| target.distance_from(here) < CLOSE) {
            return Some(Approached::Reached);
        }
        (self.last_look.since(self.seen) > PATIENCE).then_some(Approached::Lost)
    }
}

impl Target {
    /// The distance left from another place.
    fn distance_from(&self, place: Pose) -> f64 {
        let (sin, cos) = libm::sincos(self.heading);
        self.distance - (place.x - self.from.x) * cos - (place.y - self.from.y) * sin
    }

    /// With a share of something newer.
    fn mixed(&self, new: Target) -> Target {
        let distance = self.distance_from(new.from);
        Target {
            heading: self.heading + NEWS * wrap(new.heading - self.heading),
            distance: distance + NEWS * (new.distance - distance),
            from: new.from,
        }
    }
}
