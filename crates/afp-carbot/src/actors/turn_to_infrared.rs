//! Turn in place towards infrared light.

use crate::devices::{Glow, InfraredSensor, Navigator, Odometry, Reading};
use crate::helpers::guard::{FROZEN_INFRARED, NO_INFRARED};
use crate::helpers::repeats::Repeats;
use crate::helpers::seeking::{Seeking, Sought};
use crate::templates;
use crate::templates::turn_to_infrared::{Inputs, Live, State};
use afp_core::{Actor, Duration, Fault, Instant, Poll, Resumable};

/// Turns left until the sensor sees light, then towards it.
#[derive(Clone, Debug)]
pub struct TurnToInfrared {
    seeking: Seeking,
    repeats: Repeats<Glow>,
}

impl<E> Actor<templates::TurnToInfrared, E> for TurnToInfrared
where
    E: Navigator + Odometry + InfraredSensor + ?Sized,
{
    fn start(inputs: Inputs, env: &mut E, now: Instant) -> Result<Self, Fault> {
        let aim = (inputs.tolerance, inputs.speed);
        let repeats = Repeats::new(FROZEN_INFRARED, now);
        Ok(TurnToInfrared { seeking: Seeking::new(aim, NO_INFRARED, env, now), repeats })
    }

    fn poll(&mut self, _: Live, env: &mut E, now: Instant) -> Result<Poll<State>, Fault> {
        let glow = env.glow();
        self.repeats.check(glow, env.motion())?;
        let Reading { time, value } = glow;
        let light = Reading { time, value: value.map(|glow| glow.map(|glow| glow.bearing)) };
        Ok(match self.seeking.poll(light, env, now)? {
            Some(Sought::Facing) => Poll::Ready(State::FacingInfrared),
            Some(Sought::Missing) => Poll::Ready(State::NoInfraredFound),
            None => Poll::Pending,
        })
    }

    halts_when_interrupted!();
}

/// The search continues from the heading where it began.
impl<E: Navigator + Odometry + InfraredSensor + ?Sized> Resumable<templates::TurnToInfrared, E>
    for TurnToInfrared
{
    halts_when_suspended!();

    fn resume(&mut self, _: &mut E, now: Instant, away: Duration) -> Result<(), Fault> {
        self.seeking.resume(now, away);
        self.repeats.resume();
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fake::Fake;
    use afp_core::quantity::{Angle, AngularSpeed};

    fn turn(robot: &mut Fake) -> Result<Option<State>, Fault> {
        let inputs =
            Inputs { tolerance: Angle::from_deg(5.0), speed: AngularSpeed::from_deg(45.0) };
        robot.run::<templates::TurnToInfrared, TurnToInfrared>(inputs, || Live {}, 20)
    }

    #[test]
    fn faces_light_on_either_side_and_behind() {
        for (x, y) in [(1.0, 1.0), (1.0, -0.5), (-1.0, 0.2), (2.0, 0.0)] {
            let mut robot = Fake::new(&[]);
            robot.light = Some((x, y));
            assert!(matches!(turn(&mut robot), Ok(Some(State::FacingInfrared))), "{x} {y}");
            let off = robot.motion.heading.si() - f64::atan2(y, x);
            assert!(
                crate::helpers::motion::wrap(off).abs() < 5.0_f64.to_radians(),
                "{x} {y}: {off}"
            );
        }
    }

    #[test]
    fn without_light_it_turns_once_around() {
        let mut robot = Fake::new(&[]);
        assert!(matches!(turn(&mut robot), Ok(Some(State::NoInfraredFound))));
        assert!(robot.motion.heading.si() > core::f64::consts::TAU);
    }

    #[test]
    fn it_does_not_wait_for_light_that_goes_out() {
        let mut robot = Fake::new(&[]);
        robot.light = Some((1.0, 1.0));
        robot.light_goes_out = 300;
        assert!(matches!(turn(&mut robot), Ok(Some(State::NoInfraredFound))));
        assert!(robot.motion.heading.si() < 1.0);
    }

    #[test]
    fn a_dead_sensor_is_a_fault_and_not_darkness() {
        let mut robot = Fake::new(&[]);
        robot.infrared_dies = 0;
        assert_eq!(turn(&mut robot), Err(NO_INFRARED));
    }

    #[test]
    fn a_sensor_that_fails_or_freezes_while_driving_stops_the_robot() {
        for (dies, freezes, fault) in
            [(700, u64::MAX, NO_INFRARED), (u64::MAX, 700, FROZEN_INFRARED)]
        {
            let mut robot = Fake::new(&[]);
            robot.light = Some((0.6, 1.0));
            (robot.infrared_dies, robot.infrared_freezes) = (dies, freezes);
            assert_eq!(turn(&mut robot), Err(fault));
            assert!(robot.motion.heading.si() < 1.6, "{fault:?} {:?}", robot.motion);
        }
    }
}
