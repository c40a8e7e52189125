//! Turning by an angle: how much of it is left, whether the robot turns in place or drives an arc.

use crate::devices::{Motion, Odometry};
use crate::helpers::guard::{Guard, NO_ODOMETRY};
use afp_core::quantity::Angle;
use afp_core::{Fault, Instant};

/// A turn in place counts as done when less than this is left, radians.
pub(crate) const CLOSE: f64 = 0.005;

/// An angle to be turned against the heading at the beginning, by odometry.
#[derive(Clone, Debug)]
pub(crate) struct Turning {
    angle: f64,
    close: f64,
    odometry: Guard,
    /// The heading at the beginning; none until the first reading.
    from: Option<Angle>,
}

/// How far a turn has got.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Progress {
    /// The odometry says nothing: the robot has to wait.
    Unknown,
    /// Radians left, negative to the right, and how the robot moves.
    Left(f64, Motion),
    /// The angle has been turned; whether the robot stands already.
    Turned { by: Angle, stands: bool },
}

impl Turning {
    /// Begins at `now`; the angle counts as turned when less than `close` is left, radians.
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

    /// How far the turn has got.
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
