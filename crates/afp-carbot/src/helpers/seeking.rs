//! Turning in place towards what a sensor sees.

use crate::devices::{Navigator, Odometry, Reading};
use crate::helpers::guard::{Guard, NO_ODOMETRY, PATIENCE};
use crate::helpers::history::History;
use crate::helpers::tracking::Tracking;
use afp_core::quantity::{Angle, AngularSpeed};
use afp_core::{Fault, Instant};

/// So many readings in a row must say that it is ahead.
const SURE: u8 = 3;
/// Without a sight of it the robot turns a little more than once around, radians.
const ALL_AROUND: f64 = core::f64::consts::TAU + 0.2;
/// The whole way counts as turned when less than this is left, radians.
const CLOSE: f64 = 0.005;

/// Turns left until the sensor sees it, then towards it.
///
/// Each reading gives the rest of the way anew, so the sensor's noise does not add up. A reading that comes late is
/// about the heading that the robot had when it was measured.
#[derive(Clone, Debug)]
pub(crate) struct Seeking {
    tolerance: f64,
    speed: f64,
    tracking: Tracking,
    sensor: Guard,
    odometry: Guard,
    history: History,
    /// When the latest reading was measured.
    last_look: Instant,
    /// The heading at the beginning; none until the first reading.
    from: Option<f64>,
    /// The heading towards it, by the last reading that saw it, and when that was; radians.
    towards: Option<(f64, Instant)>,
    /// Readings in a row with it ahead.
    ahead: u8,
}

/// How it ended; the robot stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Sought {
    /// The robot looks at it.
    Facing,
    /// It is nowhere around, or has gone out of sight.
    Missing,
}

impl Seeking {
    /// `silent` is the fault of a sensor that says nothing usable.
    pub(crate) fn new<E>(
        (tolerance, speed): (Angle, AngularSpeed),
        silent: Fault,
        env: &mut E,
        now: Instant,
    ) -> Self
    where
        E: Navigator + Odometry + ?Sized,
    {
        env.halt(now);
        let mut history = History::new();
        history.note(env.motion());
        Seeking {
            tolerance: tolerance.si(),
            speed: speed.si(),
            tracking: Tracking::new(now),
            sensor: Guard::new(silent, now),
            odometry: Guard::new(NO_ODOMETRY, now),
            history,
            last_look: now,
            from: None,
            towards: None,
            ahead: 0,
        }
    }

    /// Goes on with what the sensor says now: the bearing of what it sees, or none where it sees nothing.
    ///
    /// # Errors
    /// The sensor or the odometry is silent for too long, or the drive does not do what it is told.
    pub(crate) fn poll<E>(
        &mut self,
        seen: Reading<Option<Angle>>,
        env: &mut E,
        now: Instant,
    ) -> Result<Option<Sought>, Fault>
    where
        E: Navigator + Odometry + ?Sized,
    {
        let counted = env.motion();
        self.history.note(counted);
        let Some(motion) = self.odometry.current(counted, now)? else {
            self.tracking.halt(env, now);
            return Ok(None);
        };
        let heading = motion.heading.si();
        self.look(seen, heading, now)?;
        let (rest, ending) = self.rest(heading);
        if ending.is_some() {
            self.tracking.halt(env, now);
            return Ok(ending.filter(|_| motion.stands()));
        }
        if self.sensor.is_late(now) {
            self.tracking.halt(env, now);
            return Ok(None);
        }
        let rate = self.tracking.turn(rest, self.speed, now);
        self.tracking.drive(env, &motion, (0.0, rate), now)?;
        Ok(None)
    }

    /// The angle left to turn, radians, and how it ends if it does.
    fn rest(&mut self, heading: f64) -> (f64, Option<Sought>) {
        let from = *self.from.get_or_insert(heading);
        let Some((towards, seen)) = self.towards else {
            let rest = ALL_AROUND - (heading - from);
            return (rest, (rest < CLOSE).then_some(Sought::Missing));
        };
        let lost = self.last_look.since(seen) > PATIENCE;
        let facing = self.ahead >= SURE;
        let ending = if lost { Sought::Missing } else { Sought::Facing };
        (towards - heading, (lost || facing).then_some(ending))
    }

    /// Takes in a new reading of the sensor, if it is one.
    fn look(
        &mut self,
        seen: Reading<Option<Angle>>,
        heading: f64,
        now: Instant,
    ) -> Result<(), Fault> {
        let reading = self.history.placed(seen);
        let Some((bearing, then)) = self.sensor.next(reading, self.last_look, now)? else {
            return Ok(());
        };
        self.last_look = reading.time;
        self.ahead = match bearing {
            Some(bearing) => {
                let towards = then.heading + bearing.si();
                self.towards = Some((towards, reading.time));
                let is_ahead = (towards - heading).abs() <= self.tolerance;
                if is_ahead { self.ahead.saturating_add(1) } else { 0 }
            }
            None => 0,
        };
        Ok(())
    }
}
