//! Drive towards infrared light.

use crate::approaching::{Approached, Approaching, Sight};
use crate::devices::{Glow, InfraredSensor, Navigator, Odometry, Reading};
use crate::guard::NO_INFRARED;
use crate::templates;
use crate::templates::approach_infrared::{Inputs, Live, State};
use afp_core::{Actor, Fault, Instant, Poll};

/// Steers by the light's direction and brightness, and stops where the light is as bright as wanted.
#[derive(Clone, Debug)]
pub struct ApproachInfrared {
    strength: f64,
    approaching: Approaching,
}

impl<E> Actor<templates::ApproachInfrared, E> for ApproachInfrared
where
    E: Navigator + Odometry + InfraredSensor + ?Sized,
{
    fn start(inputs: Inputs, env: &mut E, now: Instant) -> Result<Self, Fault> {
        let approaching = Approaching::new(inputs.speed, NO_INFRARED, env, now);
        Ok(ApproachInfrared { strength: inputs.strength, approaching })
    }

    fn poll(&mut self, _: Live, env: &mut E, now: Instant) -> Result<Poll<State>, Fault> {
        let Reading { time, value } = env.glow();
        let sight = |glow: Glow| Sight {
            bearing: glow.bearing.si(),
            distance: self.distance(glow.strength),
        };
        let light = Reading { time, value: value.map(|glow| glow.map(sight)) };
        Ok(match self.approaching.poll(light, env, now)? {
            Some(Approached::Reached) => Poll::Ready(State::InfraredReached),
            Some(Approached::Lost) => Poll::Ready(State::InfraredLost),
            None => Poll::Pending,
        })
    }

    fn interrupt(&mut self, env: &mut E, now: Instant) -> Result<(), Fault> {
        env.halt(now);
        Ok(())
    }
}

impl ApproachInfrared {
    /// The distance left, metres, were the source of strength 1: brightness falls with the square of the
    /// distance.
    fn distance(&self, strength: f64) -> f64 {
        let distance = |strength: f64| 1.0 / libm::sqrt(strength.max(1e-6));
        distance(strength) - distance(self.strength)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fake::Fake;
    use afp_core::quantity::Speed;

    fn approach(robot: &mut Fake) -> Result<Option<State>, Fault> {
        let inputs = Inputs { strength: 4.0, speed: Speed::from_si(0.2) };
        robot.run::<templates::ApproachInfrared, ApproachInfrared>(inputs, || Live {}, 30)
    }

    #[test]
    fn stops_where_the_light_is_as_bright_as_wanted() {
        for (x, y) in [(2.0, 0.0), (2.0, 0.7), (1.5, -1.0), (0.3, 0.0)] {
            let mut robot = Fake::new(&[]);
            robot.light = Some((x, y));
            assert!(matches!(approach(&mut robot), Ok(Some(State::InfraredReached))), "{x} {y}");
            let far = f64::hypot(x - robot.motion.x.si(), y - robot.motion.y.si());
            let wanted = f64::min(0.5, f64::hypot(x, y));
            assert!((far - wanted).abs() < 0.02, "{x} {y}: {far}");
        }
    }

    #[test]
    fn darkness_ends_it_where_it_stands() {
        let mut robot = Fake::new(&[]);
        assert!(matches!(approach(&mut robot), Ok(Some(State::InfraredLost))));
        assert_eq!((robot.motion.x.si(), robot.millis()), (0.0, 510));
    }

    #[test]
    fn a_dead_sensor_is_a_fault_and_not_darkness() {
        let mut robot = Fake::new(&[]);
        robot.dead_infrared = true;
        assert_eq!(approach(&mut robot), Err(NO_INFRARED));
        assert_eq!(robot.motion.x.si(), 0.0);
    }
}
