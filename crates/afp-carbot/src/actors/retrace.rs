//! Drive back along the robot's path.

use crate::devices::{Motion, Navigator, Odometry};
use crate::helpers::aside::Aside;
use crate::helpers::guard::{Guard, NO_ODOMETRY};
use crate::helpers::history::Pose;
use crate::helpers::tracking::Tracking;
use crate::helpers::trail::Trail;
use crate::templates;
use crate::templates::retrace::{Inputs, Live, State};
use afp_core::quantity::Length;
use afp_core::{Actor, Duration, Fault, Instant, Poll, Resumable};

/// A place is reached within this distance, metres.
const CLOSE: f64 = 0.004;

/// Drives and turns back along the platform's trail, and straight back beyond its end.
#[derive(Clone, Debug)]
pub struct Retrace {
    /// Distance to drive back, metres.
    distance: f64,
    speed: f64,
    tracking: Tracking,
    odometry: Guard,
    /// `None` until the first reading.
    path: Option<PathBack>,
    aside: Aside,
}

/// The rest of the path back.
#[derive(Clone, Debug)]
struct PathBack {
    trail: Trail,
    /// Start and end of the current leg.
    from: Pose,
    to: Pose,
    /// Distance left after this leg, metres.
    rest: f64,
    /// Weight of a turn, per radian.
    lever: Length,
}

impl PathBack {
    fn new(trail: Trail, here: Pose, rest: f64, lever: Length) -> Self {
        let trail = trail.back_from(&here, lever);
        let mut path = PathBack { trail, from: here, to: here, rest, lever };
        path.next();
        path
    }

    /// Starts the leg to the previous place, or the part of it that is left.
    fn next(&mut self) {
        self.from = self.to;
        let before = self.trail.place(1);
        self.trail.drop_newest();
        let to = before.unwrap_or_else(|| self.from.behind(self.rest));
        let leg = self.from.distance_to(&to, self.lever);
        let share = (self.rest / leg.max(CLOSE)).min(1.0);
        let mix = |from: f64, to: f64| from + (to - from) * share;
        self.to = Pose {
            x: mix(self.from.x, to.x),
            y: mix(self.from.y, to.y),
            heading: mix(self.from.heading, to.heading),
        };
        self.rest = (self.rest - leg.max(CLOSE)).max(0.0);
    }

    /// Distance to the end of the leg, along it; negative beyond the end.
    fn left(&self, here: &Pose) -> f64 {
        let lever = self.lever.si();
        let part = |from: &Pose, to: &Pose| {
            [to.x - from.x, to.y - from.y, lever * (to.heading - from.heading)]
        };
        let (leg, rest) = (part(&self.from, &self.to), part(here, &self.to));
        let along: f64 = leg.iter().zip(rest).map(|(leg, rest)| leg * rest).sum();
        along / self.from.distance_to(&self.to, self.lever).max(CLOSE)
    }

    /// Skips the places that are reached. Returns the distance ahead in metres, the turn to the
    /// left in radians, and the distance to the end; `None` at the end.
    fn ahead(&mut self, motion: &Motion) -> Option<(f64, f64, f64)> {
        let here = Pose::from(*motion);
        while self.left(&here) < CLOSE {
            if self.rest <= 0.0 {
                return None;
            }
            self.next();
        }
        let ahead = self.to.standing().seen_from(motion).0.si();
        Some((ahead, self.to.heading - here.heading, self.left(&here) + self.rest))
    }
}

impl<E: Navigator + Odometry + ?Sized> Actor<templates::Retrace, E> for Retrace {
    fn start(inputs: Inputs, env: &mut E, now: Instant) -> Result<Self, Fault> {
        let mut retrace = Retrace {
            distance: inputs.distance.si(),
            speed: inputs.speed.si(),
            tracking: Tracking::new(now),
            odometry: Guard::new(NO_ODOMETRY, now),
            path: None,
            aside: Aside::default(),
        };
        retrace.look(env, now)?;
        Ok(retrace)
    }

    fn poll(&mut self, _: Live, env: &mut E, now: Instant) -> Result<Poll<State>, Fault> {
        let Some(motion) = self.look(env, now)? else {
            self.tracking.halt(env, now);
            return Ok(Poll::Pending);
        };
        self.aside.check(&motion)?;
        let Some((ahead, turn, rest)) = self.path.as_mut().and_then(|path| path.ahead(&motion))
        else {
            self.tracking.halt(env, now);
            return Ok(if motion.stands() { Poll::Ready(State::Retraced) } else { Poll::Pending });
        };
        let rate = self.tracking.speed(rest, self.speed, now);
        let share = rate / libm::hypot(ahead, env.body().lever().si() * turn).max(CLOSE);
        self.tracking.drive(env, &motion, (share * ahead, share * turn), now)?;
        Ok(Poll::Pending)
    }

