//! Sensor timeouts: a template faults after too long without a valid reading.

use crate::devices::{Echo, Reading};
use afp_core::{Duration, Fault, Instant, faults};

/// How long a template waits for a usable reading before it faults.
pub const PATIENCE: Duration = Duration::from_millis(500);

faults! {
    /// The drive's controller has restarted in mid-run.
    pub CONTROLLER_RESTARTED = "controller-restarted",
        "the drive's controller has restarted, so its counts are lost";
    /// The wheel counters give no usable reading.
    pub NO_ODOMETRY = "no-odometry",
        "the odometry gave no valid reading for 500 ms: the counters of the wheels are silent, or the drive's controller, which reads them";
    /// The range sensor gives no usable reading.
    pub NO_RANGE = "no-range", "the range sensor gave no valid reading for 500 ms";
    /// The bumper gives no usable reading.
    pub NO_TOUCH = "no-touch", "the touch sensor gave no valid reading for 500 ms";
    /// A button gives no usable reading.
    pub NO_BUTTON = "no-button", "the button gave no valid reading for 500 ms";
    /// The infrared sensor gives no usable reading; darkness is usable.
    pub NO_INFRARED = "no-infrared", "the infrared sensor gave no valid reading for 500 ms";
    /// The colour sensor gives no usable reading.
    pub NO_COLOR = "no-color", "the colour sensor gave no valid reading for 500 ms";
    /// The battery gauge gives no usable reading.
    pub NO_BATTERY = "no-battery", "the battery's gauge gave no valid reading for 500 ms";
    /// The camera gives no usable flow.
    pub NO_FLOW = "no-flow",
        "the camera gave no new picture in which motion could be seen for 500 ms";
    /// The camera gives no usable picture, or repeats the same picture.
    pub NO_PICTURE = "no-picture", "the camera gave no new picture for 500 ms";
    /// The localisation gives no usable position.
    pub NO_POSITION = "no-position", "the localisation gave no valid position for 500 ms";
    /// The range sensor repeats its distance while the robot moves.
    pub FROZEN_RANGE = "frozen-range",
        "the range sensor gave exactly the same echo for 1 s while it was to be turned, or while the robot moved by 20 cm";
    /// The infrared sensor repeats its reading while the robot moves.
    pub FROZEN_INFRARED = "frozen-infrared",
        "the infrared sensor gave exactly the same reading while the robot moved by 20 cm";
    /// The rotator does not reach its target.
    pub STUCK_ROTATOR = "stuck-rotator",
        "pings did not come from where the rotator was sent within 1 s: it is stuck, or the range sensor repeats itself";
}

/// A driving robot waits after this long without a new echo: 6 cm at full speed. Older echoes are
/// ignored.
pub const LATE: Duration = Duration::from_millis(200);

/// Maximum age of a current reading of the continuous sensors (odometry, bumper, buttons, rotator).
const CURRENT: Duration = Duration::from_millis(100);

/// The timeout of one sensor, counted from its last usable reading.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Guard {
    usable: Instant,
    /// Maximum age of a usable reading.
    oldest: Duration,
    fault: Fault,
}

impl Guard {
    /// Starts the timeout at `now`; `fault` is its fault.
    pub(crate) fn new(fault: Fault, now: Instant) -> Self {
        Guard { usable: now, oldest: PATIENCE, fault }
    }

    /// Starts the timeout again after a suspension.
    pub(crate) fn restart(&mut self, now: Instant) {
        self.usable = now;
    }

    /// For the range sensor of a driving robot.
    pub(crate) fn of_echoes(now: Instant) -> Self {
        Guard { oldest: LATE, ..Guard::new(NO_RANGE, now) }
    }

    /// The current value; `None` during a silence within the timeout.
    ///
    /// # Errors
    /// This guard's fault after [`PATIENCE`] without a usable reading.
    pub(crate) fn current<T: Copy>(
        &mut self,
        reading: Reading<T>,
        now: Instant,
    ) -> Result<Option<T>, Fault> {
        let value = reading.fresh(now, CURRENT);
        if value.is_some() {
            self.usable = now;
        }
        self.patient(now)?;
        Ok(value)
    }

