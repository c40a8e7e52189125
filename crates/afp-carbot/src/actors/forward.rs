//! Drive straight ahead or back.

use crate::devices::{Motion, Navigator, Odometry};
use crate::helpers::aside::Aside;
use crate::helpers::guard::{Guard, NO_ODOMETRY};
use crate::helpers::tracking::Tracking;
use crate::templates;
use crate::templates::forward::{Inputs, Live, State};
use afp_core::quantity::Length;
use afp_core::{Actor, Duration, Fault, Instant, Poll, Resumable};

/// The drive is complete when less than this is left, metres.
const CLOSE: f64 = 0.004;
/// Turn rate per radian of heading error.
const HOLD: f64 = 2.5;

/// Drives a distance and holds the initial heading, by odometry.
#[derive(Clone, Debug)]
pub struct Forward {
    distance: f64,
    speed: f64,
    tracking: Tracking,
    odometry: Guard,
    /// Motion at the start; `None` until the first reading.
    from: Option<Motion>,
    aside: Aside,
}

impl<E: Navigator + Odometry + ?Sized> Actor<templates::Forward, E> for Forward {
    fn start(inputs: Inputs, env: &mut E, now: Instant) -> Result<Self, Fault> {
        let mut odometry = Guard::new(NO_ODOMETRY, now);
        let from = odometry.current(env.motion(), now)?;
        Ok(Forward {
            distance: inputs.distance.si(),
            speed: inputs.speed.si(),
            tracking: Tracking::new(now),
            odometry,
            from,
            aside: Aside::default(),
        })
    }

    fn poll(&mut self, _: Live, env: &mut E, now: Instant) -> Result<Poll<State>, Fault> {
        let Some(motion) = self.odometry.current(env.motion(), now)? else {
            self.tracking.halt(env, now);
            return Ok(Poll::Pending);
        };
        self.aside.check(&motion)?;
        let from = *self.from.get_or_insert(motion);
        let driven = motion.seen_from(&from).0.si();
        let ahead = if self.distance < 0.0 { -1.0 } else { 1.0 };
        let rest = ahead * (self.distance - driven);
        if rest < CLOSE {
            self.tracking.halt(env, now);
            return Ok(if motion.stands() {
                Poll::Ready(State::ForwardSuccessful { driven: Length::from_si(driven) })
            } else {
                Poll::Pending
            });
        }
        let rate = self.tracking.speed(rest, self.speed, now);
        let turn = HOLD * (from.heading - motion.heading).si();
        self.tracking.drive(env, &motion, (ahead * rate, turn), now)?;
        Ok(Poll::Pending)
    }

    halts_when_interrupted!();
}

/// The line and its end stay in place.
impl<E: Navigator + Odometry + ?Sized> Resumable<templates::Forward, E> for Forward {
    fn suspend(&mut self, env: &mut E, now: Instant) -> Result<(), Fault> {
        self.tracking.halt(env, now);
        self.aside = Aside::at(env, now);
        Ok(())
    }

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
    use crate::helpers::tracking::{DRIVE_BLOCKED, DRIVE_STALLED};
    use afp_core::quantity::Speed;

    fn drive(robot: &mut Fake, distance: f64, seconds: u64) -> Result<Option<State>, Fault> {
        let inputs = Inputs { distance: Length::from_si(distance), speed: Speed::from_si(0.2) };
        robot.run::<templates::Forward, Forward>(inputs, || Live {}, seconds)
    }

    #[test]
    fn drives_the_distance_ahead_and_back() {
        for distance in [1.0, -0.3] {
            let mut robot = Fake::new(&[]);
            let state = drive(&mut robot, distance, 10);
            let Ok(Some(State::ForwardSuccessful { driven })) = state else { panic!("{state:?}") };
            assert!((driven.si() - distance).abs() < 0.01, "{driven:?}");
            assert!((robot.motion.x.si() - distance).abs() < 0.01);
        }
    }

    #[test]
    fn an_interrupt_stops_in_the_middle() {
        let mut robot = Fake::new(&[]);
        assert_eq!(drive(&mut robot, 5.0, 2), Ok(None));
        assert!(robot.motion.x.si() > 0.2);
    }

    #[test]
    fn a_blocked_robot_or_a_robot_that_drives_in_circles_is_a_fault() {
        let mut robot = Fake::new(&[]);
        robot.follows = (0.0, 0.0);
        assert_eq!(drive(&mut robot, 1.0, 5), Err(DRIVE_BLOCKED));
        let mut robot = Fake::new(&[]);
        (robot.follows, robot.drifts) = ((0.5, 0.5), 0.4);
        assert_eq!(drive(&mut robot, 1.0, 30), Err(DRIVE_STALLED));
    }

    #[test]
    fn without_odometry_it_stops_and_fails_after_half_a_second() {
        let mut robot = Fake::new(&[]);
        robot.dead_odometry = true;
        assert_eq!(drive(&mut robot, 1.0, 5), Err(NO_ODOMETRY));
        assert_eq!((robot.command(), robot.millis()), ((0.0, 0.0), 510));
    }
}