    halts_when_interrupted!();
}

/// The path back stays in place.
impl<E: Navigator + Odometry + ?Sized> Resumable<templates::Retrace, E> for Retrace {
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

impl Retrace {
    /// Reads the odometry; the first reading starts the path.
    fn look<E>(&mut self, env: &E, now: Instant) -> Result<Option<Motion>, Fault>
    where
        E: Navigator + Odometry + ?Sized,
    {
        let motion = self.odometry.current(env.motion(), now)?;
        if let (Some(motion), None) = (motion, &self.path) {
            self.path =
                Some(PathBack::new(env.trail(), motion.into(), self.distance, env.body().lever()));
        }
        Ok(motion)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fake::Fake;
    use crate::helpers::tracking::DRIVE_BLOCKED;
    use afp_core::quantity::{Angle, AngularSpeed, Length, Speed};

    fn back(robot: &mut Fake, distance: f64) -> Result<Option<State>, Fault> {
        let (distance, speed) = (Length::from_si(distance), Speed::from_si(0.2));
        robot.run::<templates::Retrace, Retrace>(Inputs { distance, speed }, || Live {}, 20)
    }

    fn turn(robot: &mut Fake, degrees: f64) {
        let (angle, speed) = (Angle::from_deg(degrees), AngularSpeed::from_si(0.8));
        let inputs = templates::turn::Inputs { angle, speed };
        let live = || templates::turn::Live {};
        robot.run::<templates::Turn, crate::Turn>(inputs, live, 20).unwrap().unwrap();
    }

    fn forward(robot: &mut Fake, distance: f64) {
        let (distance, speed) = (Length::from_si(distance), Speed::from_si(0.2));
        let inputs = templates::forward::Inputs { distance, speed };
        let live = || templates::forward::Live {};
        robot.run::<templates::Forward, crate::Forward>(inputs, live, 20).unwrap().unwrap();
    }

    #[test]
    fn it_undoes_a_turn_and_then_the_path_before_it() {
        for degrees in [40.0, -40.0] {
            let mut robot = Fake::new(&[]);
            forward(&mut robot, 0.3);
            turn(&mut robot, degrees);
            let turned = robot.body().lever().si() * 40_f64.to_radians();
            assert_eq!(back(&mut robot, turned + 0.1), Ok(Some(State::Retraced)));
            let at = robot.motion;
            assert!((at.x.si() - 0.2).abs() < 0.02 && at.y.si().abs() < 0.01, "{at:?}");
            assert!(at.heading.si().abs() < 0.06, "{at:?}");
        }
    }

    #[test]
    fn goes_farther_back_the_second_time() {
        let mut robot = Fake::new(&[]);
        forward(&mut robot, 0.4);
        for left in [0.3, 0.2] {
            assert_eq!(back(&mut robot, 0.1), Ok(Some(State::Retraced)));
            assert!((robot.motion.x.si() - left).abs() < 0.02, "{:?}", robot.motion);
        }
    }

    #[test]
    fn without_a_known_path_it_goes_straight_back() {
        let mut robot = Fake::new(&[]);
        assert_eq!(back(&mut robot, 0.15), Ok(Some(State::Retraced)));
        assert!((robot.motion.x.si() + 0.15).abs() < 0.01, "{:?}", robot.motion);
    }

    #[test]
    fn silence_and_blocked_wheels_are_faults() {
        let mut robot = Fake::new(&[]);
        robot.dead_odometry = true;
        assert_eq!(back(&mut robot, 0.15), Err(NO_ODOMETRY));
        let mut robot = Fake::new(&[]);
        robot.follows = (0.0, 0.0);
        assert_eq!(back(&mut robot, 0.15), Err(DRIVE_BLOCKED));
    }

    #[test]
    fn an_interrupt_stops_in_the_middle() {
        let mut robot = Fake::new(&[]);
        let (distance, speed) = (Length::from_si(1.0), Speed::from_si(0.2));
        let inputs = Inputs { distance, speed };
        assert_eq!(robot.run::<templates::Retrace, Retrace>(inputs, || Live {}, 2), Ok(None));
        assert!(robot.motion.x.si() < -0.2 && robot.motion.x.si() > -0.5, "{:?}", robot.motion);
    }
}
