//! Turning in place towards a target that a sensor sees.

use crate::devices::{Navigator, Odometry, Reading};
use crate::helpers::guard::{Guard, NO_ODOMETRY, PATIENCE};
use crate::helpers::history::History;
use crate::helpers::tracking::Tracking;
use afp_core::quantity::{Angle, AngularSpeed};
use afp_core::{Duration, Fault, Instant};

/// Readings in a row that must show it ahead.
const SURE: u8 = 3;
/// Angle of the search, radians: a little more than a full turn.
const ALL_AROUND: f64 = core::f64::consts::TAU + 0.2;
/// The turn is complete when less than this is left, radians.
const CLOSE: f64 = 0.005;

/// Turns left until the sensor sees the target, then towards it.
///
/// Each reading gives the remaining angle, so the sensor's noise does not add up. A late reading
/// applies to the heading at its measurement.
#[derive(Clone, Debug)]
pub(crate) struct Seeking {
    tolerance: f64,
    speed: f64,
    tracking: Tracking,
    sensor: Guard,
    odometry: Guard,
    history: History,
    /// Time of the latest reading.
    last_look: Instant,
    /// The initial heading; `None` until the first reading.
    from: Option<f64>,
    /// The heading towards the target in radians, and the time of that reading.
    towards: Option<(f64, Instant)>,
    /// Readings in a row with the target ahead.
    ahead: u8,
}

/// The outcome; the robot has stopped.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Sought {
    /// The robot faces the target.
    Facing,
    /// The target is nowhere around or has gone out of sight.
    Missing,
}

impl Seeking {
    /// `silent` is the fault of a sensor without usable readings.
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

    /// Continues after a suspension `away` ago. The target stays in place.
    pub(crate) fn resume(&mut self, now: Instant, away: Duration) {
        self.tracking = Tracking::new(now);
        self.sensor.restart(now);
        self.odometry.restart(now);
        self.last_look += away;
        if let Some((_, seen)) = &mut self.towards {
            *seen += away;
        }
        self.ahead = 0;
    }

    /// Turns by the sensor's current reading: the target's bearing, or `None` if out of sight.
    ///
    /// # Errors
    /// The sensor or the odometry is silent for too long, or the drive does not follow its
    /// commands.
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

    /// The angle left, radians, and the outcome if the turn ends.
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

    /// Uses a reading of the sensor if it is new.
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
