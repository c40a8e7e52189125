//! Look around and map the distance in every direction.

use crate::devices::{Navigator, Odometry, RotatingTelemetry, Rotator, Ultrasonic};
use crate::helpers::line_fit::Return;
use crate::helpers::sweep::Sweep;
use crate::objects::DistanceMap;
use crate::templates;
use crate::templates::look_around::{Inputs, Live, State};
use afp_core::{Actor, Duration, Fault, Instant, Poll, Resumable};

/// Sweeps the range sensor from side to side and makes a map of the echoes.
#[derive(Clone, Debug)]
pub struct LookAround {
    sweep: Sweep,
    map: DistanceMap,
}

impl<E> Actor<templates::LookAround, E> for LookAround
where
    E: Navigator + Odometry + Ultrasonic + Rotator + RotatingTelemetry + ?Sized,
{
    fn start(inputs: Inputs, env: &mut E, now: Instant) -> Result<Self, Fault> {
        Ok(LookAround { sweep: Sweep::new(inputs.sweep, env, now), map: DistanceMap::default() })
    }

    fn poll(&mut self, _: Live, env: &mut E, now: Instant) -> Result<Poll<State>, Fault> {
        let Some(heard) = self.sweep.poll(env, now)? else { return Ok(Poll::Pending) };
        self.map.add(Return::of(&heard.echo));
        Ok(if heard.last {
            Poll::Ready(State::LookedAround { map: self.map.clone() })
        } else {
            Poll::Pending
        })
    }

    halts_when_interrupted!();
}

/// The distances that were heard before count on, because the robot stays in place.
impl<E> Resumable<templates::LookAround, E> for LookAround
where
    E: Navigator + Odometry + Ultrasonic + Rotator + RotatingTelemetry + ?Sized,
{
    fn suspend(&mut self, env: &mut E, now: Instant) -> Result<(), Fault> {
        self.sweep.suspend(env, now);
        Ok(())
    }

    fn resume(&mut self, _: &mut E, now: Instant, _: Duration) -> Result<(), Fault> {
        self.sweep.resume(now);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fake::{Fake, plane};
    use crate::helpers::guard::{FROZEN_RANGE, NO_ODOMETRY, NO_RANGE, STUCK_ROTATOR};
    use afp_core::quantity::Angle;

    fn look(robot: &mut Fake, seconds: u64) -> Result<Option<State>, Fault> {
        let inputs = Inputs { sweep: Angle::from_deg(120.0) };
        robot.run::<templates::LookAround, LookAround>(inputs, || Live {}, seconds)
    }

    #[test]
    fn every_direction_has_its_distance() {
        let Ok(Some(State::LookedAround { map })) =
            look(&mut Fake::new(&[plane(90.0, 1.0), plane(0.0, 3.0)]), 20)
        else {
            panic!("it does not get round")
        };
        assert_eq!(map.returns().len(), 49);
        let at = |deg: f64| {
            let near = |seen: &&Return| (seen.bearing.to_degrees() - deg).abs() < 2.5;
            map.returns().iter().find(near).unwrap().range
        };
        assert!((at(90.0) - 1.0).abs() < 0.01 && (at(0.0) - 2.9).abs() < 0.01);
        assert_eq!(at(-90.0), f64::INFINITY);
    }

    #[test]
    fn an_interrupt_leaves_the_robot_stopped() {
        assert!(matches!(look(&mut Fake::new(&[plane(0.0, 0.7)]), 1), Ok(None)));
    }

    #[test]
    fn a_silent_stuck_or_frozen_sensor_is_a_fault_and_not_free_space() {
        let fault = |break_it: fn(&mut Fake)| {
            let mut robot = Fake::new(&[plane(0.0, 0.7)]);
            break_it(&mut robot);
            look(&mut robot, 20).map(|_| ())
        };
        assert_eq!(fault(|robot| robot.range_dies = 0), Err(NO_RANGE));
        assert_eq!(fault(|robot| robot.range_dies = 1500), Err(NO_RANGE));
        assert_eq!(fault(|robot| robot.range_freezes = 0), Err(FROZEN_RANGE));
        assert_eq!(fault(|robot| robot.stuck_rotator = true), Err(STUCK_ROTATOR));
        assert_eq!(fault(|robot| robot.dead_odometry = true), Err(NO_ODOMETRY));
    }
}
