//! Turn in place.

use crate::devices::{Navigator, Odometry};
use crate::guard::{Guard, NO_ODOMETRY};
use crate::motion::Ramp;
use crate::templates;
use crate::templates::turn::{Inputs, Live, State};
use afp_core::quantity::{Angle, AngularSpeed, Speed};
use afp_core::{Actor, Fault, Instant, Poll};

/// Turn rate is gained and lost at this many radians a second squared.
const ACCELERATION: f64 = 3.0;
/// The angle counts as turned when less than this many radians are left.
const CLOSE: f64 = 0.005;

/// Turns by an angle against the heading it starts with, by odometry.
#[derive(Debug)]
pub struct Turn {
    angle: f64,
    speed: f64,
    ramp: Ramp,
    odometry: Guard,
    /// The heading at the beginning; none until the first reading.
    from: Option<Angle>,
}

impl<E: Navigator + Odometry + ?Sized> Actor<templates::Turn, E> for Turn {
    fn start(inputs: Inputs, env: &mut E, now: Instant) -> Result<Self, Fault> {
        let mut odometry = Guard::new(NO_ODOMETRY, now);
        let from = odometry.current(env.motion(), now)?.map(|motion| motion.heading);
        Ok(Turn {
            angle: inputs.angle.si(),
            speed: inputs.speed.si(),
            ramp: Ramp::new(ACCELERATION, now),
            odometry,
            from,
        })
    }

    fn poll(&mut self, _: Live, env: &mut E, now: Instant) -> Result<Poll<State>, Fault> {
        let Some(motion) = self.odometry.current(env.motion(), now)? else {
            env.halt(now);
            return Ok(Poll::Pending);
        };
        let turned = motion.heading - *self.from.get_or_insert(motion.heading);
        let left = if self.angle < 0.0 { -1.0 } else { 1.0 };
        let rest = left * (self.angle - turned.si());
        if rest < CLOSE {
            env.halt(now);
            return Ok(if motion.stands() {
                Poll::Ready(State::TurnSuccessful { turned })
            } else {
                Poll::Pending
            });
        }
        let rate = self.ramp.rate(rest, self.speed, now);
        env.drive(Speed::from_si(0.0), AngularSpeed::from_si(left * rate), now);
        Ok(Poll::Pending)
    }

    fn interrupt(&mut self, env: &mut E, now: Instant) -> Result<(), Fault> {
        env.halt(now);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fake::Fake;

    fn turn(robot: &mut Fake, degrees: f64) -> Result<Option<State>, Fault> {
        let speed = AngularSpeed::from_si(0.8);
        let inputs = Inputs { angle: Angle::from_deg(degrees), speed };
        robot.run::<templates::Turn, Turn>(inputs, || Live {}, 20)
    }

    #[test]
    fn turns_to_either_side_and_past_half_a_turn() {
        for degrees in [90.0, -60.0, 270.0] {
            let mut robot = Fake::new(&[]);
            let state = turn(&mut robot, degrees);
            let Ok(Some(State::TurnSuccessful { turned })) = state else { panic!("{state:?}") };
            assert!((turned.si().to_degrees() - degrees).abs() < 1.0, "{turned:?}");
            assert_eq!(robot.motion.x.si(), 0.0);
        }
    }

    #[test]
    fn faults_without_odometry() {
        let mut robot = Fake::new(&[]);
        robot.dead_odometry = true;
        assert_eq!(turn(&mut robot, 90.0), Err(NO_ODOMETRY));
    }
}
