//! Drive along a path.

use crate::devices::{Localisation, Navigator, Odometry};
use crate::helpers::pursuit::{Pursued, Pursuit};
use crate::templates;
use crate::templates::follow_path::{Inputs, Live, State};
use afp_core::{Actor, Duration, Fault, Instant, Poll, Resumable};

/// Keeps to the latest path on the map. A new path takes effect without a stop.
#[derive(Clone, Debug)]
pub struct FollowPath {
    pursuit: Pursuit,
}

impl<E: Navigator + Odometry + Localisation + ?Sized> Actor<templates::FollowPath, E>
    for FollowPath
{
    fn start(inputs: Inputs, env: &mut E, now: Instant) -> Result<Self, Fault> {
        env.belief(now)?;
        Ok(FollowPath { pursuit: Pursuit::new(inputs.speed, inputs.tolerance, now) })
    }

    fn poll(&mut self, live: Live<'_>, env: &mut E, now: Instant) -> Result<Poll<State>, Fault> {
        let Some(here) = self.pursuit.locate(env, now)? else { return Ok(Poll::Pending) };
        Ok(match self.pursuit.poll(live.path, &here, env, now)? {
            None => Poll::Pending,
            Some(Pursued::Arrived) => Poll::Ready(State::Arrived),
            Some(Pursued::Lost) => Poll::Ready(State::PathLost),
        })
    }

    halts_when_interrupted!();
}

/// The path stays in place, and the robot returns to it from nearby.
impl<E: Navigator + Odometry + Localisation + ?Sized> Resumable<templates::FollowPath, E>
    for FollowPath
{
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
    use crate::helpers::tracking::DRIVE_BLOCKED;
    use crate::objects::Path;
    use afp_core::quantity::{Length, Speed};

    fn follow(robot: &mut Fake, places: &[[f64; 2]], seconds: u64) -> Result<Option<State>, Fault> {
        let path = Path::new(places.iter().copied()).unwrap();
        let (speed, tolerance) = (Speed::from_si(0.2), Length::from_si(0.1));
        let inputs = Inputs { speed, tolerance };
        robot.run::<templates::FollowPath, FollowPath>(inputs, || Live { path: &path }, seconds)
    }

    #[test]
    fn it_follows_the_path_around_corners_to_its_end() {
        for places in [
            &[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]][..],
            &[[0.0, 0.0], [-1.0, 0.0]],
            &[[0.0, 0.0], [0.5, -0.5], [1.5, -0.5], [1.5, 0.5]],
        ] {
            let mut robot = Fake::new(&[]);
            assert_eq!(follow(&mut robot, places, 40), Ok(Some(State::Arrived)), "{places:?}");
            let [x, y] = *places.last().unwrap();
            let off = (robot.motion.x.si() - x).hypot(robot.motion.y.si() - y);
            assert!(off < 0.05, "{places:?}: {off}");
        }
    }

    #[test]
    fn near_the_end_the_path_is_complete_and_from_afar_the_robot_drives_to_it() {
        let mut robot = Fake::new(&[]);
        assert_eq!(follow(&mut robot, &[[0.0, 0.0], [0.09, 0.0]], 1), Ok(Some(State::Arrived)));
        assert_eq!(robot.motion.x.si(), 0.0);
        // Close to the end, but with a detour before it.
        let round = [[0.0, 0.0], [0.6, 0.0], [0.6, 0.6], [0.0, 0.6], [0.0, 0.05]];
        assert_eq!(follow(&mut robot, &round, 2), Ok(None));
        assert!(robot.motion.x.si() > 0.2);
    }

    #[test]
    fn the_map_need_not_begin_where_the_robot_does() {
        let mut robot = Fake::new(&[]);
        robot.map_offset = [2.0, -1.0];
        let state = follow(&mut robot, &[[2.0, -1.0], [3.0, -1.0]], 20);
        assert_eq!(state, Ok(Some(State::Arrived)));
        assert!((robot.motion.x.si() - 1.0).abs() < 0.05);
    }

    #[test]
    fn an_interrupt_stops_in_the_middle() {
        let mut robot = Fake::new(&[]);
        assert_eq!(follow(&mut robot, &[[0.0, 0.0], [5.0, 0.0]], 4), Ok(None));
        assert!(robot.motion.x.si() > 0.4);
    }

    #[test]
    fn a_robot_off_the_path_or_without_a_position_stops_and_reports_it() {
        let mut robot = Fake::new(&[]);
        let state = follow(&mut robot, &[[2.0, 2.0], [5.0, 2.0]], 3);
        assert_eq!((state, robot.motion.x.si()), (Ok(Some(State::PathLost)), 0.0));
        let mut robot = Fake::new(&[]);
        robot.spread = 1.5;
        let state = follow(&mut robot, &[[0.0, 0.0], [5.0, 0.0]], 3);
        assert_eq!((state, robot.motion.x.si()), (Ok(Some(State::PathLost)), 0.0));
        assert_eq!(follow(&mut Fake::new(&[]), &[], 3), Ok(Some(State::PathLost)));
    }

    #[test]
    fn silence_and_blocked_wheels_are_faults() {
        let fault = |break_it: fn(&mut Fake)| {
            let mut robot = Fake::new(&[]);
            break_it(&mut robot);
            follow(&mut robot, &[[0.0, 0.0], [5.0, 0.0]], 5).map(|_| ())
        };
        assert_eq!(fault(|robot| robot.dead_odometry = true), Err(NO_ODOMETRY));
        assert_eq!(fault(|robot| robot.dead_localisation = true), Err(NO_POSITION));
        assert_eq!(fault(|robot| robot.follows = (0.0, 0.0)), Err(DRIVE_BLOCKED));
    }

    #[test]
    fn a_new_path_replaces_the_old_path_without_a_stop() {
        let mut robot = Fake::new(&[]);
        let first = Path::new([[0.0, 0.0], [3.0, 0.0]]).unwrap();
        let second = Path::new([[0.5, 0.0], [1.5, 0.4]]).unwrap();
        let (speed, tolerance) = (Speed::from_si(0.2), Length::from_si(0.1));
        let now = robot.now;
        type Template = templates::FollowPath;
        let mut actor: FollowPath =
            Actor::<Template, Fake>::start(Inputs { speed, tolerance }, &mut robot, now).unwrap();
        let mut slowest = f64::INFINITY;
        for tick in 0..2000 {
            robot.tick();
            let now = robot.now;
            let path = if tick < 300 { &first } else { &second };
            let polled = Actor::<Template, Fake>::poll(&mut actor, Live { path }, &mut robot, now);
            if polled == Ok(Poll::Ready(State::Arrived)) {
                assert!(slowest > 0.15, "it slowed down to {slowest}");
                assert!((robot.motion.y.si() - 0.4).abs() < 0.1);
                return;
            }
            if (200..400).contains(&tick) {
                slowest = slowest.min(robot.motion.speed.si());
            }
        }
        panic!("it does not arrive");
    }
}
