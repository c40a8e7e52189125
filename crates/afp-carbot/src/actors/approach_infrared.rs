//! Drive towards infrared light.

use crate::devices::{Glow, InfraredSensor, Navigator, Odometry, Reading};
use crate::helpers::approaching::{Approached, Approaching, Sight};
use crate::helpers::guard::{FROZEN_INFRARED, NO_INFRARED};
use crate::helpers::repeats::Repeats;
use crate::templates;
use crate::templates::approach_infrared::{Inputs, Live, State};
use afp_core::{Actor, Duration, Fault, Instant, Poll, Resumable};

/// Steers by the light's direction and brightness, and stops at the wanted brightness.
#[derive(Clone, Debug)]
pub struct ApproachInfrared {
    strength: f64,
    repeats: Repeats<Glow>,
    approaching: Approaching,
}

impl<E> Actor<templates::ApproachInfrared, E> for ApproachInfrared
where
    E: Navigator + Odometry + InfraredSensor + ?Sized,
{
    fn start(inputs: Inputs, env: &mut E, now: Instant) -> Result<Self, Fault> {
        let approaching = Approaching::new(inputs.speed, NO_INFRARED, env, now);
        let repeats = Repeats::new(FROZEN_INFRARED, now);
        Ok(ApproachInfrared { strength: inputs.strength, repeats, approaching })
    }

    fn poll(&mut self, _: Live, env: &mut E, now: Instant) -> Result<Poll<State>, Fault> {
        let glow = env.glow();
        self.repeats.check(glow, env.motion())?;
        let Reading { time, value } = glow;
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

    halts_when_interrupted!();
}

/// The robot drives on from its current place, towards the target's last place at first.
impl<E: Navigator + Odometry + InfraredSensor + ?Sized> Resumable<templates::ApproachInfrared, E>
    for ApproachInfrared
{
    halts_when_suspended!();

    fn resume(&mut self, _: &mut E, now: Instant, away: Duration) -> Result<(), Fault> {
        self.approaching.resume(now, away);
        self.repeats.resume();
        Ok(())
    }
}

impl ApproachInfrared {
    /// Distance left, metres, for a source of strength 1: brightness falls with the square of the
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
    fn it_stops_at_the_wanted_brightness() {
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
    fn darkness_ends_it_at_its_place() {
        let mut robot = Fake::new(&[]);
        assert!(matches!(approach(&mut robot), Ok(Some(State::InfraredLost))));
        assert_eq!((robot.motion.x.si(), robot.millis()), (0.0, 510));
    }

    #[test]
    fn a_dead_sensor_is_a_fault_and_not_darkness() {
        let mut robot = Fake::new(&[]);
        robot.infrared_dies = 0;
        assert_eq!(approach(&mut robot), Err(NO_INFRARED));
        assert_eq!(robot.motion.x.si(), 0.0);
    }

    #[test]
    fn a_sensor_that_fails_or_freezes_while_driving_stops_the_robot() {
        let way = |break_it: fn(&mut Fake)| {
            let mut robot = Fake::new(&[]);
            robot.light = Some((5.0, 0.0));
            break_it(&mut robot);
            let fault = approach(&mut robot).map(|_| ());
            // Without a fault it is 58 cm from its start after three seconds.
            (fault, robot.motion.x.si() - 0.56)
        };
        let (fault, way_on) = way(|robot| robot.infrared_dies = 3000);
        assert!(fault == Err(NO_INFRARED) && (0.0..0.05).contains(&way_on), "{fault:?} {way_on}");
        let (fault, way_on) = way(|robot| robot.infrared_freezes = 3000);
        assert!(fault == Err(FROZEN_INFRARED) && way_on < 0.23, "{fault:?} {way_on}");
    }
}
