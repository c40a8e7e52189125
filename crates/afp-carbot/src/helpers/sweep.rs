//! A sweep of the range sensor over both sides of a stationary robot.

use crate::devices::{Echo, Motion, Navigator, Odometry, RotatingTelemetry, Rotator, Ultrasonic};
use crate::helpers::aside::Aside;
use crate::helpers::guard::{Arrival, Guard, NO_ODOMETRY, NO_RANGE};
use afp_core::quantity::Angle;
use afp_core::{Fault, Instant};

/// Angle between two pings, radians.
pub(crate) const STEP: f64 = 5.0 / 180.0 * core::f64::consts::PI;
/// The rotator has arrived within this distance of its target, radians.
const ARRIVED: f64 = 2.0 / 180.0 * core::f64::consts::PI;

/// Moves the range sensor from one side to the other, one ping per step.
///
/// Waits at each bearing for a completed ping, so a slow sensor only takes longer. Keeps the robot
/// stationary.
#[derive(Clone, Debug)]
pub(crate) struct Sweep {
    /// Angle to either side, radians.
    sweep: f64,
    /// Target of the rotator, radians.
    target: f64,
    /// Direction of the sweep: 1 left, -1 right.
    direction: f64,
    sweeping: bool,
    last_ping: Instant,
    odometry: Guard,
    range_guard: Guard,
    arrival: Arrival,
    aside: Aside,
}

/// One completed ping of a sweep.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Heard {
    pub(crate) echo: Echo,
    /// The last ping; the rotator returns to look ahead.
    pub(crate) last: bool,
}

impl Sweep {
    /// Begins at the side nearer to the rotator.
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
            aside: Aside::default(),
        }
    }

    /// Stops; the rotator stays where it is.
    pub(crate) fn suspend<E>(&mut self, env: &mut E, now: Instant)
    where
        E: Navigator + Odometry + ?Sized,
    {
        env.halt(now);
        self.aside = Aside::at(env, now);
    }

    /// Continues with the next bearing when the robot has stopped.
    pub(crate) fn resume(&mut self, now: Instant) {
        self.sweeping = false;
        self.odometry.restart(now);
    }

    /// The completed ping at the current bearing, if any.
    ///
    /// # Errors
    /// [`NO_ODOMETRY`] or [`NO_RANGE`] after half a second without a usable reading; those of
    /// [`Arrival`].
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

    /// Starts or continues the sweep if the robot has stopped.
    ///
    /// # Errors
    /// The odometry is silent, or the robot was moved away while the sweep was suspended.
    fn begin<E>(&mut self, env: &mut E, now: Instant) -> Result<bool, Fault>
    where
        E: Odometry + Rotator + ?Sized,
    {
        let motion = self.odometry.current(env.motion(), now)?;
        if let Some(motion) = motion.filter(Motion::stands) {
            if self.aside.check(&motion)? {
                env.point(Angle::from_si(self.target), now);
            }
            self.sweeping = true;
            // Only pings sent from now on count.
            self.last_ping = now;
            self.range_guard = Guard::new(NO_RANGE, now);
            self.arrival = Arrival::new(now);
        }
        Ok(self.sweeping)
    }
}
