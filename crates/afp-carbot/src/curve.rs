//! Drive along an arc.

use crate::devices::{Navigator, Odometry};
use crate::guard::{Guard, NO_ODOMETRY};
use crate::motion::Ramp;
use crate::templates;
use crate::templates::curve::{Inputs, Live, State};
use afp_core::quantity::{Angle, AngularSpeed, Speed};
use afp_core::{Actor, Fault, Instant, Poll};

/// Speed is gained and lost at this many metres a second squared.
const ACCELERATION: f64 = 0.5;
/// The arc counts as driven when less than this of its angle is left, radians.
const CLOSE: f64 = 0.005;

/// Drives an arc of a circle until the heading has turned by an angle, by odometry.
#[derive(Debug)]
pub struct Curve {
    radius: f64,
    angle: f64,
    speed: f64,
    ramp: Ramp,
    odometry: Guard,
    /// The heading at the beginning; none until the first reading.
    from: Option<Angle>,
}

impl<E: Navigator + Odometry + ?Sized> Actor<templates::Curve, E> for Curve {
    fn start(inputs: Inputs, env: &mut E, now: Instant) -> Result<Self, Fault> {
        let mut odometry = Guard::new(NO_ODOMETRY, now);
        let from = odometry.current(env.motion(), now)?.map(|motion| motion.heading);
        Ok(Curve {
            radius: inputs.radius.si(),
            angle: inputs.angle.si(),
            speed: inputs.speed.si(),
            ramp: Ramp::new(ACCELERATION, now),
            odometry,
            from,
        })
    }

    fn poll(&mut self, _: Live, env: &mut E, now: Instant) -> Result<Poll<State>, Fault> {
        let Some(motion) = self.odometry.current(env.motion(), now)? else {
            env.halt(now);
            return Ok(Poll::Pending);
        };
        let turned = motion.heading - *self.from.get_or_insert(motion.heading);
        let left = if self.angle < 0.0 { -1.0 } else { 1.0 };
        let rest = left * (self.angle - turned.si());
        if rest < CLOSE {
            env.halt(now);
            return Ok(if motion.stands() {
                Poll::Ready(State::CurveSuccessful { turned })
            } else {
                Poll::Pending
            });
        }
        let speed = self.ramp.rate(rest * self.radius, self.speed, now);
        env.drive(Speed::from_si(speed), AngularSpeed::from_si(left * speed / self.radius), now);
        Ok(Poll::Pending)
    }

    fn interrupt(&mut self, env: &mut E, now: Instant) -> Result<(), Fault> {
        env.halt(now);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fake::Fake;
    use afp_core::quantity::Length;

    fn curve(robot: &mut Fake, degrees: f64) -> Result<Option<State>, Fault> {
        let (radius, speed) = (Length::from_si(0.5), Speed::from_si(0.2));
        let inputs = Inputs { radius, angle: Angle::from_deg(degrees), speed };
        robot.run::<templates::Curve, Curve>(inputs, || Live {}, 40)
    }

    #[test]
    fn a_quarter_of_a_circle_ends_beside_its_centre() {
        for degrees in [90.0_f64, -90.0] {
            let mut robot = Fake::new(&[]);
            let state = curve(&mut robot, degrees);
            let Ok(Some(State::CurveSuccessful { turned })) = state else { panic!("{state:?}") };
            assert!((turned.si().to_degrees() - degrees).abs() < 1.0, "{turned:?}");
            let (x, y) = (robot.motion.x.si(), robot.motion.y.si());
            assert!((x - 0.5).abs() < 0.01 && (y - 0.5 * degrees.signum()).abs() < 0.01, "{x} {y}");
        }
    }

    #[test]
    fn a_whole_circle_leads_back() {
        let mut robot = Fake::new(&[]);
        assert!(matches!(curve(&mut robot, 360.0), Ok(Some(_))));
        assert!(robot.motion.x.si().abs() < 0.01 && robot.motion.y.si().abs() < 0.01);
    }

    #[test]
    fn faults_without_odometry() {
        let mut robot = Fake::new(&[]);
        robot.dead_odometry = true;
        assert_eq!(curve(&mut robot, 90.0), Err(NO_ODOMETRY));
    }
}