    /// The value of a reading measured after `last`, unless it is too old. The caller keeps `last`.
    ///
    /// # Errors
    /// This guard's fault after [`PATIENCE`] without a new valid reading.
    pub(crate) fn next<T: Copy>(
        &mut self,
        reading: Reading<T>,
        last: Instant,
        now: Instant,
    ) -> Result<Option<T>, Fault> {
        let value = reading.fresh(now, self.oldest).filter(|_| reading.time > last);
        if value.is_some() {
            self.usable = now;
        }
        self.patient(now)?;
        Ok(value)
    }

    /// Whether a driving robot must wait for a usable reading. Repeated late readings suffice: each
    /// is used at the robot's position of its time, and the guard limits its age.
    pub(crate) fn is_late(&self, now: Instant) -> bool {
        now.since(self.usable) > LATE
    }

    fn patient(&self, now: Instant) -> Result<(), Fault> {
        if now.since(self.usable) > PATIENCE { Err(self.fault) } else { Ok(()) }
    }
}

/// Timeout of the rotator: it must get near its target within a second.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Arrival {
    since: Instant,
    /// The last echo from elsewhere, and whether all such echoes of this move were identical.
    echo: Option<Echo>,
    same: bool,
}

impl Arrival {
    /// Starts when the rotator gets a new target.
    pub(crate) fn new(now: Instant) -> Self {
        Arrival { since: now, echo: None, same: true }
    }

    /// Takes an echo whose bearing is not the target.
    ///
    /// # Errors
    /// After more than a second: [`FROZEN_RANGE`] if every echo was identical, which noise excludes
    /// for a working sensor, otherwise [`STUCK_ROTATOR`].
    pub(crate) fn elsewhere(&mut self, echo: &Echo, now: Instant) -> Result<(), Fault> {
        let before = self.echo.replace(*echo);
        self.same &= before.is_none_or(|before| before == *echo) && echo.distance.is_some();
        if now.since(self.since) <= Duration::from_secs(1) {
            return Ok(());
        }
        Err(if self.same { FROZEN_RANGE } else { STUCK_ROTATOR })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::devices::Invalid;

    #[test]
    fn patience_ends_after_half_a_second_and_not_before() {
        let mut guard = Guard::new(NO_RANGE, Instant::ZERO);
        let dead = Reading::<f64>::invalid(Invalid::NoAnswer, Instant::ZERO);
        let at = |ms| Instant::ZERO + Duration::from_millis(ms);
        assert_eq!(guard.current(dead, at(500)), Ok(None));
        assert_eq!(guard.current(Reading::valid(1.0, at(500)), at(500)), Ok(Some(1.0)));
        assert_eq!(guard.current(dead, at(1000)), Ok(None));
        assert_eq!(guard.current(dead, at(1001)), Err(NO_RANGE));
    }

    #[test]
    fn late_echoes_are_not_new_readings_for_a_driving_robot() {
        let at = |ms| Instant::ZERO + Duration::from_millis(ms);
        let mut guard = Guard::of_echoes(at(0));
        assert_eq!(guard.next(Reading::valid(2.0, at(50)), at(0), at(250)), Ok(Some(2.0)));
        assert_eq!(guard.next(Reading::valid(2.0, at(100)), at(50), at(301)), Ok(None));
        assert_eq!(guard.next(Reading::valid(2.0, at(500)), at(50), at(751)), Err(NO_RANGE));
    }

    #[test]
    fn a_repeated_reading_is_not_new() {
        let mut guard = Guard::new(NO_RANGE, Instant::ZERO);
        let at = |ms| Instant::ZERO + Duration::from_millis(ms);
        let frozen = Reading::valid(2.0, at(10));
        assert_eq!(guard.next(frozen, at(0), at(20)), Ok(Some(2.0)));
        assert_eq!(guard.next(frozen, at(10), at(30)), Ok(None));
        assert_eq!(guard.next(frozen, at(10), at(521)), Err(NO_RANGE));
    }
}
