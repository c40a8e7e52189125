//! Turning by an angle, in place or along an arc.

use crate::devices::{Motion, Odometry};
use crate::helpers::guard::{Guard, NO_ODOMETRY};
use afp_core::quantity::Angle;
use afp_core::{Fault, Instant};

/// A turn in place is complete when less than this is left, radians.
pub(crate) const CLOSE: f64 = 0.005;

/// An angle to turn from the initial heading, by odometry.
#[derive(Clone, Debug)]
pub(crate) struct Turning {
    angle: f64,
    close: f64,
    odometry: Guard,
    /// The initial heading; `None` until the first reading.
    from: Option<Angle>,
}

/// Progress of a turn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Progress {
    /// No odometry: the robot must wait.
    Unknown,
    /// Radians left (negative: right), and the current motion.
    Left(f64, Motion),
    /// The angle has been turned; `stands` if the robot has stopped.
    Turned { by: Angle, stands: bool },
}

impl Turning {
    /// Begins at `now`; the turn is complete when less than `close` is left, radians.
    ///
    /// # Errors
    /// As [`Turning::progress`].
    pub(crate) fn new<E>(angle: Angle, close: f64, env: &E, now: Instant) -> Result<Self, Fault>
    where
        E: Odometry + ?Sized,
    {
        let mut odometry = Guard::new(NO_ODOMETRY, now);
        let from = odometry.current(env.motion(), now)?.map(|motion| motion.heading);
        Ok(Turning { angle: angle.si(), close, odometry, from })
    }

    /// Continues after a suspension: the odometry gets a new timeout.
    pub(crate) fn resume(&mut self, now: Instant) {
        self.odometry.restart(now);
    }

    /// The current progress.
    ///
    /// # Errors
    /// [`NO_ODOMETRY`] after half a second without a usable reading.
    pub(crate) fn progress<E>(&mut self, env: &E, now: Instant) -> Result<Progress, Fault>
    where
        E: Odometry + ?Sized,
    {
        let Some(motion) = self.odometry.current(env.motion(), now)? else {
            return Ok(Progress::Unknown);
        };
        let by = motion.heading - *self.from.get_or_insert(motion.heading);
        let left = self.angle - by.si();
        let side = if self.angle < 0.0 { -1.0 } else { 1.0 };
        if side * left < self.close {
            return Ok(Progress::Turned { by, stands: motion.stands() });
        }
        Ok(Progress::Left(left, motion))
    }
}
