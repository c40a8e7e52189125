//! Drive towards infrared light.

use crate::devices::{InfraredSensor, Navigator, Odometry};
use crate::guard::{Guard, NO_INFRARED, NO_ODOMETRY, PATIENCE};
use crate::history::{History, Pose};
use crate::motion::{Ramp, wrap};
use crate::templates;
use crate::templates::approach_infrared::{Inputs, Live, State};
use crate::tracking::Tracking;
use afp_core::{Actor, Fault, Instant, Poll};

/// Speed is gained and lost at this many metres a second squared.
const ACCELERATION: f64 = 0.5;
/// The light counts as bright enough when the way left is less than this, metres.
const CLOSE: f64 = 0.005;
/// How sharply to steer: turn rate per radian off.
const STEER: f64 = 1.5;
/// The share of a new reading in what is steered by.
const NEWS: f64 = 0.4;

/// Steers by the light's direction and brightness, smoothed, and stops where the light is as bright as wanted.
///
/// What a reading says holds for where the robot was when it was measured; from there the odometry goes on.
#[derive(Clone, Debug)]
pub struct ApproachInfrared {
    strength: f64,
    speed: f64,
    ramp: Ramp,
    tracking: Tracking,
    infrared: Guard,
    odometry: Guard,
    history: History,
    /// When the latest reading was measured.
    last_look: Instant,
    /// When the light was seen last; the beginning counts as seen.
    seen: Instant,
    /// Smoothed; none before the first light.
    light: Option<Light>,
    /// What the robot comes to a standstill for.
    ending: Option<State>,
}

/// What is steered by: the heading towards the light, radians, and the way left from a place, metres.
#[derive(Clone, Copy, Debug)]
struct Light {
    heading: f64,
    way: f64,
    from: Pose,
}

impl<E> Actor<templates::ApproachInfrared, E> for ApproachInfrared
where
    E: Navigator + Odometry + InfraredSensor + ?Sized,
{
    fn start(inputs: Inputs, env: &mut E, now: Instant) -> Result<Self, Fault> {
        env.halt(now);
        let mut history = History::new();
        history.note(env.motion());
        Ok(ApproachInfrared {
            strength: inputs.strength,
            speed: inputs.speed.si(),
            ramp: Ramp::new(ACCELERATION, now),
            tracking: Tracking::new(now),
            infrared: Guard::new(NO_INFRARED, now),
            odometry: Guard::new(NO_ODOMETRY, now),
            history,
            last_look: now,
            seen: now,
            light: None,
            ending: None,
        })
    }

    fn poll(&mut self, _: Live, env: &mut E, now: Instant) -> Result<Poll<State>, Fault> {
        let counted = env.motion();
        self.history.note(counted);
        let motion = self.odometry.current(counted, now)?;
        self.look(env, now)?;
        let light = self.light.zip(motion).map(|(light, motion)| (light, Pose::from(motion)));
        self.ending = self.ending.or_else(|| self.end(light));
        if let Some(state) = self.ending {
            self.tracking.halt(env, now);
            let stands = motion.is_some_and(|motion| motion.stands());
            return Ok(if stands { Poll::Ready(state) } else { Poll::Pending });
        }
        // In the dark it waits: what was ahead may have gone anywhere.
        let lit = light.filter(|_| self.seen == self.last_look).zip(motion);
        let Some(((light, here), motion)) = lit else {
            self.tracking.halt(env, now);
            self.ramp = Ramp::new(ACCELERATION, now);
            return Ok(Poll::Pending);
        };
        let bearing = wrap(light.heading - here.heading);
        let cruise = self.speed * libm::cos(bearing).max(0.0);
        let speed = self.ramp.rate(light.way_from(here), cruise, now);
        self.tracking.drive(env, &motion, (speed, STEER * bearing), now)?;
        Ok(Poll::Pending)
    }

    fn interrupt(&mut self, env: &mut E, now: Instant) -> Result<(), Fault> {
        env.halt(now);
        Ok(())
    }
}

impl ApproachInfrared {
    /// Takes in a new reading of the sensor, if there is one.
    fn look<E>(&mut self, env: &E, now: Instant) -> Result<(), Fault>
    where
        E: InfraredSensor + ?Sized,
    {
        let reading = self.history.placed(env.glow());
        let Some((glow, then)) = self.infrared.next(reading, self.last_look, now)? else {
            return Ok(());
        };
        self.last_look = reading.time;
        let Some(glow) = glow else { return Ok(()) };
        self.seen = reading.time;
        let new = Light {
            heading: then.heading + glow.bearing.si(),
            way: self.way(glow.strength),
            from: then,
        };
        self.light = Some(self.light.map_or(new, |old| old.mixed(new)));
        Ok(())
    }

    /// What ends the approach, if something does.
    fn end(&self, light: Option<(Light, Pose)>) -> Option<State> {
        if light.is_some_and(|(light, here)| light.way_from(here) < CLOSE) {
            return Some(State::InfraredReached);
        }
        (self.last_look.since(self.seen) > PATIENCE).then_some(State::InfraredLost)
    }

    /// The way left, metres, were the source of strength 1: brightness falls with the square of the
    /// distance.
    fn way(&self, strength: f64) -> f64 {
        let distance = |strength: f64| 1.0 / libm::sqrt(strength.max(1e-6));
        distance(strength) - distance(self.strength)
    }
}

impl Light {
    /// The way left from another place.
    fn way_from(&self, place: Pose) -> f64 {
        let (sin, cos) = libm::sincos(self.heading);
        self.way - (place.x - self.from.x) * cos - (place.y - self.from.y) * sin
    }

    /// With a share of something newer.
    fn mixed(&self, new: Light) -> Light {
        let way = self.way_from(new.from);
        Light {
            heading: self.heading + NEWS * wrap(new.heading - self.heading),
            way: way + NEWS * (new.way - way),
            from: new.from,
        }
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
