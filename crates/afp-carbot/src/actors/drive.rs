//! Drive at a speed and a turn that the plan changes.

use crate::devices::{Navigator, Odometry};
use crate::helpers::guard::{Guard, NO_ODOMETRY};
use crate::helpers::tracking::Tracking;
use crate::templates;
use crate::templates::drive::{Inputs, Live, State};
use afp_core::{Actor, Duration, Fault, Instant, Poll, Resumable};

/// Commands the latest speed and turn. Both ramp up, so that the wheels do not slip.
#[derive(Clone, Debug)]
pub struct Drive {
    tracking: Tracking,
    odometry: Guard,
}

impl<E: Navigator + Odometry + ?Sized> Actor<templates::Drive, E> for Drive {
    fn start(_: Inputs, _: &mut E, now: Instant) -> Result<Self, Fault> {
        Ok(Drive { tracking: Tracking::new(now), odometry: Guard::new(NO_ODOMETRY, now) })
    }

    fn poll(&mut self, live: Live, env: &mut E, now: Instant) -> Result<Poll<State>, Fault> {
        let Some(motion) = self.odometry.current(env.motion(), now)? else {
            self.tracking.halt(env, now);
            return Ok(Poll::Pending);
        };
        let (speed, turn) = (live.speed.si(), live.turn.si());
        let rate = self.tracking.speed(f64::INFINITY, speed.abs(), now).copysign(speed);
        let turn = self.tracking.turn(f64::INFINITY.copysign(turn), turn.abs(), now);
        self.tracking.drive(env, &motion, (rate, turn), now)?;
        Ok(Poll::Pending)
    }

    halts_when_interrupted!();
}

impl<E: Navigator + Odometry + ?Sized> Resumable<templates::Drive, E> for Drive {
    halts_when_suspended!();

    fn resume(&mut self, _: &mut E, now: Instant, _: Duration) -> Result<(), Fault> {
        self.tracking = Tracking::new(now);
        self.odometry.restart(now);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fake::Fake;
    use crate::helpers::tracking::DRIVE_BLOCKED;
    use afp_core::quantity::{AngularSpeed, Speed};

    fn drive(robot: &mut Fake, speed: f64, degrees: f64) -> Result<Option<State>, Fault> {
        let live = || Live {
            speed: Speed::from_si(speed),
            turn: AngularSpeed::from_si(degrees.to_radians()),
        };
        robot.run::<templates::Drive, Drive>(Inputs {}, live, 5)
    }

    #[test]
    fn it_drives_ahead_back_and_in_a_curve_until_it_is_interrupted() {
        for (speed, degrees) in [(0.2, 0.0), (-0.2, 0.0), (0.2, 30.0)] {
            let mut robot = Fake::new(&[]);
            assert_eq!(drive(&mut robot, speed, degrees), Ok(None));
            assert_eq!(robot.command, (0.0, 0.0), "it halts");
            let (way, heading) = (robot.motion.x.si(), robot.motion.heading.si());
            assert!(degrees != 0.0 || (way - 5.0 * speed).abs() < 0.1, "{way}");
            assert!((heading.to_degrees() - 5.0 * degrees).abs() < 10.0, "{heading}");
        }
    }

    #[test]
    fn wheels_that_do_not_turn_are_a_fault() {
        let mut robot = Fake::new(&[]);
        robot.follows = (0.0, 0.0);
        assert_eq!(drive(&mut robot, 0.2, 0.0), Err(DRIVE_BLOCKED));
    }
}
