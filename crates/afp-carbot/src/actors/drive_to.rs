//! Drive to a pose on the map, straight on.

use crate::devices::{Localisation, Navigator, Odometry};
use crate::helpers::pursuit::{Pursued, Pursuit};
use crate::objects::Path;
use crate::templates;
use crate::templates::drive_to::{Inputs, Live, State};
use afp_core::{Actor, Duration, Fault, Instant, Poll, Resumable};

/// Drives a straight line from the robot's estimated position, then turns to the heading.
#[derive(Clone, Debug)]
pub struct DriveTo {
    pursuit: Pursuit,
    place: [f64; 2],
    heading: f64,
    /// `None` until the robot knows its position.
    path: Option<Path>,
    /// Whether the robot has reached the place; then it turns.
    arrived: bool,
}

impl<E: Navigator + Odometry + Localisation + ?Sized> Actor<templates::DriveTo, E> for DriveTo {
    fn start(inputs: Inputs, env: &mut E, now: Instant) -> Result<Self, Fault> {
        env.belief(now)?;
        Ok(DriveTo {
            pursuit: Pursuit::new(inputs.speed, inputs.tolerance, now),
            place: [inputs.x.si(), inputs.y.si()],
            heading: inputs.heading.si(),
            path: None,
            arrived: false,
        })
    }

    fn poll(&mut self, _: Live, env: &mut E, now: Instant) -> Result<Poll<State>, Fault> {
        let Some(here) = self.pursuit.locate(env, now)? else { return Ok(Poll::Pending) };
        let from = [here.belief.x.si(), here.belief.y.si()];
        let path = match &mut self.path {
            Some(path) => path,
            none => none.insert(Path::new([from, self.place])?),
        };
        let pursued = if self.arrived {
            self.pursuit.face(self.heading, (path, &here), env, now)?
        } else {
            self.pursuit.poll(path, &here, env, now)?
        };
        Ok(match pursued {
            None => Poll::Pending,
            Some(Pursued::Lost) => Poll::Ready(State::PathLost),
            Some(Pursued::Arrived) if self.arrived => Poll::Ready(State::Arrived),
            Some(Pursued::Arrived) => {
                self.arrived = true;
                Poll::Pending
            }
        })
    }

    halts_when_interrupted!();
}

/// The path stays in place, and the robot returns to it from nearby.
impl<E: Navigator + Odometry + Localisation + ?Sized> Resumable<templates::DriveTo, E> for DriveTo {
    halts_when_suspended!();

    fn resume(&mut self, _: &mut E, now: Instant, _: Duration) -> Result<(), Fault> {
        self.pursuit.resume(now);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fake::Fake;
    use crate::helpers::guard::{NO_ODOMETRY, NO_POSITION};
    use crate::helpers::motion::wrap;
    use crate::helpers::tracking::DRIVE_BLOCKED;
    use afp_core::quantity::{Angle, Length, Speed};

    fn drive(
        robot: &mut Fake,
        [x, y, degrees]: [f64; 3],
        seconds: u64,
    ) -> Result<Option<State>, Fault> {
        let inputs = Inputs {
            x: Length::from_si(x),
            y: Length::from_si(y),
            heading: Angle::from_deg(degrees),
            speed: Speed::from_si(0.2),
            tolerance: Length::from_si(0.1),
        };
        robot.run::<templates::DriveTo, DriveTo>(inputs, || Live {}, seconds)
    }

    #[test]
    fn it_ends_at_the_place_with_the_wanted_heading() {
        for [x, y, degrees] in [[1.0, 0.5, 90.0], [-1.0, 0.0, 0.0], [0.0, 0.0, 180.0]] {
            let mut robot = Fake::new(&[]);
            let state = drive(&mut robot, [x, y, degrees], 30);
            assert_eq!(state, Ok(Some(State::Arrived)), "{x} {y} {degrees}");
            let motion = robot.motion;
            let off = (motion.x.si() - x).hypot(motion.y.si() - y);
            let turned = wrap(motion.heading.si() - degrees.to_radians()).abs();
            assert!(off < 0.05 && turned < 0.05, "{x} {y} {degrees}: {off} m, {turned}");
        }
    }

    #[test]
    fn an_interrupt_stops_in_the_middle() {
        let mut robot = Fake::new(&[]);
        assert_eq!(drive(&mut robot, [5.0, 0.0, 0.0], 4), Ok(None));
        assert!(robot.motion.x.si() > 0.4);
    }

    #[test]
    fn a_robot_without_a_position_stops_and_reports_it() {
        let mut robot = Fake::new(&[]);
        robot.spread = 1.5;
        let state = drive(&mut robot, [5.0, 0.0, 0.0], 3);
        assert_eq!((state, robot.motion.x.si()), (Ok(Some(State::PathLost)), 0.0));
        // Also while it turns.
        let mut robot = Fake::new(&[]);
        robot.lost_from = 1500;
        assert_eq!(drive(&mut robot, [0.0, 0.0, 180.0], 5), Ok(Some(State::PathLost)));
        let turned = robot.motion.heading.si().abs();
        assert!((0.5..1.5).contains(&turned) && robot.millis() < 2700, "{turned}");
    }

    #[test]
    fn silence_and_blocked_wheels_are_faults() {
        let fault = |break_it: fn(&mut Fake)| {
            let mut robot = Fake::new(&[]);
            break_it(&mut robot);
            drive(&mut robot, [5.0, 0.0, 0.0], 5).map(|_| ())
        };
        assert_eq!(fault(|robot| robot.dead_odometry = true), Err(NO_ODOMETRY));
        assert_eq!(fault(|robot| robot.dead_localisation = true), Err(NO_POSITION));
        assert_eq!(fault(|robot| robot.follows = (0.0, 0.0)), Err(DRIVE_BLOCKED));
    }
}
