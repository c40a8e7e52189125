//! The place of a robot whose action is suspended.

use crate::devices::{Motion, Odometry};
use crate::helpers::guard::{Guard, NO_ODOMETRY};
use afp_core::{Fault, Instant, faults};
use core::mem;

faults! {
    /// The robot is too far from the place where its action was suspended.
    pub MOVED_AWAY = "moved-away",
        "the robot moved by more than 10 cm or 15 deg while its action was suspended";
}

/// Largest displacement during a suspension, metres.
const FARTHEST: f64 = 0.1;
/// Largest rotation during a suspension, radians.
const WIDEST: f64 = 15.0 / 180.0 * core::f64::consts::PI;

/// The place at the last suspension, until it is checked.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) enum Aside {
    /// There was no suspension since the last check.
    #[default]
    No,
    /// Without odometry nothing is checked later.
    Unknown,
    At(Motion),
}

impl Aside {
    /// The current place.
    pub(crate) fn at<E: Odometry + ?Sized>(env: &E, now: Instant) -> Self {
        let motion = Guard::new(NO_ODOMETRY, now).current(env.motion(), now);
        motion.ok().flatten().map_or(Aside::Unknown, Aside::At)
    }

    /// Checks the place at the first poll after a suspension, and returns whether it is the first.
    ///
    /// # Errors
    /// [`MOVED_AWAY`] if the robot is elsewhere.
    pub(crate) fn check(&mut self, motion: &Motion) -> Result<bool, Fault> {
        let before = match mem::take(self) {
            Aside::No => return Ok(false),
            Aside::Unknown => return Ok(true),
            Aside::At(before) => before,
        };
        let (ahead, left) = motion.seen_from(&before);
        let far = libm::hypot(ahead.si(), left.si()) > FARTHEST;
        let wide = (motion.heading - before.heading).abs().si() > WIDEST;
        if far || wide { Err(MOVED_AWAY) } else { Ok(true) }
    }
}
