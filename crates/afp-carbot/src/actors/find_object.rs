//! Turn in place until an object is ahead.

use crate::devices::{Camera, Navigator, Odometry, Reading};
use crate::helpers::eye::Eye;
use crate::helpers::guard::NO_PICTURE;
use crate::helpers::seeking::{Seeking, Sought};
use crate::templates;
use crate::templates::find_object::{Inputs, Live, State};
use afp_core::{Actor, Duration, Fault, Instant, Poll, Resumable};

/// Turns left until the camera shows the object, then towards it.
#[derive(Clone, Debug)]
pub struct FindObject {
    eye: Eye,
    seeking: Seeking,
}

impl<E: Navigator + Odometry + Camera + ?Sized> Actor<templates::FindObject, E> for FindObject {
    fn start(inputs: Inputs<'_>, env: &mut E, now: Instant) -> Result<Self, Fault> {
        let aim = (inputs.tolerance, inputs.speed);
        let seeking = Seeking::new(aim, NO_PICTURE, env, now);
        Ok(FindObject { eye: Eye::new(inputs.look.clone(), env), seeking })
    }

    fn poll(&mut self, _: Live, env: &mut E, now: Instant) -> Result<Poll<State>, Fault> {
        let Reading { time, value } = self.eye.look(env);
        let bearing = value.map(|seen| seen.map(|seen| seen.bearing));
        Ok(match self.seeking.poll(Reading { time, value: bearing }, env, now)? {
            Some(Sought::Facing) => Poll::Ready(State::ObjectFound),
            Some(Sought::Missing) => Poll::Ready(State::NoObjectFound),
            None => Poll::Pending,
        })
    }

    halts_when_interrupted!();
}

/// The search continues from the heading where it began.
impl<E: Navigator + Odometry + Camera + ?Sized> Resumable<templates::FindObject, E> for FindObject {
    halts_when_suspended!();

    fn resume(&mut self, _: &mut E, now: Instant, away: Duration) -> Result<(), Fault> {
        self.seeking.resume(now, away);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fake::Fake;
    use crate::objects::Appearance;
    use afp_core::quantity::{Angle, AngularSpeed};

    fn find(robot: &mut Fake) -> Result<Option<State>, Fault> {
        let look = Appearance::of_color([0.7, 0.15, 0.15], 0.08);
        let inputs = || Inputs {
            look: &look,
            tolerance: Angle::from_deg(5.0),
            speed: AngularSpeed::from_deg(45.0),
        };
        robot.run::<templates::FindObject, FindObject>(inputs(), || Live {}, 20)
    }

    #[test]
    fn it_faces_the_object_in_every_direction() {
        for (x, y) in [(1.0, 1.0), (1.0, -0.5), (-1.5, 0.2), (2.5, 0.0)] {
            let mut robot = Fake::new(&[]);
            robot.post = Some((x, y));
            assert_eq!(find(&mut robot), Ok(Some(State::ObjectFound)), "{x} {y}");
            let off = robot.motion.heading.si() - f64::atan2(y, x);
            assert!(
                crate::helpers::motion::wrap(off).abs() < 5.0_f64.to_radians(),
                "{x} {y}: {off}"
            );
        }
    }

    #[test]
    fn it_turns_once_for_a_missing_object_and_does_not_wait_for_a_lost_object() {
        let mut robot = Fake::new(&[]);
        assert_eq!(find(&mut robot), Ok(Some(State::NoObjectFound)));
        assert!(robot.motion.heading.si() > core::f64::consts::TAU);
        let mut robot = Fake::new(&[]);
        (robot.post, robot.post_goes) = (Some((1.0, 0.5)), 150);
        assert_eq!(find(&mut robot), Ok(Some(State::NoObjectFound)));
        assert!(robot.motion.heading.si() < 1.0);
    }

    #[test]
    fn a_dead_or_frozen_camera_is_a_fault() {
        let mut robot = Fake::new(&[]);
        robot.dead_camera = true;
        assert_eq!(find(&mut robot), Err(NO_PICTURE));
        let mut robot = Fake::new(&[]);
        robot.camera_freezes = 300;
        assert_eq!(find(&mut robot), Err(NO_PICTURE));
        assert!(robot.millis() < 900);
    }
}
