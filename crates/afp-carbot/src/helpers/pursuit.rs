//! Driving along a path.

use crate::devices::{Belief, Localisation, Motion, Navigator, Odometry};
use crate::helpers::guard::{Guard, NO_ODOMETRY, NO_POSITION};
use crate::helpers::motion::wrap;
use crate::helpers::tracking::Tracking;
use crate::objects::path::{Nearest, Path};
use afp_core::quantity::{Length, Speed};
use afp_core::{Duration, Fault, Instant};
use core::mem;

/// Look-ahead distance along the path, metres.
const LOOK_AHEAD: f64 = 0.35;
/// The robot turns in place above the angle `ASIDE` to its target, until it is below `ALONG`,
/// radians.
const ASIDE: f64 = 0.9;
const ALONG: f64 = 0.15;
/// Turn rate in place, radians a second.
const TURN: f64 = 0.8;
/// Tolerance of the final heading, radians.
const STRAIGHT: f64 = 0.03;
/// The end is reached when less than this is left, metres.
const CLOSE: f64 = 0.01;
/// The robot is off the path at a greater distance or position uncertainty than this, metres.
const OFF: f64 = 0.6;
const UNCERTAIN: f64 = 1.0;
/// How long the robot waits before it is lost.
const DOUBT: Duration = Duration::from_secs(1);

/// Keeps a robot on a path by localisation: pure pursuit (Coulter, *Implementation of the pure
/// pursuit path tracking algorithm*, CMU-RI-TR-92-01, 1992). At sharp bends it stops and turns in
/// place.
#[derive(Clone, Debug)]
pub(crate) struct Pursuit {
    speed: f64,
    tolerance: f64,
    turning: Turning,
    tracking: Tracking,
    odometry: Guard,
    position: Guard,
    /// Time at which the robot left its path.
    doubt: Option<Instant>,
    /// Whether a drive was commanded.
    underway: bool,
    /// The outcome, reported when the robot has stopped.
    ending: Option<Pursued>,
}

/// The outcome; the robot has stopped.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Pursued {
    /// At the end of the path.
    Arrived,
    /// The robot is off the path or does not know its position.
    Lost,
}

/// Whether the robot turns in place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Turning {
    No,
    /// Stops before the turn.
    Braking,
    Yes,
}

/// The robot's pose by odometry and by localisation.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Here {
    pub(crate) motion: Motion,
    pub(crate) belief: Belief,
}

impl Pursuit {
    /// `tolerance` is the accepted distance from the end.
    pub(crate) fn new(speed: Speed, tolerance: Length, now: Instant) -> Self {
        Pursuit {
            speed: speed.si(),
            tolerance: tolerance.si(),
            turning: Turning::No,
            tracking: Tracking::new(now),
            odometry: Guard::new(NO_ODOMETRY, now),
            position: Guard::new(NO_POSITION, now),
            doubt: None,
            underway: false,
            ending: None,
        }
    }

    /// Continues after a suspension. The path stays in place.
    pub(crate) fn resume(&mut self, now: Instant) {
        self.tracking = Tracking::new(now);
        self.odometry.restart(now);
        self.position.restart(now);
        self.doubt = None;
    }

    /// The robot's pose. While it is unknown, returns `None` and stops the drive.
    ///
    /// # Errors
    /// Odometry or localisation is silent for too long.
    pub(crate) fn locate<E>(&mut self, env: &mut E, now: Instant) -> Result<Option<Here>, Fault>
    where
        E: Navigator + Odometry + Localisation + ?Sized,
    {
        let motion = self.odometry.current(env.motion(), now)?;
        let belief = env.belief(now)?;
        let here = motion.zip(self.position.current(belief, now)?);
        if here.is_none() {
            self.tracking.halt(env, now);
        }
        Ok(here.map(|(motion, belief)| Here { motion, belief }))
    }

