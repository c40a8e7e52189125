//! Turn in place.

use crate::devices::{Navigator, Odometry};
use crate::helpers::aside::Aside;
use crate::helpers::tracking::Tracking;
use crate::helpers::turning::{CLOSE, Progress, Turning};
use crate::templates;
use crate::templates::turn::{Inputs, Live, State};
use afp_core::{Actor, Duration, Fault, Instant, Poll, Resumable};

/// Turns by an angle from the initial heading, by odometry.
#[derive(Clone, Debug)]
pub struct Turn {
    turning: Turning,
    speed: f64,
    tracking: Tracking,
    aside: Aside,
}

impl<E: Navigator + Odometry + ?Sized> Actor<templates::Turn, E> for Turn {
    fn start(inputs: Inputs, env: &mut E, now: Instant) -> Result<Self, Fault> {
        Ok(Turn {
            turning: Turning::new(inputs.angle, CLOSE, env, now)?,
            speed: inputs.speed.si(),
            tracking: Tracking::new(now),
            aside: Aside::default(),
        })
    }

    fn poll(&mut self, _: Live, env: &mut E, now: Instant) -> Result<Poll<State>, Fault> {
        match self.turning.progress(env, now)? {
            Progress::Unknown => self.tracking.halt(env, now),
            Progress::Left(left, motion) => {
                self.aside.check(&motion)?;
                let rate = self.tracking.turn(left, self.speed, now);
                self.tracking.drive(env, &motion, (0.0, rate), now)?;
            }
            Progress::Turned { by, stands } => {
                self.tracking.halt(env, now);
                if stands {
                    return Ok(Poll::Ready(State::TurnSuccessful { turned: by }));
                }
            }
        }
        Ok(Poll::Pending)
    }

    halts_when_interrupted!();
}

/// The heading of the end stays the same.
impl<E: Navigator + Odometry + ?Sized> Resumable<templates::Turn, E> for Turn {
    fn suspend(&mut self, env: &mut E, now: Instant) -> Result<(), Fault> {
        self.tracking.halt(env, now);
        self.aside = Aside::at(env, now);
        Ok(())
    }

    fn resume(&mut self, _: &mut E, now: Instant, _: Duration) -> Result<(), Fault> {
        self.tracking = Tracking::new(now);
        self.turning.resume(now);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fake::Fake;
    use crate::helpers::guard::NO_ODOMETRY;
    use crate::helpers::tracking::NO_TURN_IN_PLACE;
    use afp_core::quantity::{Angle, AngularSpeed};

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
    fn a_robot_that_steers_like_a_car_faults_instead_of_waiting() {
        let mut robot = Fake::new(&[]);
        robot.steers_like_a_car = true;
        assert_eq!(turn(&mut robot, 90.0), Err(NO_TURN_IN_PLACE));
        assert!(robot.millis() < 100, "{}", robot.millis());
    }

    #[test]
    fn faults_without_odometry() {
        let mut robot = Fake::new(&[]);
        robot.dead_odometry = true;
        assert_eq!(turn(&mut robot, 90.0), Err(NO_ODOMETRY));
    }
}
