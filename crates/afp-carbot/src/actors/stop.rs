//! Stop and wait for standstill.

use crate::devices::{Navigator, Odometry};
use crate::helpers::guard::{Guard, NO_ODOMETRY};
use crate::templates;
use crate::templates::stop::{Inputs, Live, State};
use afp_core::{Actor, Duration, Fault, Instant, Poll, Resumable};

/// Commands a standstill until the odometry confirms it.
#[derive(Clone, Debug)]
pub struct Stop {
    odometry: Guard,
}

impl<E: Navigator + Odometry + ?Sized> Actor<templates::Stop, E> for Stop {
    fn start(_: Inputs, env: &mut E, now: Instant) -> Result<Self, Fault> {
        env.halt(now);
        Ok(Stop { odometry: Guard::new(NO_ODOMETRY, now) })
    }

    fn poll(&mut self, _: Live, env: &mut E, now: Instant) -> Result<Poll<State>, Fault> {
        env.halt(now);
        let motion = self.odometry.current(env.motion(), now)?;
        let stands = motion.is_some_and(|motion| motion.stands());
        Ok(if stands { Poll::Ready(State::Stopped) } else { Poll::Pending })
    }

    halts_when_interrupted!();
}

impl<E: Navigator + Odometry + ?Sized> Resumable<templates::Stop, E> for Stop {
    halts_when_suspended!();

    fn resume(&mut self, _: &mut E, now: Instant, _: Duration) -> Result<(), Fault> {
        self.odometry.restart(now);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fake::Fake;
    use afp_core::quantity::{AngularSpeed, Speed};

    fn stop(robot: &mut Fake) -> Result<Option<State>, Fault> {
        robot.run::<templates::Stop, Stop>(Inputs {}, || Live {}, 2)
    }

    #[test]
    fn it_is_ready_once_the_robot_has_stopped() {
        let mut robot = Fake::new(&[]);
        robot.drive(Speed::from_si(0.2), AngularSpeed::from_si(0.1), robot.now);
        robot.tick();
        assert_eq!(stop(&mut robot), Ok(Some(State::Stopped)));
    }

    #[test]
    fn waits_for_as_long_as_something_turns_the_robot() {
        let mut robot = Fake::new(&[]);
        robot.drifts = 0.5;
        assert_eq!(stop(&mut robot), Ok(None));
    }

    #[test]
    fn without_odometry_it_is_unknown_whether_the_robot_has_stopped() {
        let mut robot = Fake::new(&[]);
        robot.dead_odometry = true;
        assert_eq!(stop(&mut robot), Err(NO_ODOMETRY));
    }
}
