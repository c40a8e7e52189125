//! Keep the robot stationary until an event interrupts.

use crate::devices::Navigator;
use crate::templates;
use crate::templates::hold::{Inputs, Live, State};
use afp_core::{Actor, Duration, Fault, Instant, Poll, Resumable};

/// Commands a standstill repeatedly, against pushes and drives that time out.
#[derive(Clone, Copy, Debug)]
pub struct Hold;

impl<E: Navigator + ?Sized> Actor<templates::Hold, E> for Hold {
    fn start(_: Inputs, env: &mut E, now: Instant) -> Result<Self, Fault> {
        env.halt(now);
        Ok(Hold)
    }

    fn poll(&mut self, _: Live, env: &mut E, now: Instant) -> Result<Poll<State>, Fault> {
        env.halt(now);
        Ok(Poll::Pending)
    }

    halts_when_interrupted!();
}

impl<E: Navigator + ?Sized> Resumable<templates::Hold, E> for Hold {
    halts_when_suspended!();

    fn resume(&mut self, _: &mut E, _: Instant, _: Duration) -> Result<(), Fault> {
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fake::Fake;
    use afp_core::quantity::{AngularSpeed, Speed};

    #[test]
    fn it_stops_the_robot_from_its_start() {
        let mut robot = Fake::new(&[]);
        let now = robot.now;
        let roll = |robot: &mut Fake| {
            robot.drive(Speed::from_si(0.2), AngularSpeed::from_si(0.1), now);
        };
        roll(&mut robot);
        let hold = Actor::<templates::Hold, Fake>::start(Inputs {}, &mut robot, now);
        let mut hold: Hold = hold.unwrap();
        assert_eq!(robot.command, (0.0, 0.0));
        roll(&mut robot);
        let polled = Actor::<templates::Hold, Fake>::poll(&mut hold, Live {}, &mut robot, now);
        assert_eq!((polled, robot.command), (Ok(Poll::Pending), (0.0, 0.0)));
    }
}
