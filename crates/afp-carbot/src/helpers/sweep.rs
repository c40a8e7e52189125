//! A sweep of the range sensor over both sides of the heading, by a robot that stands.

use crate::devices::{Echo, Navigator, Odometry, RotatingTelemetry, Rotator, Ultrasonic};
use crate::helpers::guard::{Arrival, Guard, NO_ODOMETRY, NO_RANGE};
use afp_core::quantity::Angle;
use afp_core::{Fault, Instant};

/// The sensor pings once at every so many radians.
pub(crate) const STEP: f64 = 5.0 / 180.0 * core::f64::consts::PI;
/// The rotator has arrived when it is nearer than this to where it should be, radians.
const ARRIVED: f64 = 2.0 / 180.0 * core::f64::consts::PI;

/// Takes the range sensor from one side to the other and asks for one ping at every step.
///
/// Moves on to the next bearing when a ping has been completed there, so a slow sensor makes it
/// slower but not worse. The robot is told to stand all the time.
#[derive(Clone, Debug)]
pub(crate) struct Sweep {
    /// How far to either side, radians.
    sweep: f64,
    /// Where the rotator should be, radians.
    target: f64,
    /// Towards which side the sweep goes: 1 left, -1 right.
    direction: f64,
    sweeping: bool,
    last_ping: Instant,
    odometry: Guard,
    range_guard: Guard,
    arrival: Arrival,
}

/// One completed ping of a sweep.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Heard {
    pub(crate) echo: Echo,
    /// It is the last one; the rotator goes back to look ahead.
    pub(crate) last: bool,
}

impl Sweep {
    /// Begins at the side that the rotator is nearer to.
    pub(crate) fn new<E>(sweep: Angle, env: &mut E, now: Instant) -> Self
    where
        E: Navigator + Rotator + RotatingTelemetry + ?Sized,
    {
        env.halt(now);
        let sweep = sweep.si();
        let bearing = env.bearing().value.map_or(0.0, |bearing| bearing.si());
        let side = if bearing < 0.0 { -1.0 } else { 1.0 };
        env.point(Angle::from_si(side * sweep), now);
        Sweep {
            sweep,
            target: side * sweep,
            direction: -side,
            sweeping: false,
            last_ping: now,
            odometry: Guard::new(NO_ODOMETRY, now),
            range_guard: Guard::new(NO_RANGE, now),
            arrival: Arrival::new(now),
        }
    }

    /// The ping that has been completed at the bearing in turn, if one has.
    ///
    /// # Errors
    /// [`NO_ODOMETRY`] or [`NO_RANGE`] after half a second without a usable reading; those of [`Arrival`].
    pub(crate) fn poll<E>(&mut self, env: &mut E, now: Instant) -> Result<Option<Heard>, Fault>
    where
        E: Navigator + Odometry + Ultrasonic + Rotator + ?Sized,
    {
        env.halt(now);
        if !self.sweeping && !self.begin(env, now)? {
            return Ok(None);
        }
        let reading = env.echo();
        let Some(echo) = self.range_guard.next(reading, self.last_ping, now)? else {
            return Ok(None);
        };
        self.last_ping = reading.time;
        if (echo.bearing.si() - self.target).abs() > ARRIVED {
            self.arrival.elsewhere(&echo, now)?;
            return Ok(None);
        }
        let last = self.direction * self.target >= self.sweep - STEP / 2.0;
        let next = (self.target + self.direction * STEP).max(-self.sweep).min(self.sweep);
        self.target = if last { 0.0 } else { next };
        env.point(Angle::from_si(self.target), now);
        self.arrival = Arrival::new(now);
        Ok(Some(Heard { echo, last }))
    }

    /// Whether the robot stands, so that the sweep can begin.
    fn begin<E: Odometry + ?Sized>(&mut self, env: &mut E, now: Instant) -> Result<bool, Fault> {
        let motion = self.odometry.current(env.motion(), now)?;
        if motion.is_some_and(|motion| motion.stands()) {
            self.sweeping = true;
            // Only what is sent from now on counts.
            self.last_ping = now;
            self.range_guard = Guard::new(NO_RANGE, now);
            self.arrival = Arrival::new(now);
        }
        Ok(self.sweeping)
    }
}