    /// Drives on along the path.
    ///
    /// # Errors
    /// The drive does not follow its commands.
    pub(crate) fn poll<E>(
        &mut self,
        path: &Path,
        here: &Here,
        env: &mut E,
        now: Instant,
    ) -> Result<Option<Pursued>, Fault>
    where
        E: Navigator + ?Sized,
    {
        let steer = self.steer(path, here, now);
        let Some((aside, rest)) = steer.filter(|_| self.ending.is_none()) else {
            self.tracking.halt(env, now);
            return Ok(self.ending.filter(|_| here.motion.stands()));
        };
        let turning = self.turning.next(aside, here);
        if [mem::replace(&mut self.turning, turning), turning].contains(&Turning::Braking) {
            self.tracking.halt(env, now);
            return Ok(None);
        }
        let command = if turning == Turning::Yes {
            let rest = (aside.abs() - ALONG / 2.0).max(0.0).copysign(aside);
            (0.0, self.tracking.turn(rest, TURN, now))
        } else {
            let speed = self.tracking.speed(rest, self.speed * libm::cos(aside), now);
            (speed, 2.0 * speed * libm::sin(aside) / LOOK_AHEAD)
        };
        self.tracking.drive(env, &here.motion, command, now)?;
        Ok(None)
    }

    /// Turns in place at the end of the path to a heading on the map, radians.
    ///
    /// # Errors
    /// The drive does not follow its commands.
    pub(crate) fn face<E>(
        &mut self,
        heading: f64,
        (path, here): (&Path, &Here),
        env: &mut E,
        now: Instant,
    ) -> Result<Option<Pursued>, Fault>
    where
        E: Navigator + ?Sized,
    {
        let left = wrap(heading - here.belief.heading.si());
        let is_on = self.on_path(path, here, now).is_some();
        let is_lost = self.ending == Some(Pursued::Lost);
        if is_on && !is_lost && left.abs() >= STRAIGHT {
            let rate = self.tracking.turn(left, TURN, now);
            self.tracking.drive(env, &here.motion, (0.0, rate), now)?;
            return Ok(None);
        }
        self.tracking.halt(env, now);
        Ok(self.ending.filter(|_| (is_on || is_lost) && here.motion.stands()))
    }

    /// The direction to steer, radians against the heading, and the distance left; `None` if the
    /// robot must stop.
    fn steer(&mut self, path: &Path, here: &Here, now: Instant) -> Option<(f64, f64)> {
        let at = here.place();
        let near = self.on_path(path, here, now)?;
        let end = path.end().map(|end| libm::hypot(end[0] - at[0], end[1] - at[1]))?;
        // A robot that starts within the tolerance has arrived; otherwise it drives to the end
        // itself.
        let begun = mem::replace(&mut self.underway, true);
        if !begun && near.rest.max(end) <= self.tolerance {
            self.ending = Some(Pursued::Arrived);
            return None;
        }
        // Next to the path's end, the robot drives straight to the end.
        let (aim, rest) = if near.rest > CLOSE {
            (path.place(near.rest - LOOK_AHEAD)?, near.rest)
        } else if end > self.tolerance {
            (path.end()?, end)
        } else {
            self.ending = self.ending.or(Some(Pursued::Arrived));
            return None;
        };
        let towards = libm::atan2(aim[1] - at[1], aim[0] - at[0]);
        Some((wrap(towards - here.belief.heading.si()), rest))
    }

    /// The nearest point of the path; `None` if the robot is off the path or its position is
    /// unknown. After [`DOUBT`] it is lost.
    fn on_path(&mut self, path: &Path, here: &Here, now: Instant) -> Option<Nearest> {
        let known = here.belief.spread.si() <= UNCERTAIN;
        let near = path.nearest(here.place()).filter(|near| known && near.off <= OFF);
        if near.is_some() {
            self.doubt = None;
        } else if now.since(*self.doubt.get_or_insert(now)) >= DOUBT {
            self.ending = Some(Pursued::Lost);
        }
        near
    }
}

impl Here {
    fn place(&self) -> [f64; 2] {
        [self.belief.x.si(), self.belief.y.si()]
    }
}

impl Turning {
    fn next(self, aside: f64, here: &Here) -> Turning {
        match self {
            Turning::No if aside.abs() > ASIDE => Turning::Braking,
            Turning::Braking if here.motion.stands() => Turning::Yes,
            Turning::Yes if aside.abs() < ALONG => Turning::No,
            other => other,
        }
    }
}
