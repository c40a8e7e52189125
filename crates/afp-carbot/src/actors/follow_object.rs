//! Drive towards a moving object.

use crate::devices::{Camera, Navigator, Odometry, Reading};
use crate::helpers::approaching::{Approached, Approaching, Sight};
use crate::helpers::eye::Eye;
use crate::helpers::guard::NO_PICTURE;
use crate::helpers::sighting::Sighting;
use crate::templates;
use crate::templates::follow_object::{Inputs, Live, State};
use afp_core::{Actor, Duration, Fault, Instant, Poll, Resumable};

/// Assumed distance of an object whose foot is not on the floor, metres.
const FAR: f64 = 10.0;

/// Steers by the object's bearing and by its foot on the floor, and stops in front of it.
#[derive(Clone, Debug)]
pub struct FollowObject {
    eye: Eye,
    /// From the robot's front, metres.
    distance: f64,
    approaching: Approaching,
}

impl<E: Navigator + Odometry + Camera + ?Sized> Actor<templates::FollowObject, E> for FollowObject {
    fn start(inputs: Inputs<'_>, env: &mut E, now: Instant) -> Result<Self, Fault> {
        let approaching = Approaching::new(inputs.speed, NO_PICTURE, env, now);
        let eye = Eye::new(inputs.look.clone(), env);
        Ok(FollowObject { eye, distance: inputs.distance.si(), approaching })
    }

    fn poll(&mut self, _: Live, env: &mut E, now: Instant) -> Result<Poll<State>, Fault> {
        let Reading { time, value } = self.eye.look(env);
        let front = (env.body().front - env.lens().forward).si();
        let sight = |seen: Sighting| Sight {
            bearing: seen.bearing.si(),
            distance: seen.distance.si().min(FAR) - front - self.distance,
        };
        let sight = Reading { time, value: value.map(|seen| seen.map(sight)) };
        Ok(match self.approaching.poll(sight, env, now)? {
            Some(Approached::Reached) => Poll::Ready(State::ObjectReached),
            Some(Approached::Lost) => Poll::Ready(State::ObjectLost),
            None => Poll::Pending,
        })
    }

    halts_when_interrupted!();
}

/// The robot drives on from its current place, towards the target's last place at first.
impl<E: Navigator + Odometry + Camera + ?Sized> Resumable<templates::FollowObject, E>
    for FollowObject
{
    halts_when_suspended!();

    fn resume(&mut self, _: &mut E, now: Instant, away: Duration) -> Result<(), Fault> {
        self.approaching.resume(now, away);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fake::Fake;
    use crate::objects::Appearance;
    use afp_core::quantity::{Length, Speed};

    fn follow(robot: &mut Fake) -> Result<Option<State>, Fault> {
        let look = Appearance::of_color([0.7, 0.15, 0.15], 0.08);
        let inputs =
            Inputs { look: &look, distance: Length::from_si(0.5), speed: Speed::from_si(0.2) };
        robot.run::<templates::FollowObject, FollowObject>(inputs, || Live {}, 30)
    }

    #[test]
    fn it_stops_at_the_wanted_distance_from_the_object() {
        for (x, y) in [(2.0, 0.0), (2.0, 0.7), (1.5, -0.6)] {
            let mut robot = Fake::new(&[]);
            robot.post = Some((x, y));
            assert_eq!(follow(&mut robot), Ok(Some(State::ObjectReached)), "{x} {y}");
            let far = f64::hypot(x - robot.motion.x.si(), y - robot.motion.y.si());
            // The front and the camera are 20 cm before the turning centre.
            assert!((far - 0.7).abs() < 0.06, "{x} {y}: {far}");
        }
    }

    #[test]
    fn a_near_object_is_reached_at_once() {
        let mut robot = Fake::new(&[]);
        robot.post = Some((0.6, 0.0));
        assert_eq!(follow(&mut robot), Ok(Some(State::ObjectReached)));
        assert!(robot.motion.x.si().abs() < 0.01);
    }

    #[test]
    fn an_object_out_of_sight_is_lost_at_the_place_of_the_robot() {
        let mut robot = Fake::new(&[]);
        (robot.post, robot.post_goes) = (Some((3.0, 0.0)), 2000);
        assert_eq!(follow(&mut robot), Ok(Some(State::ObjectLost)));
        assert!((2500..2900).contains(&robot.millis()), "{}", robot.millis());
    }

    #[test]
    fn a_dead_or_frozen_camera_is_a_fault() {
        for freezes in [0, 1000] {
            let mut robot = Fake::new(&[]);
            (robot.post, robot.camera_freezes) = (Some((3.0, 0.0)), freezes);
            assert_eq!(follow(&mut robot), Err(NO_PICTURE));
            assert!(robot.millis() < freezes + 700);
        }
        let mut robot = Fake::new(&[]);
        robot.dead_camera = true;
        assert_eq!(follow(&mut robot), Err(NO_PICTURE));
    }
}
