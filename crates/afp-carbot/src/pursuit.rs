//! Driving along a path.

use crate::devices::{Belief, Localisation, Motion, Navigator, Odometry};
use crate::guard::{Guard, NO_ODOMETRY, NO_POSITION};
use crate::motion::{Ramp, wrap};
use crate::path::Path;
use crate::tracking::Tracking;
use afp_core::quantity::{Length, Speed};
use afp_core::{Duration, Fault, Instant};
use core::mem;

/// Speed is gained and lost at this many metres a second squared, and turn rate at so many radians.
const ACCELERATION: f64 = 0.5;
const TURN_ACCELERATION: f64 = 3.0;
/// How far ahead on the path the robot looks, metres.
const LOOK_AHEAD: f64 = 0.35;
/// Turned farther away from there than this the robot turns in place, until it is within the other one, radians.
const ASIDE: f64 = 0.9;
const ALONG: f64 = 0.15;
/// How fast it turns in place, radians a second.
const TURN: f64 = 0.8;
/// The end is reached when less of the way is left than this, metres.
const CLOSE: f64 = 0.01;
/// Farther from the path than this, or less certain of its place, the robot is not on it, metres.
const OFF: f64 = 0.6;
const UNCERTAIN: f64 = 1.0;
/// For so long it waits to know better.
const DOUBT: Duration = Duration::from_secs(1);

/// Keeps a robot on a path, by localisation (pure pursuit: Coulter, *Implementation of the pure pursuit path tracking
/// algorithm*, CMU-RI-TR-92-01, 1992). Where the path leads aside it stops and turns in place.
#[derive(Clone, Debug)]
pub(crate) struct Pursuit {
    speed: f64,
    tolerance: f64,
    ramp: Ramp,
    turning: Turning,
    tracking: Tracking,
    odometry: Guard,
    position: Guard,
    /// Since when the robot has not been on its path.
    doubt: Option<Instant>,
    /// Whether the robot has been told to drive.
    underway: bool,
    /// What the robot comes to a standstill for.
    ending: Option<Pursued>,
}

/// How it ended; the robot stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Pursued {
    /// At the end of the path.
    Arrived,
    /// The robot is not on the path, or does not know where it is.
    Lost,
}

/// Whether the robot turns in place.
#[derive(Clone, Copy, Debug)]
enum Turning {
    No,
    /// It comes to a standstill first.
    Braking,
    Yes(Ramp),
}

/// Where the robot is, by all that tells.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Here {
    pub(crate) motion: Motion,
    pub(crate) belief: Belief,
}

impl Pursuit {
    /// `tolerance` is how far from the end still counts as there.
    pub(crate) fn new(speed: Speed, tolerance: Length, now: Instant) -> Self {
        Pursuit {
            speed: speed.si(),
            tolerance: tolerance.si(),
            ramp: Ramp::new(ACCELERATION, now),
            turning: Turning::No,
            tracking: Tracking::new(),
            odometry: Guard::new(NO_ODOMETRY, now),
            position: Guard::new(NO_POSITION, now),
            doubt: None,
            underway: false,
            ending: None,
        }
    }

    /// Where the robot is; none while that is unknown, and then it is told to stand.
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
            self.halt(env, now);
        }
        Ok(here.map(|(motion, belief)| Here { motion, belief }))
    }

    /// Drives on along the path.
    ///
    /// # Errors
    /// The drive does not do what it is told.
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
            self.halt(env, now);
            return Ok(self.ending.filter(|_| here.motion.stands()));
        };
        self.turning = self.turning.next(aside, here, now);
        let command = match &mut self.turning {
            Turning::Braking => {
                self.halt(env, now);
                return Ok(None);
            }
            Turning::Yes(ramp) => {
                (0.0, ramp.rate((aside.abs() - ALONG / 2.0).max(0.0), TURN, now).copysign(aside))
            }
            Turning::No => {
                let speed = self.ramp.rate(rest, self.speed * libm::cos(aside), now);
                (speed, 2.0 * speed * libm::sin(aside) / LOOK_AHEAD)
            }
        };
        self.tracking.drive(env, &here.motion, command, now)?;
        Ok(None)
    }

    /// Where to steer, radians against the heading, and the way left; none where the robot has to stand.
    fn steer(&mut self, path: &Path, here: &Here, now: Instant) -> Option<(f64, f64)> {
        let at = [here.belief.x.si(), here.belief.y.si()];
        let end = path.end().map(|end| libm::hypot(end[0] - at[0], end[1] - at[1]));
        let known = here.belief.spread.si() <= UNCERTAIN;
        let Some((near, end)) =
            path.nearest(at).zip(end).filter(|(near, _)| known && near.off <= OFF)
        else {
            let since = *self.doubt.get_or_insert(now);
            if now.since(since) >= DOUBT {
                self.ending = self.ending.or(Some(Pursued::Lost));
            }
            return None;
        };
        self.doubt = None;
        // Who begins so near to the end is there; who comes from farther away drives on to the end itself.
        let begun = mem::replace(&mut self.underway, true);
        if !begun && near.rest.max(end) <= self.tolerance {
            self.ending = Some(Pursued::Arrived);
            return None;
        }
        // Beside the end of the path the way to it is no longer along the path.
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

    /// Commands a standstill; whoever drives on begins anew.
    pub(crate) fn halt<E: Navigator + ?Sized>(&mut self, env: &mut E, now: Instant) {
        self.tracking.halt(env, now);
        self.ramp = Ramp::new(ACCELERATION, now);
    }
}

impl Turning {
    fn next(self, aside: f64, here: &Here, now: Instant) -> Turning {
        match self {
            Turning::No if aside.abs() > ASIDE => Turning::Braking,
            Turning::Braking if here.motion.stands() => {
                Turning::Yes(Ramp::new(TURN_ACCELERATION, now))
            }
            Turning::Yes(_) if aside.abs() < ALONG => Turning::No,
            other => other,
        }
    }
}
