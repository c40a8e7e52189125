//! Learn an object from one picture.

use crate::devices::{Camera, Frame, Invalid, Motion, Navigator, Odometry, Reading};
use crate::helpers::aside::Aside;
use crate::helpers::guard::{Guard, NO_ODOMETRY, NO_PICTURE};
use crate::objects::Appearance;
use crate::templates;
use crate::templates::learn_object::{Inputs, Live, State};
use afp_core::{Actor, Duration, Fault, Instant, Poll, Resumable};

/// Stops, takes one picture, and keeps the colours that occur only in its middle.
#[derive(Clone, Debug)]
pub struct LearnObject {
    share: f64,
    odometry: Guard,
    pictures: Guard,
    /// When the robot had stopped, and the camera's picture number then. Only a later picture
    /// counts.
    stood: Option<(Instant, u64)>,
    aside: Aside,
}

impl<E: Navigator + Odometry + Camera + ?Sized> Actor<templates::LearnObject, E> for LearnObject {
    fn start(inputs: Inputs, env: &mut E, now: Instant) -> Result<Self, Fault> {
        env.halt(now);
        Ok(LearnObject {
            share: inputs.share,
            odometry: Guard::new(NO_ODOMETRY, now),
            pictures: Guard::new(NO_PICTURE, now),
            stood: None,
            aside: Aside::default(),
        })
    }

    fn poll(&mut self, _: Live, env: &mut E, now: Instant) -> Result<Poll<State>, Fault> {
        env.halt(now);
        let Some((since, number)) = self.stood else {
            let motion = self.odometry.current(env.motion(), now)?;
            if let Some(motion) = motion.filter(Motion::stands) {
                self.aside.check(&motion)?;
                let number = env.frame().value.map_or(0, |frame| frame.number);
                (self.stood, self.pictures) = (Some((now, number)), Guard::new(NO_PICTURE, now));
            }
            return Ok(Poll::Pending);
        };
        let Reading { time, value } = env.frame();
        let new = |frame: Frame<'_>| frame.number != number;
        let value = value.and_then(|frame| new(frame).then_some(frame).ok_or(Invalid::Frozen));
        let reading = Reading { time, value };
        let Some(frame) = self.pictures.next(reading, since, now)? else {
            return Ok(Poll::Pending);
        };
        Ok(Poll::Ready(match Appearance::learnt(&frame, self.share) {
            Some(look) => State::ObjectLearnt { look },
            None => State::NothingSpecial,
        }))
    }

    halts_when_interrupted!();
}

/// Takes a picture that is newer than the suspension.
impl<E: Navigator + Odometry + Camera + ?Sized> Resumable<templates::LearnObject, E>
    for LearnObject
{
    fn suspend(&mut self, env: &mut E, now: Instant) -> Result<(), Fault> {
        env.halt(now);
        self.aside = Aside::at(env, now);
        Ok(())
    }

    fn resume(&mut self, _: &mut E, now: Instant, _: Duration) -> Result<(), Fault> {
        self.odometry.restart(now);
        self.stood = None;
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fake::Fake;

    /// Returns what the actor learns; `None` if nothing in the picture stands out.
    fn learn(robot: &mut Fake) -> Result<Option<Appearance>, Fault> {
        let inputs = Inputs { share: 0.2 };
        let state = robot.run::<templates::LearnObject, LearnObject>(inputs, || Live {}, 5)?;
        Ok(match state.expect("it does not take that long") {
            State::ObjectLearnt { look } => Some(look),
            State::NothingSpecial => None,
        })
    }

    #[test]
    fn the_object_ahead_is_learnt_without_its_surroundings() {
        let mut robot = Fake::new(&[]);
        robot.post = Some((0.8, 0.0));
        let look = learn(&mut robot).unwrap().expect("it is special");
        assert!(look.has([180, 40, 40]) && look.has([90, 20, 20]) && !look.has([120, 120, 120]));
    }

    #[test]
    fn without_an_object_it_learns_nothing() {
        assert_eq!(learn(&mut Fake::new(&[])), Ok(None));
    }

    #[test]
    fn a_dead_or_frozen_camera_and_a_dead_odometer_are_faults() {
        let mut robot = Fake::new(&[]);
        robot.dead_camera = true;
        assert_eq!(learn(&mut robot), Err(NO_PICTURE));
        let mut robot = Fake::new(&[]);
        robot.camera_freezes = 0;
        assert_eq!(learn(&mut robot), Err(NO_PICTURE));
        let mut robot = Fake::new(&[]);
        robot.dead_odometry = true;
        assert_eq!(learn(&mut robot), Err(NO_ODOMETRY));
    }
}
