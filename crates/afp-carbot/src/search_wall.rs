//! Look around, standing still, and find the wall.

use crate::devices::{Navigator, Odometry, RotatingTelemetry, Rotator, Ultrasonic};
use crate::line_fit::{MOST, Return, fit};
use crate::sweep::Sweep;
use crate::templates;
use crate::templates::search_wall::{Inputs, Live, State};
use afp_core::quantity::Angle;
use afp_core::{Actor, Fault, Instant, Poll};
use heapless::Vec;

/// A wall ahead is put on the right side by this much more than its bearing.
const QUARTER: f64 = core::f64::consts::FRAC_PI_2;

/// Sweeps the range sensor from one side to the other and fits one wall to the echoes.
#[derive(Clone, Debug)]
pub struct SearchWall {
    sweep: Sweep,
    range: f64,
    returns: Vec<Return, MOST>,
}

impl<E> Actor<templates::SearchWall, E> for SearchWall
where
    E: Navigator + Odometry + Ultrasonic + Rotator + RotatingTelemetry + ?Sized,
{
    fn start(inputs: Inputs, env: &mut E, now: Instant) -> Result<Self, Fault> {
        let sweep = Sweep::new(inputs.sweep, env, now);
        Ok(SearchWall { sweep, range: inputs.range.si(), returns: Vec::new() })
    }

    fn poll(&mut self, _: Live, env: &mut E, now: Instant) -> Result<Poll<State>, Fault> {
        let Some(heard) = self.sweep.poll(env, now)? else { return Ok(Poll::Pending) };
        let heard_at = Return::of(&heard.echo);
        if heard_at.range <= self.range {
            // A sweep has fewer steps than there is room for; what is too much does not count.
            let _ = self.returns.push(heard_at);
        }
        if !heard.last {
            return Ok(Poll::Pending);
        }
        Ok(Poll::Ready(self.result(env.beam().opening.si() / 2.0)))
    }

    fn interrupt(&mut self, env: &mut E, now: Instant) -> Result<(), Fault> {
        env.halt(now);
        Ok(())
    }
}

impl SearchWall {
    fn result(&self, half_beam: f64) -> State {
        match fit(&self.returns, half_beam) {
            Some(wall) => State::WallFound { angle: Angle::from_si(wall.bearing + QUARTER) },
            None => State::NoWallFound,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fake::{Fake, Plane, plane};
    use crate::guard::{NO_RANGE, STUCK_ROTATOR};
    use afp_core::Duration;
    use afp_core::quantity::{AngularSpeed, Length, Speed};

    fn search(robot: &mut Fake) -> Result<Option<State>, Fault> {
        let inputs = Inputs { sweep: Angle::from_deg(60.0), range: Length::from_si(1.5) };
        robot.run::<templates::SearchWall, SearchWall>(inputs, || Live {}, 10)
    }

    fn found(walls: &[Plane]) -> f64 {
        let state = search(&mut Fake::new(walls));
        let Ok(Some(State::WallFound { angle })) = state else { panic!("{state:?}") };
        angle.si().to_degrees()
    }

    #[test]
    fn the_turn_puts_the_wall_on_the_right() {
        for normal in [-40.0, -30.0, 0.0, 25.0] {
            let turn = found(&[plane(normal, 0.7)]);
            assert!((turn - (normal + 90.0)).abs() < 3.0, "{normal}: {turn}");
        }
    }

    #[test]
    fn in_a_corner_the_wall_ahead_is_found_and_not_the_one_beside() {
        let turn = found(&[plane(0.0, 0.5), plane(-90.0, 0.475)]);
        assert!((turn - 90.0).abs() < 3.0, "{turn}");
    }

    #[test]
    fn nothing_and_something_out_of_range_is_no_wall() {
        assert_eq!(search(&mut Fake::new(&[])), Ok(Some(State::NoWallFound)));
        assert_eq!(search(&mut Fake::new(&[plane(0.0, 1.7)])), Ok(Some(State::NoWallFound)));
    }

    #[test]
    fn the_sweep_waits_for_standstill() {
        let mut robot = Fake::new(&[plane(0.0, 0.7)]);
        robot.drive(Speed::from_si(0.2), AngularSpeed::from_si(0.0), Instant::ZERO);
        robot.tick();
        let way = robot.motion.x.si();
        assert!(matches!(search(&mut robot), Ok(Some(State::WallFound { .. }))));
        assert!(robot.motion.x.si() - way < 0.01);
    }

    #[test]
    fn a_dead_sensor_and_a_stuck_rotator_are_faults() {
        let mut robot = Fake::new(&[plane(0.0, 0.7)]);
        robot.range_dies = 0;
        assert_eq!(search(&mut robot), Err(NO_RANGE));
        assert!(robot.now < Instant::ZERO + Duration::from_millis(600));
        let mut robot = Fake::new(&[plane(0.0, 0.7)]);
        robot.stuck_rotator = true;
        assert_eq!(search(&mut robot), Err(STUCK_ROTATOR));
    }
}
